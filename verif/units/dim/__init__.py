"""Bench of the light behind an object."""
