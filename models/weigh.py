"""What the tests of the project's scenes are: against spheres or triangles, of shadow rays or others.

python -m models.weigh      prints a row a scene of the default build, for the choice of trace units

A design with units of their own for each kind is at best as busy as its busiest unit lets it be: with a
unit for spheres and one for triangles tests / (2 * tests of the more frequent kind), and so for a unit for
shadow rays and one for all other rays.
"""

import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from models.core import registers, render
from models.cores import CORES
from models.scene.load import load

SCENES = Path(__file__).parent / "scenes"
_SIZE = (128, 128)


@dataclass(frozen=True)
class Load:
    """Tests of one scene's picture: against spheres, against triangles; rays of each kind."""

    scene: str
    pixels: int
    spheres: int
    triangles: int
    rays: int
    shadow_rays: int

    @property
    def tests(self) -> int:
        """All of them."""
        return self.spheres + self.triangles

    @property
    def busy_by_object(self) -> float:
        """Of a unit for spheres and one for triangles, at best."""
        return self.tests / (2 * max(self.spheres, self.triangles))

    @property
    def busy_by_ray(self) -> float:
        """Of a unit for shadow rays and one for all other rays, at best."""
        return (self.rays + self.shadow_rays) / (2 * max(self.rays, self.shadow_rays))


def measure(path: Path) -> Load | None:
    """A scene's load; None where the default build does not hold it."""
    file, core = load(path), CORES["default"]
    if not core.holds(file.scene):
        return None
    size = registers(file.view_for(*_SIZE), core.formats)
    counts = render(file.scene, size, core.formats).counts
    rays = counts.primary_rays + counts.secondary_rays
    spheres = len(file.scene.spheres) * (rays + counts.shadow_rays)
    pixels = size.width * size.height
    return Load(path.stem, pixels, spheres, counts.tests - spheres, rays, counts.shadow_rays)


def table() -> Iterator[str]:
    """Lines of the table."""
    heads = ("scene", "tests a pixel: spheres", "triangles", "a unit a kind of object", "a kind of ray")
    yield f"| {' | '.join(heads)} |"
    yield "| --- | --- | --- | --- | --- |"
    for path in sorted(SCENES.glob("*.toml")):
        found = measure(path)
        if found is not None:
            a_pixel = f"{found.spheres / found.pixels:.2f} | {found.triangles / found.pixels:.2f}"
            yield f"| {found.scene} | {a_pixel} | {found.busy_by_object:.0%} | {found.busy_by_ray:.0%} |"


def main() -> int:
    """Command line; see the module's docstring."""
    for line in table():
        print(line, flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
