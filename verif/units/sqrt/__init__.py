"""Bench of the pipelined square root."""
