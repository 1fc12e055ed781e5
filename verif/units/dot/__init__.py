"""Bench of the dot product."""
