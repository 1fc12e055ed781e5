"""What every bench shares: builds, runs, streams, monitors, scoreboards, stimulus.

`sources`, `simulators`, `build` and `run` work outside the simulator; the rest inside it.
"""
