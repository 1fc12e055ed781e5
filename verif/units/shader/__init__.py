"""Bench of the colour of a hit."""
