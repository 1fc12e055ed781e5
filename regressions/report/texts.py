"""The sources as they were when a regression ran: at its revision, or as they are now where that is lost."""

import subprocess
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath

from regressions.record import Record
from verif.env.sources import ROOT

_FOLDERS = ("hdl", "verif", "models", "regressions")
_SHARED = ("verif/env/coverage/classes.py", "verif/env/coverage/flow.py")
_SHOWN = ("coverage.py", "plan.toml", "specification.toml")


@dataclass(frozen=True)
class Texts:
    """Texts by path from the project's root; note: why they may not be those that ran, empty if they are."""

    files: Mapping[str, str] = field(default_factory=dict)
    note: str = ""


def texts(record: Record) -> Texts:
    """Everything that a page shows: the design, what declares cover points, and what the record names."""
    named = {file.path for file in record.code}
    named |= {mutant.file for unit in record.mutation for mutant in unit.survivors}
    named |= {promise.file for promise in record.plan}
    if not record.dirty and (found := _at_revision(record.revision, named)):
        return Texts(found)
    why = (
        "the tree had changes that were not committed"
        if record.dirty
        else f"revision {record.revision[:12] or 'unknown'} is not in this clone"
    )
    return Texts(dict(_working_tree(named)), f"sources are shown as they are now, for {why}")


def _wanted(path: str, named: Collection[str]) -> bool:
    name = PurePosixPath(path)
    design = name.suffix in (".v", ".vh") and name.parts[0] == "hdl"
    return design or name.name in _SHOWN or path in _SHARED or path in named


def _working_tree(named: Collection[str]) -> Iterator[tuple[str, str]]:
    for folder in _FOLDERS:
        for path in sorted((ROOT / folder).rglob("*.*")):
            name = path.relative_to(ROOT).as_posix()
            if _wanted(name, named) and path.is_file():
                yield name, path.read_text(errors="replace")


def _at_revision(revision: str, named: Collection[str]) -> dict[str, str]:
    """From git; empty where it does not know the revision."""
    listed = _git(["ls-tree", "-r", "--name-only", "-z", revision or "-", *_FOLDERS])
    paths = [path for path in listed.decode().split("\0") if path and _wanted(path, named)]
    asked = "".join(f"{revision}:{path}\n" for path in paths)
    answer = _git(["cat-file", "--batch"], asked.encode()) if paths else b""
    return dict(zip(paths, _contents(answer), strict=True))


def _contents(batch: bytes) -> Iterator[str]:
    """The files in what `git cat-file --batch` prints: `<digest> blob <bytes>`, the bytes, a line's end."""
    at = 0
    while at < len(batch):
        end = batch.index(b"\n", at)
        start, size = end + 1, int(batch[at:end].split()[-1])
        yield batch[start : start + size].decode(errors="replace")
        at = start + size + 1


def _git(words: Sequence[str], given: bytes = b"") -> bytes:
    """What git prints; nothing where it fails or is not there."""
    try:
        done = subprocess.run(["git", *words], cwd=Path(ROOT), input=given, capture_output=True, check=False)
    except OSError:
        return b""
    return done.stdout if done.returncode == 0 else b""
