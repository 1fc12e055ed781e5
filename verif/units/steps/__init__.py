"""Bench of the steps of a hit."""
