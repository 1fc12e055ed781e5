"""Bench of the format conversion."""
