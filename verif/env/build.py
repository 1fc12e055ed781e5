"""Builds of a design for a simulator, cached by content: nothing is built twice."""

import fcntl
import hashlib
import json
import os
import shutil
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

from cocotb_tools import runner

from verif.env import sources
from verif.env.simulators import COUNTERS, Simulator, VerilatorRunner, mended_counters, version

CACHE = sources.ROOT / "build"

_VERILATOR = ("--x-assign", "unique", "--x-initial", "unique", "-Wno-fatal")
_TIMING = ("--timing", "-CFLAGS", "-std=gnu++20 -fcoroutines")
# Wider signals, which are memories and not buses, are counted at their ports. More permutations than that in
# an expression are not counted: they say nothing that the toggles of its operands do not.
_COVERAGE = (
    *("--coverage-line", "--coverage-toggle", "--coverage-expr"),
    *("--coverage-max-width", "1024", "--coverage-expr-max", "64"),
)
_ICARUS = ("-Wall", "-Wno-timescale")


_DONE = "built"
"""Name of the file that tells a finished build."""


class BuildError(RuntimeError):
    """A build failed; the text names the top module and the log."""


@dataclass(frozen=True)
class Build:
    """One design as one simulator sees it.

    top: module at the top; parameters and defines: what it is built with; waves: with signal
    traces; harness: text of a generated top module, in place of a file of that name; control: text
    of a Verilator control file that names the signals that stay visible (all, without it);
    optimise: the C++ compiler's level; timing: the top has delays, as one that makes its clock;
    label: what the folder is called, if not after the top; coverage: runs on Verilator count what they reach
    in the code (`verif.coverage.code`).
    """

    top: str
    simulator: Simulator = Simulator.VERILATOR
    parameters: Mapping[str, int] = field(default_factory=dict)
    defines: Mapping[str, int] = field(default_factory=dict)
    waves: bool = False
    harness: str | None = None
    control: str | None = None
    optimise: str = "-O1"
    timing: bool = False
    label: str = ""
    replacements: Mapping[Path, str] = field(default_factory=dict)
    coverage: bool = False

    @property
    def files(self) -> tuple[Path, ...]:
        """Sources that exist before the build."""
        return sources.closure(self.top) if self.harness is None else sources.used_by(self.harness)

    def generate(self) -> tuple[Path, ...]:
        """Writes the generated sources; all sources in the order that the simulator reads them."""
        texts = {"control.vlt": self.control, f"{self.top}.v": self.harness}
        if self.simulator is Simulator.ICARUS or self.waves:
            del texts["control.vlt"]
        if self.coverage:
            (self.directory / COUNTERS).write_text(mended_counters())
        written = []
        for name, text in texts.items():
            if text is not None:
                (self.directory / name).write_text(text)
                written.append(self.directory / name)
        control = [path for path in written if path.suffix == ".vlt"]
        files = [self._replaced(path) for path in self.files]
        return (*control, *files, *(path for path in written if path not in control))

    def _replaced(self, path: Path) -> Path:
        if path not in self.replacements:
            return path
        copy = self.directory / path.name
        copy.write_text(self.replacements[path])
        return copy

    @cached_property
    def key(self) -> str:
        """Digest of everything that the result depends on."""
        digest = hashlib.sha256()
        settings = [self.top, version(self.simulator), self.waves, self.optimise]
        settings += [self.harness, self.control, self.timing]
        settings += [sorted(self.parameters.items()), sorted(self.defines.items())]
        settings += [_VERILATOR, _TIMING, _ICARUS, str(sources.ROOT)]
        settings += [_COVERAGE, mended_counters()] if self.coverage else []
        digest.update(json.dumps(settings).encode())
        for path in (*self.files, *sources.headers()):
            digest.update(self.replacements.get(path, path.read_text()).encode())
        return digest.hexdigest()[:16]

    @property
    def directory(self) -> Path:
        """Where the build is kept."""
        return CACHE / "sim" / f"{self.label or self.top}-{self.simulator}-{self.key}"

    @property
    def ready(self) -> bool:
        """The build has been made before."""
        return (self.directory / _DONE).exists()


@contextmanager
def locked(path: Path) -> Iterator[None]:
    """Whoever else wants this file meanwhile waits, in any process."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def make_runner(build: Build) -> runner.Runner:
    """cocotb's runner for this build's simulator."""
    if build.simulator is Simulator.ICARUS:
        return runner.Icarus()
    result = VerilatorRunner()
    settings = (version(build.simulator), build.waves, build.optimise, build.timing)
    flags = f"{settings}|{_VERILATOR}|{_TIMING}|{sources.ROOT}{'|coverage' if build.coverage else ''}"
    result.runtime = CACHE / "runtime" / hashlib.sha256(flags.encode()).hexdigest()[:16]
    result.make_variables = (f"OPT_FAST={build.optimise}", f"OPT_GLOBAL={build.optimise}")
    return result


def _compile(build: Build, log: Path) -> None:
    engine = make_runner(build)
    icarus = build.simulator is Simulator.ICARUS
    # Waves on Icarus come through a SystemVerilog dump module of cocotb's.
    icarus_arguments = (*_ICARUS, *(() if build.waves else ("-g2005",)))
    verilator_arguments = [*_VERILATOR]
    verilator_arguments += _TIMING if build.timing else ()
    verilator_arguments += _COVERAGE if build.coverage else ()
    arguments = icarus_arguments if icarus else verilator_arguments
    engine.build(
        sources=build.generate(),
        includes=sources.include_dirs(),
        defines=dict(build.defines),
        parameters=dict(build.parameters),
        build_args=arguments,
        hdl_toplevel=build.top,
        build_dir=build.directory,
        cwd=sources.ROOT,
        timescale=("1ns", "1ps"),
        waves=build.waves,
        log_file=log,
    )
    if isinstance(engine, VerilatorRunner):
        engine.keep_runtime()


def ensure(build: Build) -> Path:
    """The directory of the finished build; builds it first where it is missing.

    Raises BuildError where the compiler refuses it, with the end of its log.
    """
    directory, done = build.directory, build.directory / _DONE
    with locked(directory.with_suffix(".lock")):
        if not done.exists():
            shutil.rmtree(directory, ignore_errors=True)
            directory.mkdir(parents=True)
            log = directory / "build.log"
            try:
                _compile(build, log)
            except (RuntimeError, SystemExit, OSError) as error:
                raise BuildError(_complaint(build, log)) from error
            done.touch()
    os.utime(done)
    return directory


def _complaint(build: Build, log: Path) -> str:
    lines = log.read_text().splitlines() if log.exists() else []
    errors = [line for line in lines if "rror" in line] or lines
    return "\n".join([f"{build.top} does not build for {build.simulator}; {log}:", *errors[:8]])
