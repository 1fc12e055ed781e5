"""Bench of the point-wise product."""
