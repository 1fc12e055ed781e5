"""Models of the ray tracing core: bit-exact, float64 reference, scenes and pictures."""
