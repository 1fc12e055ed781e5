"""Bench of the unpacker of fields."""
