"""Bench of the queue between two streams."""
