"""Bench of the block floating point shift."""
