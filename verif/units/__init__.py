"""One folder a unit: `unit.py` says what it is, `bench.py` is what the simulator runs."""
