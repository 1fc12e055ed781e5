"""What the page of a regression is drawn from: gains, places of declarations, sources, compact tables."""

import json
import re
import subprocess
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from regressions import record
from regressions.record import CodeKind, Record, Status
from regressions.report import __main__ as command
from regressions.report.data import sections
from regressions.report.gains import Gain, gains
from regressions.report.page import PAGE, page
from regressions.report.places import Places
from regressions.report.texts import Texts, texts
from regressions.tests import synthetic
from verif.env.sources import ROOT

MOST_SECONDS, MOST_BYTES = 30, 10_000_000


@pytest.fixture(scope="module")
def some() -> Record:
    """A small record with everything in it."""
    return synthetic.record(1)


@given(st.lists(st.sets(st.integers(0, 5))))
def test_gains_are_what_counting_one_by_one_gives(hitters: list[set[int]]) -> None:
    expected = tuple(
        Gain(
            sum(test in found for found in hitters),
            sum(found == {test} for found in hitters),
            sum(bool(found) and min(found) == test for found in hitters),
        )
        for test in range(6)
    )
    assert gains(hitters, 6) == expected


def test_what_each_test_adds_in_order_is_all_that_is_hit() -> None:
    generator = np.random.default_rng(1)
    hitters = [np.flatnonzero(generator.random(9) < 0.2).tolist() for _ in range(50)]
    assert sum(gain.more for gain in gains(hitters, 9)) == sum(bool(found) for found in hitters)


_DECLARED = """
A = Point(
    "remainder",
    "what is left",
    (
        Bin("zero", X),
        Bin("one", X),
    ),
)
IDLE, STALL = "idle", "stall"
COVERAGE = Coverage((A, operand(ports, "radicand")))
"""


@pytest.mark.parametrize(
    ("point", "name", "line"),
    [("remainder", "zero", 6), ("remainder", "two", 3), ("radicand", "zero", 11), ("idle", "none", 10)],
)
def test_a_bin_is_shown_where_it_or_its_point_is_declared(point: str, name: str, line: int) -> None:
    places = Places({"verif/units/sqrt/coverage.py": _DECLARED})
    assert places.bin("sqrt", point, name) == ("verif/units/sqrt/coverage.py", line)


def test_a_point_that_no_literal_names_is_shown_at_the_units_coverage() -> None:
    places = Places({"verif/units/sqrt/coverage.py": _DECLARED})
    assert places.point("sqrt", "made_by_a_loop") == ("verif/units/sqrt/coverage.py", 11)


def test_a_unit_that_declares_no_points_is_shown_at_its_module() -> None:
    places = Places({"hdl/arith/sqrt.v": "// Square root.\nmodule sqrt (\n);\n"})
    assert places.bin("sqrt", "remainder", "zero") == ("hdl/arith/sqrt.v", 2)


def test_nothing_is_shown_of_a_unit_that_is_nowhere() -> None:
    assert Places({}).bin("sqrt", "remainder", "zero") is None


def test_a_promise_is_shown_where_its_id_is() -> None:
    places = Places({"plan.toml": '[[promise]]\nid = "a.exact"\n[[promise]]\nid = "a.rate"\n'})
    assert places.promise("plan.toml", "a.rate") == ("plan.toml", 4)


def _head() -> str:
    return subprocess.run(
        ["git", "rev-parse", "HEAD"], cwd=ROOT, capture_output=True, text=True, check=True
    ).stdout.strip()


def test_sources_are_those_of_the_revision(some: Record) -> None:
    clean = replace(some, dirty=False, revision=_head())
    committed = subprocess.run(
        ["git", "show", "HEAD:hdl/arith/sqrt.v"], cwd=ROOT, capture_output=True, text=True, check=True
    )
    found = texts(clean)
    assert (found.files["hdl/arith/sqrt.v"], found.note) == (committed.stdout, "")


def test_sources_of_a_revision_that_is_not_here_are_those_that_are_and_the_page_says_so(some: Record) -> None:
    found = texts(replace(some, dirty=False, revision="1" * 40))
    now = (ROOT / "hdl/arith/sqrt.v").read_text()
    assert (found.files["hdl/arith/sqrt.v"], "not in this clone" in found.note) == (now, True)


def test_only_files_of_the_project_are_shown(some: Record) -> None:
    elsewhere = replace(some.plan[0], file="../../etc/passwd")
    found = texts(replace(some, plan=(elsewhere,)))
    assert not [path for path in found.files if path.startswith((".", "/"))]


def test_every_toggle_is_on_the_page(some: Record) -> None:
    found = sections(some, Texts())["code"]["toggles"]
    told = sum(len(hits) // 2 for rows in found.values() for *_, hits in rows)
    assert told == sum(p.kind is CodeKind.TOGGLE for file in some.code for p in file.points)


def test_the_page_refers_to_nothing_outside_itself(some: Record) -> None:
    outside = re.compile(r'(src|href)="(?!#|data:)|@import|url\(|fetch\(|XMLHttpRequest|import\(')
    text = re.sub(r'<script type="application/json".*?</script>', "", page(some), flags=re.DOTALL)
    assert not outside.search(text)


def test_no_text_of_a_record_ends_the_element_it_is_in(some: Record) -> None:
    assert synthetic.HOSTILE in some.results[0].message
    assert "</script><img" not in page(some)


def test_a_page_of_more_than_a_nightly_is_drawn_in_time_and_is_no_larger_than_a_browser_likes(
    tmp_path: Path,
) -> None:
    path = tmp_path / "record.json"
    record.write(synthetic.record(1, synthetic.LARGE), path)
    # Of the processor, since tests share it.
    start = time.process_time()
    assert command.main(["--record", str(path)]) == 0
    assert time.process_time() - start < MOST_SECONDS
    assert (tmp_path / PAGE).stat().st_size < MOST_BYTES


def test_without_a_record_a_sentence_names_the_remedy(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert command.main(["--record", str(tmp_path / "record.json")]) == 2
    assert "make smoke" in capsys.readouterr().err


def test_what_is_no_record_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "record.json").write_text(json.dumps({"schema": -1}))
    assert command.main(["--record", str(tmp_path / "record.json")]) == 2
    assert "schema" in capsys.readouterr().err


def test_a_folder_that_is_not_there_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    record.write(synthetic.record(1), tmp_path / "record.json")
    words = ["--record", str(tmp_path / "record.json"), "--out", str(tmp_path / "none" / "page.html")]
    assert command.main(words) == 2
    assert "is no folder" in capsys.readouterr().err


def test_synthetic_records_repeat_by_their_seed() -> None:
    assert synthetic.record(7) == synthetic.record(7) != synthetic.record(8)


def test_synthetic_records_have_every_end(some: Record) -> None:
    large = synthetic.record(1, replace(synthetic.LARGE, points=0))
    assert all(large.counts()[status] for status in Status)
