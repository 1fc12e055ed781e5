"""Runs: how each way of ending is told, and that nothing passes in silence."""

import json
import time
from dataclasses import replace
from pathlib import Path
from threading import Event, Timer

import pytest

from regressions import lists
from regressions.execute import execute
from regressions.expand import chosen, expand
from regressions.lists import Kind
from regressions.outcome import Ended, judged, trimmed
from regressions.record import Result, Status
from regressions.tests.planned import of_pytest, of_python
from regressions.triage import buckets
from verif.env import sources
from verif.env.simulators import available


def test_a_run_that_ends_well_passes(tmp_path: Path) -> None:
    """What it printed is in its folder."""
    result = execute(of_python("fine", "print('all is well')"), tmp_path / "run", Event())
    assert result.status is Status.PASSED
    assert result.message == ""
    assert "all is well" in (tmp_path / "run" / "log.txt").read_text()


def test_a_run_that_exits_with_another_code_fails_with_its_last_words(tmp_path: Path) -> None:
    """The message is the end of what it printed, which the last line heads, and so its bucket."""
    code = "print('a/b 1/2 -', flush=True)\nraise SystemExit('the end of 3')"
    result = execute(of_python("bad", code), tmp_path / "run", Event())
    assert result.status is Status.FAILED
    assert result.message.splitlines() == ["the end of 3", "", "a/b 1/2 -"]
    assert [bucket.message for bucket in buckets([result])] == ["the end of #"]


def _alive(process: int) -> bool:
    """It is there, and no mere entry whose parent has not looked."""
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except FileNotFoundError:
        return False


def test_the_wall_clock_limit_ends_a_run_and_all_that_it_started(tmp_path: Path) -> None:
    """Also what does not listen to a request to end."""
    code = (
        "import signal, subprocess, sys, time\n"
        "signal.signal(signal.SIGTERM, signal.SIG_IGN)\n"
        "child = subprocess.Popen([sys.executable, '-c', 'import time; time.sleep(600)'])\n"
        "print(child.pid, flush=True)\n"
        "time.sleep(600)\n"
    )
    start = time.monotonic()
    result = execute(of_python("endless", code, wall_limit=1.0), tmp_path / "run", Event())
    assert result.status is Status.TIMED_OUT
    assert result.message == "1 s of wall-clock time are over"
    assert time.monotonic() - start < 30
    child = int((tmp_path / "run" / "log.txt").read_text())
    deadline = time.monotonic() + 5
    while _alive(child) and time.monotonic() < deadline:
        time.sleep(0.05)
    assert not _alive(child)


def test_a_run_that_a_signal_ended_is_killed(tmp_path: Path) -> None:
    """As where memory runs out."""
    code = "import os, signal; os.kill(os.getpid(), signal.SIGKILL)"
    result = execute(of_python("killed", code), tmp_path / "run", Event())
    assert result.status is Status.KILLED
    assert "SIGKILL" in result.message


def test_a_run_that_is_interrupted_has_not_run(tmp_path: Path) -> None:
    """It ends at once."""
    stop = Event()
    Timer(0.5, stop.set).start()
    result = execute(of_python("long", "import time; time.sleep(600)"), tmp_path / "run", stop)
    assert result.status is Status.NOT_RUN
    assert result.seconds < 30


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("", "no tests ran"),
        # What is tried here is a skip itself: a run whose every test skips must not pass.
        ("import pytest\n@pytest.mark.skip(reason='never')\ndef test_it():\n    assert 0\n", "no test ran"),
        ("def test_it():\n    assert 1 + 1 == 3\n", "assert (1 + 1) == 3"),
        ("import os\ndef test_it():\n    os._exit(0)\n", "no test ran"),
    ],
)
def test_no_test_and_no_results_are_failures(tmp_path: Path, text: str, told: str) -> None:
    """Exit code 0 or not."""
    (tmp_path / "test_tried.py").write_text(text)
    result = execute(of_pytest("tried", str(tmp_path / "test_tried.py")), tmp_path / "run", Event())
    assert result.status is Status.FAILED
    assert told in result.message


def test_a_test_that_passed_is_a_check_of_its_file(tmp_path: Path) -> None:
    """By which the plan knows it."""
    result = execute(of_pytest("tried", "models/tests/test_stages.py"), tmp_path / "run", Event())
    assert result.status is Status.PASSED
    assert {check.where for check in result.checks} == {"models/tests/test_stages.py"}


def _short_run() -> Result:
    """A run of a small unit, on the simulator that builds it fastest."""
    name = f"add_sub-narrow-{available()[-1]}"
    (run,) = chosen(expand(lists.load("pull_request"), 1), name)
    return run


def test_the_limit_of_simulated_time_ends_a_run(tmp_path: Path) -> None:
    """The message says which limit, of which simulation."""
    result = execute(replace(_short_run(), simulated_limit=3000.0), tmp_path / "run", Event())
    assert result.status is Status.TIMED_OUT
    assert "3000 ns of simulated time are over" in result.message


def test_a_bench_that_passes_tells_each_test_and_its_simulated_time(tmp_path: Path) -> None:
    """The wall-clock and the simulated time are those of the run; coverage lies in its folder."""
    result = execute(_short_run(), tmp_path / "run", Event())
    assert result.status is Status.PASSED
    names = {check.name for check in result.checks if check.where == "verif.units.add_sub.bench"}
    assert "every_operand_drawn_gives_the_models_result" in names
    assert result.simulated_ns > 1000
    assert result.seconds > 0


def _outcome(folder: Path, **changes: object) -> None:
    """What a simulation leaves, changed."""
    found = {
        "directory": "tried",
        "exit_ok": True,
        "module": "verif.tried",
        "tests": {"it_works": None},
        "simulated_ns": {"it_works": 10.0},
        "signal": 0,
        "limit": "",
    }
    path = folder / "runs" / "tried" / "outcome.json"
    path.parent.mkdir(parents=True)
    path.write_text(json.dumps({**found, **changes}))


def _judged(folder: Path, code: int = 0) -> Result:
    return judged(replace(of_python("tried", ""), kind=Kind.UNIT), folder, Ended(code, 1.0))


def test_a_simulator_that_a_signal_ended_makes_its_run_killed(tmp_path: Path) -> None:
    """Although pytest itself ended with 1."""
    _outcome(tmp_path, signal=9)
    assert _judged(tmp_path, code=1).status is Status.KILLED


def test_a_failed_bench_is_no_pass_whatever_the_exit_code(tmp_path: Path) -> None:
    """The shrunk example comes first, without a traceback."""
    text = "failure sum is 3 Traceback (most recent call last):\n  File x\nFailing test case: example(1)"
    _outcome(tmp_path, tests={"a": "failure early", "b": text}, simulated_ns={"a": 1.0, "b": 2.0})
    result = _judged(tmp_path)
    assert result.status is Status.FAILED
    assert result.message == "b: sum is 3\nFailing test case: example(1)\n\na: early"


def test_a_bench_that_fails_as_a_test_wants_it_to_is_no_failure(tmp_path: Path) -> None:
    """Tests that break a design on purpose say themselves whether all is well."""
    case = '<testsuite><testcase classname="verif.test_breaks" name="test_it"/></testsuite>'
    (tmp_path / "pytest.xml").write_text(case)
    _outcome(tmp_path, tests={"a": "failure as wanted"}, simulated_ns={"a": 1.0})
    planned = replace(of_python("tried", ""), kind=Kind.PYTEST)
    assert judged(planned, tmp_path, Ended(0, 1.0)).status is Status.PASSED
    assert judged(planned, tmp_path, Ended(1, 1.0)).status is Status.FAILED


def test_a_simulation_without_results_is_no_pass(tmp_path: Path) -> None:
    """Exit code 0 alone says nothing."""
    assert _judged(tmp_path).status is Status.FAILED
    _outcome(tmp_path, tests={}, simulated_ns={})
    assert _judged(tmp_path).status is Status.FAILED


def test_what_steers_runs_does_not_reach_them(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A run is what its command says, whatever the environment."""
    monkeypatch.setenv("WAVES", "1")
    monkeypatch.setenv("COCOTB_TEST_FILTER", "nothing")
    code = "import os; print(sorted({'WAVES', 'COCOTB_TEST_FILTER'} & set(os.environ)))"
    execute(of_python("tried", code), tmp_path / "run", Event())
    assert (tmp_path / "run" / "log.txt").read_text() == "[]\n"


def test_messages_do_not_name_this_machine_s_folders() -> None:
    """Paths are seen from the root of the project."""
    assert trimmed(f"log: {sources.ROOT}/build/sim.log") == "log: build/sim.log"
