"""Bench of the stepper of columns and rows."""
