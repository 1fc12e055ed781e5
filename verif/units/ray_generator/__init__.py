"""Bench of the ray generator."""
