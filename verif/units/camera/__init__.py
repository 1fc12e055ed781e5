"""Bench of the camera, with the normaliser that the core lends it."""
