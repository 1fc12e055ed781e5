"""Lists: every one can be run, and each mistake in one is a sentence with file, entry, field and remedy."""

from pathlib import Path

import pytest

from regressions import lists
from regressions.__main__ import main
from regressions.expand import chosen, derived, expand
from regressions.lists import Kind, ListError
from verif.core.cases import CASES
from verif.env import units
from verif.env.simulators import Simulator

_HEAD = 'about = "tried"\n[[entry]]\nname = "a"\n'


def _written(tmp_path: Path, text: str) -> str:
    path = tmp_path / "tried.toml"
    path.write_text(text)
    return str(path)


@pytest.mark.parametrize("name", lists.names())
def test_every_list_names_only_what_there_is(name: str) -> None:
    """Each entry has runs, each run an id of its own, a command and a limit."""
    found = lists.load(name)
    planned = expand(found, 1)
    assert {run.entry for run in planned} == {entry.name for entry in found.entries}
    assert len({run.id for run in planned}) == len(planned)
    assert all(run.command and run.wall_limit > 0 for run in planned)


def test_the_nightly_list_has_every_unit_set_simulator_and_case() -> None:
    """Nothing that a bench can run is left out."""
    planned = expand(lists.load("nightly"), 1)
    wanted = {
        f"{name}-{parameter_set}-{simulator}"
        for name in units.names()
        for parameter_set in units.find(name).parameter_sets()
        for simulator in Simulator
    }
    assert {run.test for run in planned if run.kind == Kind.UNIT} == wanted
    assert {run.test for run in planned if run.kind == Kind.CORE} == {str(case) for case in CASES}


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("about = ", "tried.toml: is not TOML"),
        ("[[entry]]\n", "about is missing; say in a sentence"),
        ('about = "a"\n', "holds no .*entry.*; a list of nothing would always pass"),
        ('about = "a"\nentries = 1\n', "entries is no field of a list; it has about and entry"),
        (_HEAD + 'kind = "unit"\n', "entry a: tests is missing"),
        (_HEAD + 'kind = "units"\ntests = ["*"]\n', "entry a: kind is 'units'; choose one of unit, core"),
        (_HEAD + 'kind = "unit"\ntests = "*"\n', r"entry a: tests is '\*'; write a list of texts"),
        (_HEAD + 'kind = "unit"\ntests = ["sqr"]\n', "entry a: tests: 'sqr' matches none of accumulator"),
        (_HEAD + 'kind = "unit"\ntests = ["sqrt"]\nsets = ["big"]\n', "entry a: sets: 'big' matches none of"),
        (_HEAD + 'kind = "unit"\ntests = ["sqrt"]\nseed = 2\n', "entry a: seed is no field; choose of name"),
        (_HEAD + 'kind = "unit"\ntests = ["sqrt"]\nseeds = 0\n', "entry a: seeds is 0; write at least 1"),
        (_HEAD + 'kind = "unit"\ntests = ["sqrt"]\nseeds = "2"\n', "seeds is '2'; write a whole number"),
        (
            _HEAD + 'kind = "unit"\ntests = ["sqrt"]\nwall_minutes = 0\n',
            "is 0; write more than 0",
        ),
        (_HEAD + 'kind = "unit"\ntests = ["sqrt"]\neach = true\n', "each is not for kind unit; leave it out"),
        (
            _HEAD + 'kind = "unit"\ntests = ["sqrt"]\nsimulators = ["vcs"]\n',
            "'vcs'; choose one",
        ),
        (_HEAD + 'kind = "core"\ntests = ["*"]\nbuilds = ["huge"]\n', "builds: 'huge' matches none of"),
        (_HEAD + 'kind = "pytest"\ntests = ["tests.py"]\n', "tests: 'tests.py' is no file or folder"),
        (_HEAD + 'kind = "module"\ntests = ["verif.nothing"]\n', "tests: 'verif.nothing' is no package"),
        (_HEAD * 2, "entry"),
    ],
)
def test_a_wrong_list_is_one_sentence(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], text: str, sentence: str
) -> None:
    """The command ends with exit code 2 before anything is run."""
    path = _written(tmp_path, text)
    with pytest.raises(ListError, match=sentence):
        expand(lists.load(path), 1)
    assert main(["run", path]) == 2
    told = capsys.readouterr().err
    assert len(told.splitlines()) == 1
    assert str(path) in told


def test_an_entry_that_is_there_twice_is_refused(tmp_path: Path) -> None:
    """Their runs could not be told apart."""
    entry = '[[entry]]\nname = "a"\nkind = "unit"\ntests = ["sqrt"]\n'
    with pytest.raises(ListError, match="entry a: name is there twice; choose another"):
        lists.load(_written(tmp_path, f'about = "tried"\n{entry}{entry}'))


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["run", "hourly"], "LIST=hourly: there is no such list; choose one of nightly, pull_request"),
        (["run", "smoke", "--seed", "-1"], "--seed -1: is 0 to"),
        (["run", "smoke", "--jobs", "0"], "--jobs 0: is at least 1"),
        (["run", "smoke", "--only", "sqr"], "sqr: matches none of"),
        (["rerun"], "rerun: name a run, or say --failed"),
        (["rerun", "a", "--of", "nothing"], "there is no such record"),
        (["show", "--of", "nothing"], "there is no such record"),
    ],
)
def test_a_wrong_request_is_one_sentence(
    capsys: pytest.CaptureFixture[str], words: list[str], sentence: str
) -> None:
    """With exit code 2."""
    assert main(words) == 2
    told = capsys.readouterr().err
    assert sentence in told
    assert len(told.splitlines()) == 1


def test_a_seed_follows_from_root_test_and_index_alone() -> None:
    """The same in every version: a record's root seed means the same runs for ever."""
    assert derived(1, "unit/sqrt-default-verilator", 0) == 2009394704
    planned = {run.test: run.seed for run in expand(lists.load("smoke"), 1)}
    again = {run.test: run.seed for run in expand(lists.load("nightly"), 1)}
    assert planned.items() <= again.items()


def test_seeds_are_distinct_and_no_simulator_refuses_them() -> None:
    """Between tests, indices and roots."""
    seeds = [
        derived(root, test, index) for root in range(10) for test in units.names() for index in range(20)
    ]
    assert len(set(seeds)) == len(seeds)
    assert all(0 < seed < 1 << 31 for seed in seeds)


def test_a_run_is_chosen_by_id_or_by_test(tmp_path: Path) -> None:
    """Brackets of pytest's names are meant as they stand."""
    planned = expand(lists.load("smoke"), 1)
    assert [run.unit for run in chosen(planned, "sqrt-default-verilator")] == ["sqrt"]
    assert [run.unit for run in chosen(planned, "units.sqrt-default-verilator.0")] == ["sqrt"]
    assert {run.kind for run in chosen(planned, "core.*")} == {Kind.CORE}


def test_commands_name_effort_and_seed(tmp_path: Path) -> None:
    """What a person types is what was run."""
    text = _HEAD + 'kind = "unit"\ntests = ["sqrt"]\nsets = ["narrow"]\nsimulators = ["icarus"]\n'
    (run,) = expand(lists.load(_written(tmp_path, f"{text}examples = 7\noperands = 9\n")), 1)
    assert run.command == (f"make unit UNIT=sqrt SIM=icarus SET=narrow EXAMPLES=7 OPERANDS=9 SEED={run.seed}")
    assert run.arguments[-2:] == ("--seed", str(run.seed))
