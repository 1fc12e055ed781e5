"""Bench of the light that one lamp adds to a hit."""
