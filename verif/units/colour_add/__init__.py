"""Bench of the sum of colours."""
