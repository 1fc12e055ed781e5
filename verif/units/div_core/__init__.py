"""Bench of the unsigned long division."""
