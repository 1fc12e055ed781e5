"""Runs to try things on: a few lines of Python each."""

from regressions.lists import Kind
from regressions.record import Result, Status


def of_python(name: str, code: str, wall_limit: float = 60.0) -> Result:
    """A planned run of some Python."""
    return Result(
        id=name,
        entry="tried",
        kind=Kind.MODULE,
        test=name,
        index=0,
        seed=1,
        status=Status.NOT_RUN,
        seconds=0.0,
        command=f"python -c {name}",
        folder="",
        arguments=("-c", code),
        wall_limit=wall_limit,
    )


def of_pytest(name: str, path: str) -> Result:
    """A planned run of a file of tests."""
    run = of_python(name, "")
    return Result(**{**vars(run), "kind": Kind.PYTEST, "arguments": ("-m", "pytest", path)})
