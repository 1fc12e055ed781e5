"""Bench of the dispatch of rays to trace units."""
