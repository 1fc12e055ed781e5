"""Hypothesis inside a running simulation: one thread a property, every example on the live design.

A property is a plain function; what it does to the design goes through `cocotb.task.resume`. The
seed decides what is drawn, so a run repeats; at a desk failing examples of earlier runs come first,
from the example database. A failure prints the blob that reproduces it.
"""

from collections.abc import Callable
from typing import Any

from cocotb.task import bridge
from hypothesis import HealthCheck, Phase, given, seed, settings
from hypothesis import strategies as st
from hypothesis.database import DirectoryBasedExampleDatabase

from verif.env.context import Context

_PHASES = tuple(phase for phase in Phase if phase is not Phase.explain)
_SEARCH = (Phase.explicit, Phase.generate)


async def check(context: Context, body: Callable[..., Any], *strategies: st.SearchStrategy[Any]) -> None:
    """Runs ``body`` on examples of the strategies; raises what the smallest failing one raised."""
    database = context.database
    configured = settings(
        max_examples=context.examples,
        deadline=None,
        phases=_PHASES if context.extra.get("shrink", True) else _SEARCH,
        print_blob=True,
        database=None if database is None else DirectoryBasedExampleDatabase(str(database)),
        suppress_health_check=list(HealthCheck),
    )
    # In this order: `seed` switches the database off, and the settings put it back.
    await bridge(configured(seed(context.seed)(given(*strategies)(body))))()
