"""Bench of the registers behind AXI4-Lite."""
