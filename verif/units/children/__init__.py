"""Bench of the secondary rays of a hit."""
