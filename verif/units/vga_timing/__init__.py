"""Bench of the timing of the screen."""
