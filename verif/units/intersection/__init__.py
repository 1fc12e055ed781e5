"""Bench of the test of a ray against an object."""
