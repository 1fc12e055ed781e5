"""Qualification by mutation: many small faults in one build of a unit, its own bench as the judge."""
