"""Bench of the objects' set-up."""
