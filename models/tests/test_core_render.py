"""The bit-exact model of the core against the float64 reference, and its faults."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from models import images, reference
from models.core import CameraFault, Registers, registers, render, trace_pixel
from models.formats import BUILDS, formats
from models.limits import DEPTH, Fault
from models.scene.load import load
from models.scene.types import Camera, Scene, SceneFile, View

_SCENES = Path(__file__).parents[1] / "scenes"
_DEFAULT = formats(BUILDS["default"])


def _one_sphere_files() -> list[SceneFile]:
    files = [load(path) for path in sorted(_SCENES.glob("*.toml"))]
    return [file for file in files if len(file.scene.objects) == 1 and len(file.scene.lights) == 1]


FILES = _one_sphere_files()
FIRST = FILES[0].scene


def _registers(width: int, height: int) -> Registers:
    return registers(View.book(width, height), _DEFAULT)


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.path.stem)
def test_the_default_build_is_near_the_reference(file: SceneFile) -> None:
    view = file.view_for(512, 512)
    drawn = render(file.scene, registers(view, _DEFAULT), _DEFAULT)
    ideal = reference.render(file.scene, view, max_depth=DEPTH)
    assert images.hit_mismatch_percent(drawn.hit.astype(np.int32), ideal.hit) <= 0.02
    assert images.psnr_db(drawn.rgb, ideal.rgb) >= 50


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.path.stem)
def test_guard_bits_bring_the_picture_nearer_to_the_reference(file: SceneFile) -> None:
    view = file.view_for(256, 256)
    ideal = reference.render(file.scene, view, max_depth=DEPTH)
    drawn = {name: render(file.scene, registers(view, formats(k)), formats(k)) for name, k in BUILDS.items()}
    assert images.psnr_db(drawn["default"].rgb, ideal.rgb) > images.psnr_db(drawn["book"].rgb, ideal.rgb)


def test_a_frame_without_a_sphere_is_background() -> None:
    drawn = render(replace(FIRST, spheres=()), _registers(8, 6), _DEFAULT)
    assert (drawn.hit == -1).all()
    assert (drawn.rgb == drawn.rgb[0, 0]).all()


def test_a_frame_without_a_light_has_ambient_light_only() -> None:
    drawn = render(replace(FIRST, lights=()), _registers(64, 64), _DEFAULT)
    assert len(np.unique(drawn.rgb[drawn.hit == 0], axis=0)) == 1


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


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.path.stem)
def test_a_traced_pixel_is_the_rendered_one(file: SceneFile) -> None:
    size = registers(file.view_for(48, 32), _DEFAULT)
    drawn = render(file.scene, size, _DEFAULT)
    for x, y in ((0, 0), (24, 16), (30, 12), (47, 31)):
        stages = trace_pixel(file.scene, size, _DEFAULT, x, y)
        assert bool(stages["hit"][0]) == (drawn.hit[y, x] == 0)
        if stages["hit"][0]:
            channels = np.minimum((stages["colour"].ravel() * 255) >> _DEFAULT.shade.frac_bits, 255)
            assert channels.tolist() == drawn.rgb[y, x].tolist()
