"""Bench of the trace unit."""
