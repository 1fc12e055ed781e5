"""The page of a regression: one HTML file that needs no network, drawn from its record and the sources."""
