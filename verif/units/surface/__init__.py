"""Bench of the hit point and normal."""
