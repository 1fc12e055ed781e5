"""Tells the core's cover bins: from what the model traced for a picture that the core drew alike."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from models.core import Registers, Rendering, render
from models.fixed import Raw
from models.formats import Formats
from models.limits import MIN_WEIGHT, Fault
from models.scene.types import Scene
from verif.core.coverage import HITS, wait_bin
from verif.core.driver import Moment
from verif.core.strategies import Shot
from verif.env.coverage.collector import Collector
from verif.env.coverage.sampling import clock_number

_TRIANGLES = {0: "0", 1: "1", 15: "15"}
_DEGENERATE = {0: "none", 1: "one"}
_SEVERAL = 2


@dataclass(frozen=True)
class Traced:
    """The model's picture, and what it traced for it: kind, depth and values, see `models.core.render`."""

    picture: Rendering
    events: Sequence[tuple[str, int, tuple[Raw, ...]]]

    @classmethod
    def of(cls, scene: Scene, registers: Registers, fmts: Formats) -> "Traced":
        """Traces a scene."""
        events: list[tuple[str, int, tuple[Raw, ...]]] = []

        def watch(kind: str, depth: int, values: tuple[Raw, ...]) -> None:
            events.append((kind, depth, values))

        return cls(render(scene, registers, fmts, watch), events)


@dataclass
class Seen:
    """What one test has seen. behind_a_fault: the frame before this one was refused."""

    coverage: Collector
    behind_a_fault: bool = False

    def _tell(self, name: str, times: int = 1) -> None:
        if times:
            self.coverage.tell(name, clock_number(), times)

    def picture(self, shot: Shot, traced: Traced, fmts: Formats) -> None:
        """A picture that is the model's."""
        scene, depth = shot.scene, shot.registers.depth
        self._frame(scene, depth, traced.picture)
        rays = _Rays(self, len(scene.spheres), depth, fmts)
        for kind, at, values in traced.events:
            rays.hear(kind, at, values)

    def _frame(self, scene: Scene, depth: int, drawn: Rendering) -> None:
        self._tell(f"lights.{len(scene.lights)}", len(scene.lights) <= 3)
        self._tell(f"spheres.{len(scene.spheres)}", len(scene.spheres) <= 3)
        self._tell(f"triangles.{_TRIANGLES.get(len(scene.triangles), 'some')}")
        self._tell(f"depth.{depth}")
        self._tell(f"degenerate.{_DEGENERATE.get(drawn.degenerate, 'several')}")
        if self.behind_a_fault:
            self._tell("behind_a_fault.drawn")
        self.behind_a_fault = False

    def refused(self, fault: Fault) -> None:
        """A frame that the core refused."""
        self._tell(f"fault.{fault.name.lower()}")
        if self.behind_a_fault:
            self._tell("behind_a_fault.refused")
        self.behind_a_fault = True

    def sent(self, frames: Sequence[bool]) -> None:
        """Frames since reset: whether each came while another was drawn."""
        for at_once in frames[1:]:
            self._tell(f"next_frame.{'at_once' if at_once else 'after_rest'}")

    def waits(self, told: Sequence[str]) -> None:
        """What the core waited for, see `verif.core.promises`."""
        for wait in told:
            self._tell(f"waits.{wait_bin(wait)}")

    def before_reset(self, moment: Moment) -> None:
        """The core is about to be reset."""
        self.behind_a_fault = False
        self._tell(f"reset.{_about(moment)}")


def _about(moment: Moment) -> str:
    if moment.offered and not moment.taken:
        return "stalled"
    if moment.busy and moment.counts.secondary_rays:
        return "with_secondary_rays"
    if moment.busy and moment.counts.primary_rays:
        return "drawing"
    if moment.busy:
        return "set_up"
    return "loading" if moment.sending else "at_rest"


class _Rays:
    """Hears of the rays of one picture."""

    def __init__(self, seen: Seen, spheres: int, depth: int, fmts: Formats) -> None:
        self._tell = seen._tell
        self._spheres, self._depth, self._fmts = spheres, depth, fmts
        self._least = int(MIN_WEIGHT * fmts.shade.one)
        self._refracted: tuple[Raw, ...] = ()
        self._reflected: Raw = np.empty(0, dtype=np.int64)

    def hear(self, kind: str, depth: int, values: tuple[Raw, ...]) -> None:
        """An event of `models.core.render`."""
        if heard := getattr(self, f"_hear_{kind}", None):
            heard(depth, *values)

    def _hear_hit(self, depth: int, number: Raw, leaving: Raw, *_rest: Raw) -> None:
        ways = 2 * (number >= self._spheres) + (leaving != 0)
        for way, name in enumerate(HITS):
            self._tell(f"hit_by_depth.{name}_{depth}", int(np.count_nonzero(ways == way)))
        if depth == self._depth:
            self._tell("stop.too_deep", number.size)

    def _hear_miss(self, depth: int, direction: Raw) -> None:
        self._tell(f"hit_by_depth.miss_{depth}", direction.shape[-1])

    def _hear_refracted(self, _depth: int, *values: Raw) -> None:
        self._refracted = values

    def _cast(self, weight: Raw, what: str) -> Raw:
        """Per hit, whether a ray is cast; tells why it is not."""
        cast = np.asarray(weight.max(axis=0) >= self._least)
        self._tell("stop.no_share", int(np.count_nonzero(weight.max(axis=0) == 0)))
        self._tell(f"stop.{what}_negligible", int(np.count_nonzero(~cast & (weight.max(axis=0) > 0))))
        return cast

    def _hear_reflected(self, depth: int, weight: Raw) -> None:
        self._reflected = self._cast(weight, "reflection")
        self._tell(f"reflected_by_depth.cast_{depth + 1}", int(np.count_nonzero(self._reflected)))

    def _hear_transmitted(self, depth: int, weight: Raw) -> None:
        cast = self._cast(weight, "transmission")
        total, leaving = (value != 0 for value in self._refracted)
        ways = {"entering": ~leaving & ~total, "leaving": leaving & ~total, "all_reflected": total}
        for name, way in ways.items():
            self._tell(f"transmitted_by_depth.{name}_{depth + 1}", int(np.count_nonzero(cast & way)))
        pairs = self._reflected + 2 * cast
        for number, name in enumerate(("none", "reflected", "transmitted", "both")):
            self._tell(f"split.{name}", int(np.count_nonzero(pairs == number)))

    def _hear_unlit(self, _depth: int, at_point: Raw) -> None:
        self._tell("shadow.unlit", int(np.count_nonzero(at_point == 0)))
        self._tell("shadow.light_at_the_point", int(np.count_nonzero(at_point)))

    def _hear_shadow(self, _depth: int, _colour: Raw, left: Raw, met: Raw) -> None:
        some = left.any(axis=0)
        self._tell("shadow.none", int(np.count_nonzero(met == 0)))
        self._tell("shadow.opaque", int(np.count_nonzero((met > 0) & ~some)))
        self._tell("shadow.through_one", int(np.count_nonzero((met == 1) & some)))
        self._tell("shadow.through_several", int(np.count_nonzero((met >= _SEVERAL) & some)))

    def _hear_pixel(self, _depth: int, total: Raw) -> None:
        one = self._fmts.shade.one
        self._tell("pixel.black", int(np.count_nonzero(total == 0)))
        self._tell("pixel.between", int(np.count_nonzero((total > 0) & (total < one))))
        self._tell("pixel.clamped", int(np.count_nonzero(total >= one)))
