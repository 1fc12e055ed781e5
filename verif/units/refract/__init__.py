"""Bench of transmitted directions."""
