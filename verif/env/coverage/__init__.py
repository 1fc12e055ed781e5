"""Functional coverage: what is declared, sampled and kept. Closing it and code coverage: `verif.coverage`."""
