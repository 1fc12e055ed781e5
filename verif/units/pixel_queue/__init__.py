"""Bench of the queue of pixels in flight."""
