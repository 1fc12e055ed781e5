"""Bench of the video block."""
