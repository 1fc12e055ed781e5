"""Bench of the loader of frames."""
