"""Bench of the store of pending rays."""
