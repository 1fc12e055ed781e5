"""Scenes: their types, the packed frame, and the files they come from."""
