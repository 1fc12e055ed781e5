"""The runs of the core's benches: on which build, how much; imports no cocotb bench."""

import zlib
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import MappingProxyType

from verif.core.builds import core_build, stepped_build
from verif.env import units
from verif.env.build import CACHE, Build
from verif.env.run import Outcome, run
from verif.env.simulators import Simulator


@dataclass(frozen=True)
class Design:
    """A core to be tested: a named build and what differs from it; stepped: for benches that look at every
    clock."""

    build: str = "default"
    simulator: Simulator = Simulator.VERILATOR
    changes: Mapping[str, int] = field(default_factory=dict)
    stepped: bool = False

    def __str__(self) -> str:
        words = [self.build, *(str(value) for value in self.changes.values()), str(self.simulator)]
        return "-".join(words)

    def made(self, waves: bool = False) -> Build:
        """How it is built."""
        builder = stepped_build if self.stepped else core_build
        return builder(self.build, self.simulator, waves, self.changes)


@dataclass(frozen=True)
class Case:
    """One run of one of the core's benches.

    share: of the usual number of Hypothesis examples a property. scenes: drawn single frames. most_pixels: of
    the drawn pictures; rate_size: side of the square whose clocks are counted. tests: those that run, all
    where there are none.
    """

    bench: str
    design: Design
    share: float = 1.0
    scenes: int = 0
    most_pixels: int = 48
    rate_size: int = 128
    tests: tuple[str, ...] = ()

    def __str__(self) -> str:
        return f"{self.bench}-{self.design}"

    def seed(self, root: int) -> int:
        """Of its own: no two runs draw the same scenes."""
        return root + zlib.crc32(str(self).encode()) % 1000

    def examples(self, usual: int) -> int:
        """Hypothesis examples a property."""
        return max(1, round(usual * self.share))


DEFAULT = Design()
BOOK = Design("book")
WIDE = Design("wide")
STEPPED = Design(stepped=True)
ONE = Design(changes=MappingProxyType({"UNITS": 1, "PIXELS_IN_FLIGHT": 4, "LEVEL_ROOM": 4}), stepped=True)
THREE = Design(changes=MappingProxyType({"UNITS": 3, "PIXELS_IN_FLIGHT": 16, "LEVEL_ROOM": 4}), stepped=True)
# Icarus simulates some hundred clocks of the core in a second, and a frame takes 600 and more.
ICARUS = Design(simulator=Simulator.ICARUS, stepped=True)

_FEW = (
    "every_drawn_scene_is_exact_in_every_pixel_hit_and_counter",
    "a_light_at_the_hit_point_is_left_out_and_counted",
    "triangles_without_area_are_left_out_and_counted",
)
"""Without those that take too long, and without the pin-holes, whose margins are those of the guard bits."""

CASES = (
    Case("pictures", DEFAULT, scenes=1000),
    Case("frames", DEFAULT),
    Case("faults", DEFAULT),
    Case("corrupt", DEFAULT),
    Case("rooms", DEFAULT, share=0.5),
    Case("rate", DEFAULT),
    Case("streams", STEPPED),
    Case("pictures", ONE, scenes=250),
    Case("frames", ONE, share=0.5),
    Case("faults", ONE, share=0.5),
    Case("rooms", ONE, share=0.5),
    Case("streams", ONE, share=0.5),
    Case("resets", ONE),
    Case("pictures", THREE, scenes=250),
    Case("rooms", THREE, share=0.5),
    Case("streams", THREE, share=0.5),
    Case("pictures", BOOK, scenes=100, tests=_FEW),
    Case("pictures", WIDE, scenes=30, share=0.2, most_pixels=4),
    Case("rooms", WIDE, share=0.1),
    Case("pictures", ICARUS, share=0.06, scenes=10, most_pixels=2, tests=_FEW),
    Case("faults", ICARUS, share=0.06, most_pixels=2, tests=("reset_at_any_clock_leaves_a_core_as_new",)),
    Case("streams", ICARUS, share=0.06, most_pixels=12),
)


def simulate(
    case: Case,
    *,
    seed: int,
    examples: int,
    waves: bool = False,
    replacements: Mapping[Path, str] | None = None,
    run_name: str = "",
    shrink: bool = True,
    coverage: bool = False,
    functional: bool = True,
) -> Outcome:
    """Builds the design where need be and runs the bench; see `verif.env.units.simulate`."""
    design = case.design
    build = replace(design.made(waves), replacements=replacements or {}, coverage=coverage)
    keeps = not units.in_ci() and not replacements
    return run(
        build,
        f"verif.core.{case.bench}",
        run_name or f"core-{case}",
        seed=case.seed(seed),
        settings={
            "parameters": dict(build.parameters),
            "parameter_set": design.build,
            "examples": case.examples(examples),
            "database": str(CACHE / "hypothesis" / f"core-{case}") if keeps else None,
            "unit": "core" if functional and not replacements else "",
            "extra": {**extra(case), "shrink": shrink},
        },
        tests=",".join(case.tests) or None,
    )


def extra(case: Case) -> dict[str, object]:
    """What the core's benches alone are told."""
    return {
        "build": case.design.build,
        "simulator": case.design.simulator,
        "stepped": case.design.stepped,
        "most_pixels": case.most_pixels,
        "scenes": case.scenes,
        "rate_size": case.rate_size,
    }
