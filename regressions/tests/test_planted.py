"""A fault planted in a unit is found by the nightly; its command shows the same failure in a fresh clone."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

from regressions import record
from regressions.record import Status
from verif.env import sources, units
from verif.env.breaks import changed
from verif.env.simulators import available

_COPIED = ("hdl", "models", "verif", "regressions", "Makefile", "pyproject.toml", "requirements.txt")


def _clone(folder: Path) -> Path:
    """The project as a clone has it, without builds, with one broken line; its environment is set up."""
    folder.mkdir()
    for name in _COPIED:
        source = sources.ROOT / name
        if source.is_dir():
            shutil.copytree(source, folder / name, ignore=shutil.ignore_patterns("__pycache__"))
        else:
            shutil.copy2(source, folder / name)
    (folder / ".venv").symlink_to(sys.prefix)
    change = units.find("add_sub").breaks[0]
    for path, text in changed(change).items():
        (folder / path.relative_to(sources.ROOT)).write_text(text)
    return folder


def _ran(folder: Path, *words: str) -> tuple[int, str]:
    """Exit code and all that a command printed, run as at a desk."""
    steering = ("CI", "PYTEST", "RAYTRACER", "MAKE", "SEED", "SIM")
    environment = {key: value for key, value in os.environ.items() if not key.startswith(steering)}
    done = subprocess.run(
        words, cwd=folder, env=environment, capture_output=True, text=True, timeout=300, check=False
    )
    return done.returncode, done.stdout + done.stderr


def test_a_planted_fault_is_found_and_its_command_shows_it_again_shrunk(tmp_path: Path) -> None:
    """Status, bucket, waves; the same shrunk operand in both clones."""
    nightly = _clone(tmp_path / "nightly")
    name = f"add_sub-narrow-{available()[-1]}"
    words = ("-m", "regressions", "run", "nightly", "--only", name, "--seed", "5")
    code, told = _ran(nightly, sys.executable, *words)
    assert code == 1, told
    found = record.read(nightly / "build" / "regressions" / "latest" / "record.json")
    (result,) = found.results
    (bucket,) = found.buckets
    assert result.status is Status.FAILED
    assert bucket.command in told
    assert (nightly / bucket.waves).stat().st_size > 0

    shrunk = bucket.example.split("\n\n")[0].partition(": ")[2]
    assert shrunk.startswith("operand 0 of 1 (1 wrong)")
    assert "Failing test case: example(" in shrunk

    code, told = _ran(_clone(tmp_path / "clone"), "bash", "-c", bucket.command)
    assert code != 0
    missing = [line for line in shrunk.splitlines() if line.strip() not in told]
    assert not missing, told
