"""Bench of the object's set-up."""
