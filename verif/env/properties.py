"""Hypothesis inside a running simulation: one thread a property, every example on the live design.

A property is a plain function; what it does to the design goes through `cocotb.task.resume`. At a
desk failing examples come back from the example database; where there is none (CI) the seed
decides, and a failure prints the blob that reproduces it.
"""

from collections.abc import Callable
from typing import Any

from cocotb.task import bridge
from hypothesis import HealthCheck, Phase, given, seed, settings
from hypothesis import strategies as st
from hypothesis.database import DirectoryBasedExampleDatabase

from verif.env.context import Context

_PHASES = tuple(phase for phase in Phase if phase is not Phase.explain)


async def check(context: Context, body: Callable[..., Any], *strategies: st.SearchStrategy[Any]) -> None:
    """Runs ``body`` on examples of the strategies; raises what the smallest failing one raised."""
    database = context.database
    configured = settings(
        max_examples=context.examples,
        deadline=None,
        phases=_PHASES,
        print_blob=True,
        database=None if database is None else DirectoryBasedExampleDatabase(str(database)),
        suppress_health_check=list(HealthCheck),
    )
    wrapped = configured(given(*strategies)(body))
    if database is None:
        wrapped = seed(context.seed)(wrapped)
    await bridge(wrapped)()
