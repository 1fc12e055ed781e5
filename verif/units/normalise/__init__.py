"""Bench of the unit vector."""
