"""Bench of the power of a highlight."""
