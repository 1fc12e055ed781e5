"""Hypothesis inside a running simulation: one thread a property, every example on the live design.

A property is a plain function; what it does to the design goes through `cocotb.task.resume`. The examples
of the bench's corpus come first. Then the seed decides what is drawn, so a run repeats; at a desk failing
examples of earlier runs come before that, from the example database. A failure prints the blob that
reproduces it, and leaves its smallest example as a file for the corpus.
"""

import inspect
from collections.abc import Callable
from typing import Any

from cocotb.task import bridge
from hypothesis import HealthCheck, Phase, given, seed, settings
from hypothesis import strategies as st
from hypothesis.database import DirectoryBasedExampleDatabase

from verif.env import corpus, sources
from verif.env.codec import CodecError
from verif.env.context import Context
from verif.env.corpus import Entry

_PHASES = tuple(phase for phase in Phase if phase is not Phase.explain)
_SEARCH = (Phase.explicit, Phase.generate)

_WHY = 240
"""Characters of a failure that are kept with its example."""


async def check(context: Context, body: Callable[..., Any], *strategies: st.SearchStrategy[Any]) -> None:
    """Runs ``body`` on the corpus, then on examples of the strategies; raises what the smallest failing one
    raised.

    ``body`` is defined in the test whose property it is: that test's name is the property's.
    """
    name = inspect.unwrap(body).__qualname__.split(".")[0]
    await bridge(_run)(context, name, body, strategies)


def _run(
    context: Context, name: str, body: Callable[..., Any], strategies: tuple[st.SearchStrategy[Any], ...]
) -> None:
    _replay(context, name, body)
    failed: list[tuple[Any, ...]] = []

    def example(drawn: tuple[Any, ...]) -> None:
        try:
            body(*drawn)
        except Exception:
            failed[:] = [drawn]  # the last that fails is the smallest
            raise

    # In this order: `seed` switches the database off, and the settings put it back.
    search = _settings(context)(seed(context.seed)(given(st.tuples(*strategies))(example)))
    try:
        search()
    except Exception as error:
        if failed and _shrinks(context):
            error.add_note(_kept(context, name, failed[0], error))
        raise


def _replay(context: Context, name: str, body: Callable[..., Any]) -> None:
    if context.corpus is None:
        return
    for path, entry in corpus.select(context.corpus, name, context.parameter_set):
        try:
            body(*entry.values)
        except Exception as error:
            error.add_note(f"replayed from {path}, kept because: {entry.why}")
            raise


def _shrinks(context: Context) -> bool:
    return bool(context.extra.get("shrink", True))


def _settings(context: Context) -> settings:
    database = context.database
    return settings(
        max_examples=context.examples,
        deadline=None,
        phases=_PHASES if _shrinks(context) else _SEARCH,
        print_blob=True,
        database=None if database is None else DirectoryBasedExampleDatabase(str(database)),
        suppress_health_check=list(HealthCheck),
    )


def _kept(context: Context, name: str, drawn: tuple[Any, ...], error: Exception) -> str:
    """Leaves the example in the run's folder; what a person does to keep it."""
    why = " ".join(f"{type(error).__name__}: {error}".split())
    if len(why) > _WHY:
        why = f"{why[:_WHY]} ..."
    try:
        path = corpus.keep(Entry(name, context.parameter_set, drawn, why), context.directory / corpus.NAME)
    except CodecError as problem:
        return f"the example cannot be kept: {problem}"
    found, where = sources.relative((path, context.corpus or sources.VERIF / corpus.NAME))
    return f"keep this example, which every run then replays first: mkdir -p {where} && cp {found} {where}"
