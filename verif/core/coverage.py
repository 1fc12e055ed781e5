"""What must have been seen of the whole core: rays of every kind and depth, faults, resets, waits.

The bench tells of all bins: those of pictures from what the bit-exact model traced for a picture that the
core drew alike, pixel, hit and counter (`verif.core.seen`).
"""

from collections.abc import Iterable, Mapping

from models.limits import MAX_DEPTH, Fault
from verif.core.promises import WAITS
from verif.env.coverage.classes import told
from verif.env.coverage.points import Coverage

DEPTHS = range(1, MAX_DEPTH + 1)
CHILD_DEPTHS = range(2, MAX_DEPTH + 1)
HITS = ("sphere_outside", "sphere_inside", "triangle_front", "triangle_back")
"""Ways to meet an object; the kind of an object and whether the ray leaves it."""
FRAME_FAULTS = (
    Fault.FRAME_SHORT,
    Fault.FRAME_LONG,
    Fault.KIND,
    Fault.RADIUS,
    Fault.CAMERA_POSITION,
    Fault.CAMERA_UP,
    Fault.SIZE,
)
MOMENTS = ("at_rest", "loading", "set_up", "drawing", "with_secondary_rays", "stalled")
"""What the core was about when it was reset."""


def scene(kind: str) -> str:
    """The recipe that draws scenes of a kind of `models.scene.strategies.classes`."""
    return f"scenes: {kind}"


def _same(names: Iterable[str], recipe: str) -> dict[str, str]:
    return dict.fromkeys(names, recipe)


def wait_bin(wait: str) -> str:
    """A bin's name for one of `WAITS`."""
    return wait.replace(" ", "_")


_TREES, _ROOMS = "trees", "room"
_SHADOWS: Mapping[str, str] = {
    "none": scene("anything"),
    "opaque": scene("sensible"),
    "through_one": scene("glass_before_wall"),
    "through_several": scene("glass_in_glass"),
    "unlit": scene("anything"),
    "light_at_the_point": scene("light_on_sphere"),
}

COVERAGE = Coverage(
    (
        told(
            "hit_by_depth",
            "what a ray of each depth meets",
            {f"{what}_{depth}": _TREES for depth in DEPTHS for what in (*HITS, "miss")},
        ),
        told("shadow", "the way to a light", _SHADOWS),
        told(
            "reflected_by_depth",
            "mirrors of each depth of the new ray",
            _same((f"cast_{depth}" for depth in CHILD_DEPTHS), _TREES),
        ),
        told(
            "transmitted_by_depth",
            "glass, by depth of the new ray",
            _same(
                (
                    f"{way}_{depth}"
                    for depth in CHILD_DEPTHS
                    for way in ("entering", "leaving", "all_reflected")
                ),
                _TREES,
            ),
        ),
        told(
            "stop",
            "why a ray is not cast",
            {
                "reflection_negligible": "faint",
                "transmission_negligible": "faint",
                "no_share": scene("anything"),
                "too_deep": _TREES,
            },
        ),
        told("split", "children of a hit", _same(("none", "reflected", "transmitted", "both"), _TREES)),
        told("lights", "lights of a frame", _same(map(str, range(4)), "counts")),
        told("spheres", "spheres of a frame", _same(map(str, range(4)), "counts")),
        told("triangles", "triangles of a frame", _same(("0", "1", "some", "15"), "counts")),
        told("depth", "depth of the deepest ray", _same(map(str, DEPTHS), _TREES)),
        told("degenerate", "triangles without area", _same(("none", "one", "several"), "counts")),
        told("pixel", "a channel of a pixel", _same(("black", "between", "clamped"), scene("anything"))),
        told("fault", "frames that are refused", _same((f.name.lower() for f in FRAME_FAULTS), "faults")),
        told("behind_a_fault", "the frame behind it", {"drawn": "faults", "refused": "faults"}),
        told("reset", "what the core was about", _same(MOMENTS, "resets")),
        told("next_frame", "how a frame comes behind another", {"at_once": "frames", "after_rest": "frames"}),
        told("waits", "what the core waited for", _same(map(wait_bin, WAITS), _ROOMS)),
    )
)
