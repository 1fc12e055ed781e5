"""Bench of the colours as bytes."""
