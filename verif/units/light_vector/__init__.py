"""Bench of the vector to a light."""
