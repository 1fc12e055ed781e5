"""Bench of the mirrored direction."""
