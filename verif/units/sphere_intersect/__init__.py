"""Bench of the ray-sphere test."""
