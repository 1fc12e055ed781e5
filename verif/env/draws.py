"""Examples of a Hypothesis strategy outside a property: for scenarios, which have nothing to shrink."""

from typing import TypeVar

from hypothesis import HealthCheck, Phase, given, seed, settings
from hypothesis import strategies as st
from numpy.random import Generator

T = TypeVar("T")


def examples(strategy: st.SearchStrategy[T], generator: Generator, number: int) -> list[T]:
    """At most ``number`` examples (fewer where there are no more), decided by the generator alone."""
    found: list[T] = []

    def keep(drawn: T) -> None:
        found.append(drawn)

    configured = settings(
        max_examples=number,
        phases=(Phase.generate,),
        database=None,
        deadline=None,
        suppress_health_check=list(HealthCheck),
    )
    configured(seed(int(generator.integers(1 << 32)))(given(strategy)(keep)))()
    return found
