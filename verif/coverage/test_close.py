"""Tests of closure on a design whose runs are made up: sets one after the other, holes, stale exclusions."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import pytest

from verif.coverage.close import Closed, ClosureError, close, read
from verif.coverage.designs import Design
from verif.env.coverage.classes import values
from verif.env.coverage.database import Record
from verif.env.coverage.points import Coverage, Recipe
from verif.env.run import Outcome

COVERAGE = Coverage(
    (values("state", "", {name: (code, Recipe(f"go {name}")) for code, name in enumerate(("a", "b", "c"))}),)
)
BINS = [name for name, _ in COVERAGE.bins()]
EXCLUSION = """
[[exclude]]
bin = "state.c"
reason = "the encoding has two states"
owner = "verification"
review = 2999-01-01
"""
CLOCKS = 10


class Runs:
    """Directed runs hit bins by their parameter set; undirected ones hit the first bin."""

    def __init__(self, folder: Path, hits: Mapping[str, Sequence[str]], passed: bool = True) -> None:
        self.folder, self.hits, self.passed = folder, hits, passed
        self.asked: list[tuple[str, str, list[str]]] = []

    def __call__(
        self, parameter_set: str, seed: int, known: Sequence[str], extra: Mapping[str, Any]
    ) -> Outcome:
        """Leaves a record as a simulation does."""
        self.asked.append((extra["mode"], parameter_set, list(known)))
        directed = extra["mode"] == "directed"
        reached = self.hits[parameter_set] if directed else BINS[:1]
        hits = {name: int(name in reached) for name in BINS}
        clocks = CLOCKS if directed else extra["clocks"]
        curve = ((clocks, len({*known, *reached})),)
        directory = self.folder / f"{extra['mode']}-{parameter_set}"
        directory.mkdir(exist_ok=True)
        Record("fake", parameter_set, "closure", hits, curve, clocks).write(directory)
        return Outcome(directory, exit_ok=self.passed, tests={"closure": None})


def _design(runs: Runs, exclusions: str = "") -> Design:
    path = runs.folder / "exclusions.toml"
    path.write_text(exclusions)
    return Design("fake", COVERAGE, tuple(runs.hits), path, runs)


def _closed(runs: Runs, exclusions: str = "", compare: bool = False) -> Closed:
    return close(_design(runs, exclusions), seed=1, seconds=60.0, compare=compare, tell=lambda _text: None)


def test_sets_are_played_until_nothing_is_left(tmp_path: Path) -> None:
    runs = Runs(tmp_path, {"default": BINS[:2], "narrow": BINS[2:], "wide": []})
    closed = _closed(runs)
    assert (closed.holes, closed.sets, closed.clocks) == ((), ("default", "narrow"), 2 * CLOCKS)


def test_a_set_knows_what_those_before_it_have_hit(tmp_path: Path) -> None:
    runs = Runs(tmp_path, {"default": BINS[:2], "narrow": BINS[2:]})
    _closed(runs)
    assert [known for _, _, known in runs.asked] == [[], BINS[:2]]


def test_what_no_set_hits_is_a_hole(tmp_path: Path) -> None:
    assert _closed(Runs(tmp_path, {"default": BINS[:2]})).holes == ("state.c",)


def test_an_excluded_bin_is_no_hole_and_no_bin(tmp_path: Path) -> None:
    closed = _closed(Runs(tmp_path, {"default": BINS[:2]}), EXCLUSION)
    assert (closed.holes, closed.bins, closed.directed[-1]) == ((), 2, (CLOCKS, 2))


def test_an_exclusion_of_what_was_hit_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(ClosureError, match=r"excludes state\.c, which was hit; take it out"):
        _closed(Runs(tmp_path, {"default": BINS}), EXCLUSION)


def test_a_portion_that_fails_is_a_bug_and_no_hole(tmp_path: Path) -> None:
    with pytest.raises(ClosureError, match="fake, default"):
        _closed(Runs(tmp_path, {"default": BINS}, passed=False))


def test_undirected_stimulus_plays_the_sets_that_were_needed(tmp_path: Path) -> None:
    runs = Runs(tmp_path, {"default": BINS, "narrow": []})
    closed = _closed(runs, compare=True)
    assert [(mode, name) for mode, name, _ in runs.asked] == [
        ("directed", "default"),
        ("undirected", "default"),
    ]
    assert closed.random_bins == 1


def test_the_factor_is_a_lower_bound_where_undirected_stimulus_never_gets_there(tmp_path: Path) -> None:
    closed = _closed(Runs(tmp_path, {"default": BINS}), compare=True)
    assert closed.factor == (closed.undirected_clocks / CLOCKS, True)


def test_what_was_written_is_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("verif.coverage.close.FOLDER", tmp_path / "closure")
    closed = _closed(Runs(tmp_path, {"default": BINS}), compare=True)
    assert read(closed.write()) == closed
