"""Bench of the light that each step of a hit adds."""
