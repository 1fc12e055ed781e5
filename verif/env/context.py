"""What the run told the bench: parameters, seed, how much to do."""

import json
import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import cocotb
import numpy as np


@dataclass(frozen=True)
class Context:
    """Settings of one run.

    parameters: the module's, complete; parameter_set: their name; seed: root of all randomness;
    examples: Hypothesis examples a property; operands: length of a fast stream; database: folder
    of Hypothesis' example database, or None where the seed alone decides; corpus: folder of examples to
    replay first, see `verif.env.corpus`; extra: what only one bench reads; unit: whose cover points are
    sampled, none where it is empty; known: bins that other runs have hit.
    """

    directory: Path
    parameters: Mapping[str, int]
    parameter_set: str
    seed: int
    examples: int
    operands: int
    database: Path | None
    extra: Mapping[str, Any]
    corpus: Path | None = None
    unit: str = ""
    known: tuple[str, ...] = ()

    def generator(self, *stream: int) -> np.random.Generator:
        """A generator of its own for one component; ``stream`` numbers the components of a bench."""
        return np.random.default_rng([self.seed, *stream])


def read() -> Context:
    """The context of the simulation that this process is."""
    directory = Path(os.environ["RAYTRACER_RUN"])
    settings = json.loads((directory / "settings.json").read_text())
    database = settings.get("database")
    return Context(
        directory=directory,
        parameters=settings.get("parameters", {}),
        parameter_set=settings.get("parameter_set", "default"),
        seed=cocotb.RANDOM_SEED,
        examples=settings.get("examples", 100),
        operands=settings.get("operands", 100_000),
        database=None if database is None else Path(database),
        extra=settings.get("extra", {}),
        unit=settings.get("unit", ""),
        known=tuple(settings.get("known", ())),
        corpus=Path(settings["corpus"]) if "corpus" in settings else None,
    )
