"""The verification plan: the project's own has no error, and each kind of error is found in a made-up one."""

import json
from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path

import pytest

from models.limits import Fault
from verif.plan import __main__ as command
from verif.plan.check import check
from verif.plan.inventory import CoverPoint, Inventory, inventory
from verif.plan.join import Standing, fold, join, join_rules
from verif.plan.read import named_test, read_plans, read_specification
from verif.plan.records import Kind, NamedTest, PlanError

_ROOT = """\
[[promise]]
id = "root.exact"
what = "The root is exact."
tests = ["it_is_exact", "verif/test_more.py::test_it"]
covers = ["root.remainder", "root.class.odd"]
rules = ["roots"]
"""
_SPECIFICATION = """\
[[rule]]
id = "roots"
section = "10.1.6"
text = "Roots are exact."
"""
_PLAN, _RULES = Path("verif/units/root/plan.toml"), Path("verif/plan/specification.toml")
_EXACT = NamedTest("verif.units.root.bench", "it_is_exact")
_MORE = NamedTest("verif/test_more.py", "test_it")
_THERE = Inventory(
    frozenset([_EXACT, _MORE]),
    (
        CoverPoint("root.remainder", "verif/units/root/coverage.py", ("zero", "most")),
        CoverPoint("root.class", "verif/units/root/coverage.py", ("odd",)),
    ),
    (_PLAN.parent,),
)


def _write(root: Path, plan: str = _ROOT, specification: str = _SPECIFICATION) -> None:
    for file, text in ((_PLAN, plan), (_RULES, specification)):
        (root / file).parent.mkdir(parents=True, exist_ok=True)
        (root / file).write_text(text)


def _findings(root: Path, there: Inventory = _THERE) -> list[str]:
    return [str(finding) for finding in check(read_plans(root), read_specification(root), there)]


def test_the_plan_of_the_project_has_no_error() -> None:
    """Every rule, fault, test, cover point and unit has a promise, and every promise names what there is."""
    assert [str(finding) for finding in check(read_plans(), read_specification(), inventory())] == []


def test_every_code_of_a_refused_frame_is_a_fault_of_the_specification() -> None:
    faults = {rule.id for rule in read_specification().rules if rule.kind is Kind.FAULT}
    assert {f"fault.{fault.name.lower()}" for fault in Fault if fault} <= faults


def test_tests_of_benches_and_of_pytest_are_found_without_running_them() -> None:
    tests = inventory().tests
    assert NamedTest("verif.units.sqrt.bench", "remainder_is_at_most_twice_the_root") in tests
    assert NamedTest("verif.core.rooms", "every_hit_splits_and_no_pixel_is_taken_for_long") in tests
    assert NamedTest("verif/test_units.py", "test_unit") in tests
    assert NamedTest("models/tests/test_pages.py", "test_the_header_is_what_the_tables_say") in tests


def test_whatever_pytest_collects_is_found(request: pytest.FixtureRequest) -> None:
    """In a run of all tests, that is all of them."""
    collected = {item.nodeid.partition("[")[0].partition("::") for item in request.session.items}
    assert {NamedTest(where, name) for where, _, name in collected} <= inventory().tests


def test_a_plan_in_which_everything_meets_has_no_error(tmp_path: Path) -> None:
    _write(tmp_path)
    assert _findings(tmp_path) == []


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        (
            'tests = ["it_is_exact", "verif/test_more.py::test_it"]\n',
            "",
            "root.exact: no test shows it; name one in `tests`",
        ),
        (
            '"it_is_exact", ',
            '"it_is_exact", "it_is_fast", ',
            "root.exact: verif.units.root.bench::it_is_fast is no test; correct the name",
        ),
        ('"it_is_exact", ', "", "verif.units.root.bench: it_is_exact: no promise needs this test; name it"),
        (
            ', "verif/test_more.py::test_it"',
            "",
            "verif/test_more.py: test_it: no promise needs this test; name it",
        ),
        (
            '"root.remainder"',
            '"root.remainder", "root.sign"',
            "root.exact: root.sign is no cover point or bin; correct the name",
        ),
        (
            '"root.class.odd"',
            '"root.class.odd", "root.class.even"',
            "root.exact: root.class.even is no cover point or bin; correct the name",
        ),
        (
            '"root.remainder", ',
            "",
            "verif/units/root/coverage.py: root.remainder: no promise needs this cover point; name it",
        ),
        (
            '"root.remainder"',
            '"root.remainder.zero"',
            "coverage.py: root.remainder: no promise needs these bins of it: root.remainder.most; name it",
        ),
        ('rules = ["roots"]', "", "specification.toml: roots: no promise fulfils this rule; name it"),
        (
            '["roots"]',
            '["roots", "stems"]',
            "root.exact: stems is no rule or fault; correct the name in `rules`",
        ),
        (
            '"root.exact"',
            '"stem.exact"',
            "stem.exact: is not named after its folder; begin the id with `roo",
        ),
        (_ROOT, "", "verif/units/root/plan.toml: root: the unit has no plan; write its promises there"),
        (_ROOT, _ROOT + _ROOT, "plan.toml: root.exact: 2 entries have this id; give each one of its own"),
    ],
)
def test_each_error_is_told_with_file_entry_and_remedy(
    old: str, new: str, expected: str, tmp_path: Path
) -> None:
    assert _ROOT.count(old) == 1
    _write(tmp_path, _ROOT.replace(old, new))
    assert any(expected in finding for finding in _findings(tmp_path)), _findings(tmp_path)


def test_a_fault_without_a_promise_is_told(tmp_path: Path) -> None:
    fault = '[[fault]]\nid = "fault.negative"\nsection = "4"\ntext = "A negative radicand is refused."\n'
    _write(tmp_path, specification=_SPECIFICATION + fault)
    assert _findings(tmp_path) == [
        "verif/plan/specification.toml: fault.negative: no promise fulfils this fault; "
        "name it in the `rules` of a promise in a plan.toml"
    ]


@pytest.mark.parametrize(
    ("plan", "expected"),
    [
        ("[[promise", r"plan\.toml: cannot be read: .*; correct the file"),
        ('[promise]\nid = "root.a"', r"plan\.toml: promise: is no table of a plan; write \[\[promise\]\]"),
        ('[[vow]]\nid = "root.a"', r"plan\.toml: vow: is no table of a plan; write \[\[promise\]\]"),
        (
            '[[promise]]\nwhat = "It."',
            r"plan\.toml: promise 1: id: is missing or no text; write it",
        ),
        ('[[promise]]\nid = "root.a"\nwhat = 3', r"root\.a: what: is missing or no text; write it"),
        (
            _ROOT.replace("covers", "cover"),
            r"root\.exact: cover: there is no such field; use id, what,",
        ),
        (
            _ROOT.replace('["roots"]', '"roots"'),
            r"root\.exact: rules: is no list of texts; write \[",
        ),
    ],
)
def test_a_plan_that_cannot_be_read_is_one_sentence(plan: str, expected: str, tmp_path: Path) -> None:
    _write(tmp_path, plan)
    with pytest.raises(PlanError, match=expected) as caught:
        read_plans(tmp_path)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("entry", "where", "name"),
    [
        ("it_is", "verif.core.bench", "it_is"),
        ("rooms::it_is", "verif.core.rooms", "it_is"),
        ("verif/test_core.py::test_it", "verif/test_core.py", "test_it"),
    ],
)
def test_an_entry_names_a_bench_of_its_folder_or_a_file_of_pytest(entry: str, where: str, name: str) -> None:
    assert named_test(entry, Path("verif/core")) == NamedTest(where, name)


_PASSED = {(_EXACT.where, _EXACT.name): "passed", (_MORE.where, _MORE.name): "passed"}
_HIT = {"root.remainder.zero": 3, "root.remainder.most": 1, "root.class.odd": 2, "root.class.even": 0}


@pytest.mark.parametrize(
    ("results", "coverage", "standing"),
    [
        ({}, {}, Standing.PASSED),
        ({_EXACT: "timed_out"}, {"root.class.odd": 0}, Standing.FAILED),
        ({_EXACT: "failed", _MORE: "not_run"}, {}, Standing.FAILED),
        ({_MORE: "not_run"}, {"root.class.odd": 0}, Standing.NOT_RUN),
        ({}, {"root.remainder.most": 0}, Standing.HOLE),
        ({}, {"root.class.odd": 0}, Standing.HOLE),
    ],
)
def test_a_promise_stands_as_its_tests_and_cover_points_do(
    results: Mapping[NamedTest, str], coverage: Mapping[str, int], standing: Standing, tmp_path: Path
) -> None:
    _write(tmp_path)
    changed = {(test.where, test.name): status for test, status in results.items()}
    (verdict,) = join(read_plans(tmp_path), _PASSED | changed, {**_HIT, **coverage})
    assert verdict.standing is standing
    (rule,) = join_rules(read_specification(tmp_path), [verdict])
    assert (rule.promises, rule.standing) == (("root.exact",), standing)


def test_a_test_that_nobody_ran_and_a_point_that_nobody_measured_are_no_pass(tmp_path: Path) -> None:
    _write(tmp_path)
    plans = read_plans(tmp_path)
    assert join(plans, {}, _HIT)[0].standing is Standing.NOT_RUN
    assert join(plans, _PASSED, {})[0].standing is Standing.HOLE


def test_a_bin_that_is_excluded_needs_no_hit(tmp_path: Path) -> None:
    _write(tmp_path)
    plans, coverage = read_plans(tmp_path), {**_HIT, "root.class.odd": 0}
    assert join(plans, _PASSED, coverage, {"root.class.odd"})[0].standing is Standing.PASSED
    assert join(plans, _PASSED, coverage, {"root.class.even"})[0].standing is Standing.HOLE


def test_a_verdict_says_of_each_test_and_point_how_it_stands_and_is_json(tmp_path: Path) -> None:
    _write(tmp_path)
    (verdict,) = join(read_plans(tmp_path), _PASSED, _HIT | {"root.remainder.most": 0})
    told = json.loads(json.dumps(asdict(verdict)))
    assert told["tests"] == {str(_EXACT): "passed", str(_MORE): "passed"}
    assert told["points"] == {"root.remainder": [1, 2], "root.class.odd": [1, 1]}
    assert told["standing"] == "hole"


def test_runs_of_a_test_with_other_parameters_are_one_result_and_the_worst_counts() -> None:
    runs = [("a.py", "test_x[1]", "passed"), ("a.py", "test_x[2]", "not_run"), ("b", "it/size=3", "passed")]
    assert fold(runs) == {("a.py", "test_x"): "not_run", ("b", "it"): "passed"}
    assert fold([*runs, ("a.py", "test_x[0]", "killed")])[("a.py", "test_x")] == "killed"


def test_a_rule_that_no_promise_fulfils_is_no_pass() -> None:
    assert {rule.standing for rule in join_rules(read_specification(), [])} == {Standing.NOT_RUN}


def test_the_command_shows_plans_and_the_specification(capsys: pytest.CaptureFixture[str]) -> None:
    assert command.main(["show", "sqrt"]) == 0
    said = capsys.readouterr().out
    assert "sqrt.exact" in said and "verif.units.sqrt.bench::remainder_is_at_most_twice_the_root" in said
    assert command.main(["show", "specification"]) == 0
    assert "fault.kind (fault" in capsys.readouterr().out


def test_a_plan_that_is_not_there_ends_the_command_with_2(capsys: pytest.CaptureFixture[str]) -> None:
    assert command.main(["show", "stem"]) == 2
    assert capsys.readouterr().err.startswith("stem: there is no such plan; choose one of ")


@pytest.mark.parametrize(
    ("plan", "code", "said"),
    [(_ROOT, 0, "0 errors\n"), (_ROOT.replace('"roots"', ""), 1, "1 errors\n"), ("[[", 2, "")],
)
def test_the_command_ends_with_1_where_there_is_an_error_and_with_2_where_a_plan_cannot_be_read(
    plan: str,
    code: int,
    said: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    _write(tmp_path, plan)
    monkeypatch.setattr(command, "read_plans", lambda: read_plans(tmp_path))
    monkeypatch.setattr(command, "read_specification", lambda: read_specification(tmp_path))
    monkeypatch.setattr(command, "inventory", lambda: _THERE)
    assert command.main(["check"]) == code
    told = capsys.readouterr()
    assert told.out.endswith(said)
    assert len(told.err.splitlines()) == bool(code)
