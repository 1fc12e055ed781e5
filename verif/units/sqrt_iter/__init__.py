"""Bench of the iterative square root."""
