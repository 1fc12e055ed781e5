"""Hypothesis for the models: the same examples each time in CI, new ones at a desk."""

import os
from pathlib import Path

from hypothesis import settings
from hypothesis.database import DirectoryBasedExampleDatabase

_DATABASE = Path(__file__).parents[2] / "build" / "hypothesis" / "models"

settings.register_profile("ci", derandomize=True, deadline=None, database=None)
settings.register_profile("desk", deadline=None, database=DirectoryBasedExampleDatabase(_DATABASE))
settings.load_profile("ci" if os.environ.get("CI") else "desk")
