"""What the judge and the server inside the simulation agree upon."""

SERVER = "verif.mutation.server"
"""Cocotb module that judges."""

JUDGED, FILES = "judged.jsonl", "files.json"
"""In the folder that the judge names: a line a mutant (mutant, test, seconds of processor time); the files of
the project that were imported."""

SURVIVED, TIMED_OUT, CRASHED = "survived", "timed out", "the simulator"
"""In place of the name of the test that failed."""
