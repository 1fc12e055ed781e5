"""Verification of the ray tracing core: benches of the units, of the core, and their environment."""
