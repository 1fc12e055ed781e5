"""Tests of what counts bins, and of the database that keeps the counts."""

import json
from pathlib import Path

import numpy as np
import pytest

from verif.env.coverage import database
from verif.env.coverage.classes import told, values
from verif.env.coverage.collector import Collector
from verif.env.coverage.database import Record
from verif.env.coverage.points import Coverage, Recipe, Samples
from verif.env.unit import Parameters

STATE = values("state", "", {"idle": (0, Recipe("wait")), "busy": (1, Recipe("start"))})
RESET = told("reset", "", {"busy": "reset while busy"})
COVERAGE = Coverage((STATE, RESET))


def _states(*states: int) -> Samples:
    return {"state": np.array(states, dtype=np.int64)}


def _counted(*states: int) -> Collector:
    collector = Collector(COVERAGE, {})
    collector.add(_states(*states), clock=10)
    collector.flush(10)
    return collector


def test_every_column_that_hits_is_counted() -> None:
    assert _counted(0, 1, 1, 7).hits == {"state.idle": 1, "state.busy": 2, "reset.busy": 0}


def test_nothing_is_counted_before_there_is_enough_or_a_flush() -> None:
    collector = Collector(COVERAGE, {})
    collector.add(_states(0), clock=1)
    assert not any(collector.hits.values())


def test_many_samples_are_counted_without_a_flush() -> None:
    collector = Collector(COVERAGE, {})
    collector.add(_states(*[1] * 10_000), clock=1)
    assert collector.hits["state.busy"] == 10_000


def test_what_the_bench_tells_is_counted() -> None:
    collector = _counted(0)
    collector.tell("reset.busy", clock=3, times=2)
    assert collector.hits["reset.busy"] == 2


def test_a_bin_that_there_is_not_cannot_be_told() -> None:
    with pytest.raises(KeyError):
        _counted(0).tell("reset.idle", clock=3)


def test_holes_are_what_was_not_hit_with_their_recipes() -> None:
    assert {name: recipe.name for name, recipe in _counted(1).holes().items()} == {
        "state.idle": "wait",
        "reset.busy": "reset while busy",
    }


def test_what_others_have_hit_is_no_hole_and_is_in_the_curve() -> None:
    collector = Collector(COVERAGE, {}, known=("state.idle", "reset.busy"))
    collector.add(_states(1), clock=5)
    collector.flush(5)
    assert (collector.holes(), collector.curve) == ({}, [(5, 3)])


def test_the_curve_grows_with_the_clocks() -> None:
    collector = _counted(0)
    collector.add(_states(1), clock=20)
    collector.flush(20)
    collector.flush(30)
    assert collector.curve == [(10, 1), (20, 2)]


def test_stages_are_computed_once_for_all_bins() -> None:
    calls = []

    def stages(_p: Parameters, samples: Samples) -> Samples:
        calls.append(len(samples))
        return {"state": samples["port"] + 1}

    collector = Collector(Coverage((STATE,), stages=stages), {})
    collector.add({"port": np.array([-1, 0])}, clock=1)
    collector.flush(1)
    assert (calls, collector.hits) == ([1], {"state.idle": 1, "state.busy": 1})


def test_a_record_comes_back_as_it_was_written(tmp_path: Path) -> None:
    record = _counted(0, 1).record("fifo", "default", "a_test", clocks=10)
    record.write(tmp_path)
    assert database.of_run(tmp_path) == [record]


def test_merging_adds_hits_by_unit_in_any_order() -> None:
    records = [
        Record("fifo", "default", "one", {"p.a": 1, "p.b": 0}),
        Record("fifo", "wide", "two", {"p.a": 2}),
    ]
    wanted = {"fifo": {"p.a": 3, "p.b": 0}}
    assert database.merged(records) == database.merged(records[::-1]) == wanted


@pytest.mark.parametrize("text", ["{", "{}", json.dumps({"unit": "fifo", "curve": []})])
def test_what_is_no_record_is_refused_with_its_file(tmp_path: Path, text: str) -> None:
    path = tmp_path / "a_test.json"
    path.write_text(text)
    with pytest.raises(ValueError, match=r"a_test\.json: is no record"):
        database.read(path)
