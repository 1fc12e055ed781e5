"""Bench of the delay line."""
