"""`make bench`: measures, compares, claims nothing: figures of one run on one machine, as ratios."""
