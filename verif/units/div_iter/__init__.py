"""Bench of the iterative division."""
