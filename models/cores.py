"""Named builds of the whole core: guard bits of the formats, and what a frame may hold."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from models.formats import BUILDS, Formats, Knobs, formats
from models.limits import UNITS
from models.scene.frame import Capacity, CounterWidths
from models.scene.types import Scene


@dataclass(frozen=True)
class Core:
    """One build: guard bits, widths of the frame's counters, trace units."""

    knobs: Knobs = field(default_factory=Knobs)
    counters: CounterWidths = field(default_factory=CounterWidths)
    units: int = UNITS

    @property
    def formats(self) -> Formats:
        """The table of formats of the build."""
        return formats(self.knobs)

    @property
    def capacity(self) -> Capacity:
        """Most objects of each kind in a frame."""
        return self.counters.capacity

    def parameters(self) -> dict[str, int]:
        """What the Verilog is built with, beside the macros of the formats."""
        return {
            "UNITS": self.units,
            "LIGHT_COUNT_W": self.counters.lights,
            "SPHERE_COUNT_W": self.counters.spheres,
            "TRIANGLE_COUNT_W": self.counters.triangles,
        }

    def holds(self, scene: Scene) -> bool:
        """Whether a frame of this build can hold a scene."""
        most = self.capacity
        counts = (len(scene.lights), len(scene.spheres), len(scene.triangles))
        return all(count <= limit for count, limit in zip(counts, vars(most).values(), strict=True))


CORES: Mapping[str, Core] = MappingProxyType(
    {
        "default": Core(),
        "book": Core(BUILDS["book"]),
        "wide": Core(counters=CounterWidths(4, 6, 8)),
    }
)
"""`default`; `book` with the book's ten fraction bits everywhere; `wide` for 15 lights, 63 spheres and 255
triangles."""


def smallest(scene: Scene) -> str | None:
    """Name of the first build that holds a scene, None where there is none."""
    return next((name for name, core in CORES.items() if core.holds(scene)), None)
