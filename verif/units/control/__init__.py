"""Bench of the core's control."""
