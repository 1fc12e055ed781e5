"""Bench of the double frame buffer."""
