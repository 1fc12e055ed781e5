"""Bench of the core's counters."""
