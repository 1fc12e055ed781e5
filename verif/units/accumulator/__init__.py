"""Bench of the sums of pixels."""
