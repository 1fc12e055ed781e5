"""The bit-exact model of the core against the float64 reference, and its rays, counts and faults."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from models import images, reference
from models.core import CameraFault, Counts, Event, Registers, registers, render, trace_pixel
from models.formats import BUILDS, Formats, formats
from models.limits import MAX_DEPTH, Fault
from models.scene.load import load
from models.scene.types import BLACK, Camera, Light, Material, Scene, SceneFile, Triangle, View
from models.tests.scalar_core import ScalarCore

_SCENES = Path(__file__).parents[1] / "scenes"
_DEFAULT = formats(BUILDS["default"])
ONE = 1024

FILES = [load(path) for path in sorted(_SCENES.glob("*.toml"))]
SCENES = {file.path.stem: file.scene for file in FILES}
FIRST = SCENES["one_sphere"]
MIRRORS = SCENES["mirrors"]
MESH = SCENES["mesh"]


def _registers(width: int, height: int, depth: int = MAX_DEPTH) -> Registers:
    return replace(registers(View.book(width, height), _DEFAULT), depth=depth)


def _is_simple(scene: Scene) -> bool:
    return len(scene.objects) == 1 and len(scene.lights) == 1


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.path.stem)
def test_the_default_build_is_near_the_reference(file: SceneFile) -> None:
    mismatch, psnr = (0.02, 50) if _is_simple(file.scene) else (0.05, 40)
    view = file.view_for(512, 512)
    drawn = render(file.scene, registers(view, _DEFAULT), _DEFAULT)
    ideal = reference.render(file.scene, view)
    assert images.hit_mismatch_percent(drawn.hit.astype(np.int32), ideal.hit) <= mismatch
    assert images.psnr_db(drawn.rgb, ideal.rgb) >= psnr


@pytest.mark.parametrize("depth", range(1, MAX_DEPTH + 2))
def test_every_depth_is_near_the_reference_of_that_depth(depth: int) -> None:
    size = replace(registers(View.book(160, 160), _DEFAULT), depth=depth)
    for name in ("mirrors", "glass"):
        drawn = render(SCENES[name], size, _DEFAULT)
        ideal = reference.render(SCENES[name], View.book(160, 160), max_depth=depth)
        assert images.psnr_db(drawn.rgb, ideal.rgb) >= 40


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.path.stem)
def test_guard_bits_bring_the_picture_nearer_to_the_reference(file: SceneFile) -> None:
    view = file.view_for(128, 128)
    ideal = reference.render(file.scene, view)
    drawn = {name: render(file.scene, registers(view, formats(k)), formats(k)) for name, k in BUILDS.items()}
    assert images.psnr_db(drawn["default"].rgb, ideal.rgb) > images.psnr_db(drawn["book"].rgb, ideal.rgb)


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("build", BUILDS)
def test_a_picture_is_what_single_rays_make_of_it(name: str, build: str) -> None:
    """Colours, hits and counts of a tiny picture are those of a recursion, one ray at a time."""
    fmts = formats(BUILDS[build])
    size = registers(View.book(8, 6), fmts)
    drawn = render(SCENES[name], size, fmts)
    core = ScalarCore(SCENES[name], size, fmts)
    for y in range(size.height):
        for x in range(size.width):
            rgb, number = core.pixel(x, y)
            assert drawn.rgb[y, x].tolist() == rgb, f"pixel {x}, {y}"
            assert drawn.hit[y, x] == (-1 if number is None else number)
    counts = drawn.counts
    expected = Counts(core.primary, core.secondary, core.shadows, core.tests, counts.lights_at_point)
    assert counts == expected


def _terms(events: list[Event]) -> list[tuple[int, ...]]:
    return [event.values for event in events if event.kind in ("local", "left")]


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.path.stem)
def test_the_terms_of_a_traced_pixel_sum_up_to_the_rendered_one(file: SceneFile) -> None:
    size = registers(file.view_for(48, 32), _DEFAULT)
    drawn = render(file.scene, size, _DEFAULT)
    for x, y in ((0, 0), (24, 16), (30, 12), (47, 31)):
        events = trace_pixel(file.scene, size, _DEFAULT, x, y)
        sums = np.minimum(np.sum(_terms(events), axis=0), _DEFAULT.shade.max)
        assert events[-1] == Event("pixel", 0, tuple(int(channel) for channel in sums))
        assert np.minimum((sums * 255) >> _DEFAULT.shade.frac_bits, 255).tolist() == drawn.rgb[y, x].tolist()
        first = next(event for event in events if event.kind in ("hit", "miss"))
        assert first.depth == 1
        assert drawn.hit[y, x] == (first.values[0] if first.kind == "hit" else -1)


def _count(events: list[Event], *kinds: str) -> int:
    return sum(event.kind in kinds for event in events)


@pytest.mark.parametrize(("name", "depth"), [("glass", 5), ("mirrors", 4), ("mesh", 2), ("far", 1)])
def test_what_is_counted_is_what_is_traced(name: str, depth: int) -> None:
    size = _registers(8, 6)
    counts = render(SCENES[name], size, _DEFAULT).counts
    events: list[Event] = []
    for y in range(size.height):
        for x in range(size.width):
            events += trace_pixel(SCENES[name], size, _DEFAULT, x, y)
    assert counts.primary_rays == _count(events, "pixel") == 48
    assert counts.secondary_rays == _count(events, "child")
    assert counts.shadow_rays == _count(events, "light") == _count(events, "left")
    assert (
        counts.primary_rays + counts.secondary_rays
        == _count(events, "hit", "miss")
        == _count(events, "local")
    )
    assert max(event.depth for event in events) == depth


def test_the_depth_bounds_the_tree() -> None:
    counts = [render(MIRRORS, _registers(24, 16, depth), _DEFAULT).counts for depth in range(1, 7)]
    secondary = [count.secondary_rays for count in counts]
    assert secondary[0] == 0
    assert secondary[:5] == sorted(secondary[:5])
    assert secondary[1] > 0


def test_a_frame_without_an_object_is_background() -> None:
    drawn = render(replace(MIRRORS, spheres=(), triangles=()), _registers(8, 6), _DEFAULT)
    assert (drawn.hit == -1).all()
    assert (drawn.rgb == drawn.rgb[0, 0]).all()
    assert drawn.counts == Counts(primary_rays=48)


def test_a_frame_without_a_light_has_ambient_light_only() -> None:
    drawn = render(replace(FIRST, lights=()), _registers(64, 64), _DEFAULT)
    assert len(np.unique(drawn.rgb[drawn.hit == 0], axis=0)) == 1


def _facing(light: Light, *triangles: Triangle) -> Scene:
    camera = Camera((0, 0, 8 * ONE), (0, ONE, 0), (0, 0, 0))
    return Scene(camera, (light,), (), triangles, BLACK, BLACK)


_MATT = Material(BLACK, (ONE, ONE, ONE), BLACK)
_WALL = Triangle(_MATT, ((-9 * ONE, -9 * ONE, 0), (9 * ONE, -9 * ONE, 0), (0, 9 * ONE, 0)))
_THREAD = Triangle(_MATT, ((-ONE, 0, ONE), (0, 0, ONE), (ONE, 0, ONE)))


def test_a_light_at_the_hit_point_is_left_out_and_counted() -> None:
    """The one pixel's ray goes straight to the origin."""
    drawn = render(_facing(Light((0, 0, 0), (ONE, ONE, ONE)), _WALL), _registers(1, 1), _DEFAULT)
    assert drawn.hit[0, 0] == 0
    assert drawn.counts == Counts(primary_rays=1, tests=1, lights_at_point=1)
    assert drawn.rgb[0, 0].tolist() == [0, 0, 0]


def test_triangles_without_area_are_left_out_and_counted() -> None:
    lamp = Light((0, 0, 8 * ONE), (ONE, ONE, ONE))
    drawn = render(_facing(lamp, _THREAD, _WALL, _THREAD), _registers(1, 1), _DEFAULT)
    assert drawn.degenerate == 2
    assert drawn.hit[0, 0] == 1
    assert drawn.counts == Counts(primary_rays=1, shadow_rays=1, tests=1)
    assert drawn.rgb[0, 0].min() >= 254


def _camera(scene: Scene, **changes: tuple[int, int, int]) -> Scene:
    camera: Camera = scene.camera
    return replace(scene, camera=replace(camera, **changes))


@pytest.mark.parametrize(
    ("scene", "size", "fault"),
    [
        (_camera(FIRST, center=FIRST.camera.position), (8, 6), Fault.CAMERA_POSITION),
        (_camera(FIRST, up=(0, 0, 0)), (8, 6), Fault.CAMERA_UP),
        (_camera(FIRST, position=(0, 0, 0), center=(3, 6, 9), up=(-1, -2, -3)), (8, 6), Fault.CAMERA_UP),
        (FIRST, (0, 6), Fault.SIZE),
        (FIRST, (8, 0), Fault.SIZE),
    ],
)
def test_what_cannot_be_drawn_is_a_fault(scene: Scene, size: tuple[int, int], fault: Fault) -> None:
    with pytest.raises(CameraFault) as refused:
        render(scene, Registers(*size, 1000, 1000), _DEFAULT)
    assert refused.value.fault is fault


def test_an_up_that_is_all_but_parallel_is_drawn() -> None:
    scene = _camera(FIRST, position=(0, 0, 0), center=(0, 0, -262143), up=(0, 1, -262143))
    assert render(scene, _registers(4, 4), _DEFAULT).rgb.shape == (4, 4, 3)


@pytest.mark.parametrize("fmts", [formats(knobs) for knobs in BUILDS.values()], ids=list(BUILDS))
def test_tangents_that_do_not_fit_their_registers_are_refused(fmts: Formats) -> None:
    with pytest.raises(ValueError, match="tan_h does not fit"):
        registers(View(8, 6, 8.0, 1.0), fmts)
