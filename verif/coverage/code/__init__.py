"""Code coverage: what Verilator counted in the design, merged, less reviewed exclusions, and its exports."""
