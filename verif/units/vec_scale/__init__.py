"""Bench of the product of a scalar and a vector."""
