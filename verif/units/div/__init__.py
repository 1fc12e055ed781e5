"""Bench of the signed division."""
