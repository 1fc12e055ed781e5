"""Bench of the cross product."""
