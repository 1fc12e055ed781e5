"""Bench of the scene memory."""
