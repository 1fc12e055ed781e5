"""Bench of the length of a vector."""
