"""Bench of the saturating sum and difference."""
