"""Bench of the exact multiplier."""
