"""What a finished run left in its folder, and the verdict on it: silence is never a pass."""

import json
import signal
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from regressions.lists import Kind
from regressions.record import Check, Result, Status
from verif.env import run, sources

LOG = "log.txt"
"""All that a run printed."""

PYTEST = "pytest.xml"
RUNS = "runs"

_TRACEBACK = "Traceback (most recent call last):"
_EXAMPLE = ("Failing test case:", "Falsifying example:")
"""How Hypothesis begins to tell the shrunk example, after the traceback."""

_LAST_LINES = 15


@dataclass(frozen=True)
class Ended:
    """How a run's process ended: exit code, below 0 for a signal; why it was stopped, if it was: a status and
    a sentence."""

    code: int
    seconds: float
    stopped: tuple[Status, str] | None = None


def judged(planned: Result, folder: Path, ended: Ended) -> Result:
    """The result of a run."""
    left = simulations(folder)
    if planned.kind == Kind.PYTEST and not ended.code:
        # Such tests also break a design and see that its bench fails, which is then as it should be.
        left = tuple(outcome for outcome in left if sound(outcome))
    checks = tuple(_checks(planned, folder, left, ended))
    status, message = _verdict(checks, left, ended)
    return replace(
        planned,
        status=status,
        seconds=round(ended.seconds, 3),
        message=local(message or _told(checks) or _tail(folder)) if status is not Status.PASSED else "",
        simulated_ns=sum(check.simulated_ns for check in checks),
        checks=checks,
    )


def simulations(folder: Path) -> tuple[Any, ...]:
    """What each simulation of a run said of itself, see `verif.env.run.Outcome`."""
    return tuple(json.loads(path.read_text()) for path in sorted(folder.glob(f"{RUNS}/*/{run.OUTCOME}")))


def sound(outcome: Any) -> bool:
    """A simulation ended by itself, tested something, and nothing failed."""
    return bool(outcome["exit_ok"] and outcome["tests"] and not any(outcome["tests"].values()))


def local(text: str) -> str:
    """A message without the folder of the project, which is another one elsewhere."""
    return text.replace(f"{sources.ROOT}/", "")


def shrunk(text: str) -> bool:
    """The message tells the smallest example that fails."""
    return any(start in text for start in _EXAMPLE)


def _verdict(checks: Sequence[Check], left: Sequence[Any], ended: Ended) -> tuple[Status, str]:
    """Status, and a sentence where no check's message tells more."""
    if ended.stopped:
        return ended.stopped
    for outcome in left:
        if outcome["limit"]:
            return Status.TIMED_OUT, f"{outcome['directory']}: {outcome['limit']}"
    for number in (-ended.code, *(outcome["signal"] for outcome in left)):
        if number > 0:
            return Status.KILLED, f"ended by {_name(number)}, which the regression did not send"
    if not any(not check.skipped for check in checks):
        return Status.FAILED, "" if ended.code else "no test ran"
    failed = ended.code != 0 or any(check.message for check in checks)
    return (Status.FAILED if failed else Status.PASSED), ""


def _name(number: int) -> str:
    try:
        return signal.Signals(number).name
    except ValueError:
        return f"signal {number}"


def _checks(planned: Result, folder: Path, left: Sequence[Any], ended: Ended) -> Iterator[Check]:
    """The tests inside a run: pytest's, and cocotb's in each simulation that it started; a module is one."""
    if planned.kind == Kind.MODULE:
        yield Check(planned.test, message=_tail(folder) if ended.code else "")
        return
    for outcome in left:
        for name, text in outcome["tests"].items():
            yield Check(
                name, outcome["module"], trimmed(text or ""), simulated_ns=outcome["simulated_ns"][name]
            )
    yield from _of_pytest(folder / PYTEST)


def _of_pytest(path: Path) -> Iterator[Check]:
    if not path.exists():
        return
    for case in ElementTree.parse(path).getroot().iter("testcase"):
        where = f"{case.get('classname', '').replace('.', '/')}.py"
        failed = [case.find(kind) for kind in ("failure", "error")]
        text = "\n".join(element.get("message", "") for element in failed if element is not None)
        skip = case.find("skipped")
        skipped = "" if skip is None else skip.get("message") or "skipped"
        yield Check(case.get("name", "?"), where, trimmed(text), skipped)


def trimmed(text: str) -> str:
    """A failure without its traceback: what was wrong, and the example that shows it."""
    head, _, rest = local(text).removeprefix("failure ").partition(_TRACEBACK)
    starts = [rest.index(start) for start in _EXAMPLE if start in rest]
    return "\n".join(part.strip() for part in (head, rest[min(starts) :] if starts else "") if part.strip())


def _told(checks: Sequence[Check]) -> str:
    """The failed checks' messages, those with the smallest example first. What pytest says of a simulation is
    left out where the simulation has said it."""
    failed = sorted((c for c in checks if c.message), key=lambda check: not shrunk(check.message))
    failed = [check for check in failed if check.where.startswith("verif.")] or failed
    return "\n\n".join(f"{check.name}: {check.message}" if check.where else check.message for check in failed)


def _tail(folder: Path) -> str:
    """The end of what was printed, its last line first: that is what a program says of itself."""
    log = folder / LOG
    lines = log.read_text(errors="replace").rstrip().splitlines() if log.exists() else []
    if not lines:
        return "nothing was printed"
    *before, last = lines[-_LAST_LINES:]
    return "\n".join([last, "", *before]) if before else last
