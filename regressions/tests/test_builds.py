"""Builds: once for all runs that need the same one, and what a run does without."""

from dataclasses import replace
from threading import Event

import pytest

from regressions import builds, lists
from regressions.expand import expand
from verif.env.build import Build, BuildError
from verif.env.simulators import MissingTool


def test_seeds_share_a_build() -> None:
    """As do tests of the core on the same build."""
    (entry,) = (entry for entry in lists.load("weekly").entries if entry.name == "units")
    few = replace(entry, tests=("add_sub",), seeds=3)
    planned = expand(replace(lists.load("weekly"), entries=(few,)), 1)
    made, keys, missing = builds.by_content(planned)
    assert not missing
    assert len(planned) == len(keys) == 3 * len(made)


def test_a_build_that_fails_is_told_of_each_run_that_needs_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """With the compiler's complaint."""

    def refuse(build: Build) -> None:
        raise BuildError(f"{build.top} does not build")

    monkeypatch.setattr(builds, "ensure", refuse)
    monkeypatch.setattr(Build, "ready", False)
    planned = [run for run in expand(lists.load("smoke"), 1) if run.unit in ("add_sub", "sqrt")]
    told: list[tuple[int, int]] = []
    why = builds.without_build(planned, 2, Event(), lambda *numbers: told.append(numbers))
    assert why.keys() == {run.id for run in planned}
    assert all("does not build" in text for text in why.values())
    assert told == [(1, 2), (2, 2)]


def test_without_a_simulator_a_run_has_no_build(monkeypatch: pytest.MonkeyPatch) -> None:
    """The sentence says which one, and the run has not run: no skip that looks like a pass."""

    def missing(*_arguments: object, **_options: object) -> Build:
        raise MissingTool("`iverilog` is not on PATH")

    monkeypatch.setattr(builds, "needed", missing)
    planned = expand(lists.load("smoke"), 1)[:2]
    why = builds.without_build(planned, 1, Event(), lambda *_numbers: None)
    assert set(why.values()) == {"`iverilog` is not on PATH"}
    assert len(why) == 2
