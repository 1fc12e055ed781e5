"""The reference renderer draws what POV-Ray draws, an independent renderer with the same model of light.

`models.povray` says how a scene is told to POV-Ray, and which differences remain. Here they are shown to be
the whole difference: without them the pictures agree to within truncation.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from models import povray
from models.images import psnr_db
from models.povray import NotComparable, to_pov
from models.reference import intersect, render
from models.scene.load import load
from models.scene.types import BLACK, Camera, Light, Material, Scene, SceneFile, Sphere, Triangle, Vec3, View

SCENES = Path(__file__).parent.parent / "scenes"
ONE = 1024
WIDTH = 256
LEAST_DB = 35.0
"""What is asked of each scene."""
SAME_DB = 60.0
"""Pictures that differ by a step in a few pixels, which is rounding before the truncation."""
THEIR_T_MIN = 1e-3
"""About POV-Ray's own smallest distances."""

needs_povray = pytest.mark.skipif(
    not povray.is_installed(), reason="povray is not installed; Debian's package of that name has it"
)

ABOUT = {
    "mirrors": "mirrors",
    "room": "mirrors, glass and triangles",
    "shadows": "shadows of several lights, through coloured panes and balls",
    "glass": "refraction in coloured balls",
    "three_spheres": "mirror, glass, three lights",
    "gem": "refraction in triangles, total internal reflection",
    "tetrahedron": "triangles that share edges",
    "mesh": "a closed mesh",
    "one_sphere": "Phong's terms",
}
SAME = {"mirrors", "tetrahedron", "mesh", "one_sphere"}
"""Scenes without glass and without objects that touch."""


def project_scene(name: str) -> tuple[SceneFile, View]:
    file = load(SCENES / f"{name}.toml")
    assert file.view is not None
    return file, file.view_for(WIDTH, WIDTH * file.view.height // file.view.width)


@needs_povray
@pytest.mark.parametrize("name", ABOUT)
def test_a_scene_is_what_povray_draws(name: str, tmp_path: Path) -> None:
    file, view = project_scene(name)
    theirs = povray.render(file.scene, view, tmp_path)
    ours = render(file.scene, view).rgb
    assert psnr_db(ours, theirs) >= (SAME_DB if name in SAME else LEAST_DB), ABOUT[name]
    assert ours.std() > 20, "a picture of one colour would compare too well"


@needs_povray
@pytest.mark.parametrize("depth", [1, 2, 3, 4])
def test_the_depth_of_the_ray_tree_counts_alike(depth: int, tmp_path: Path) -> None:
    file, view = project_scene("mirrors")
    theirs = povray.render(file.scene, view, tmp_path, depth)
    assert psnr_db(render(file.scene, view, max_depth=depth).rgb, theirs) >= SAME_DB
    assert psnr_db(render(file.scene, view, max_depth=depth + 1).rgb, theirs) < SAME_DB


@needs_povray
def test_the_edges_of_the_gem_differ_by_the_smallest_distance_of_a_hit(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A ray that enters next to an edge leaves before T_MIN, which our rule makes a miss."""
    file, view = project_scene("gem")
    theirs = povray.render(file.scene, view, tmp_path)
    assert psnr_db(render(file.scene, view).rgb, theirs) < SAME_DB
    monkeypatch.setattr(intersect, "_T_MIN", THEIR_T_MIN)
    assert psnr_db(render(file.scene, view).rgb, theirs) >= SAME_DB


@needs_povray
@pytest.mark.parametrize("name", ["glass", "shadows", "three_spheres", "room"])
def test_the_insides_of_glass_balls_differ_by_their_highlights(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Light reaches the inner side of a ball through one of the copy's two surfaces."""
    file, view = project_scene(name)
    spheres = tuple(
        replace(sphere, material=replace(sphere.material, specular=BLACK))
        if sphere.material.transparency != BLACK
        else sphere
        for sphere in file.scene.spheres
    )
    dull = replace(file.scene, spheres=spheres)
    monkeypatch.setattr(intersect, "_T_MIN", THEIR_T_MIN)
    theirs = povray.render(dull, view, tmp_path)
    assert psnr_db(render(dull, view).rgb, theirs) >= SAME_DB


@needs_povray
@pytest.mark.parametrize("seed", range(3))
def test_a_crowd_of_opaque_and_mirroring_objects_is_what_povray_draws(seed: int, tmp_path: Path) -> None:
    scene = crowd(np.random.default_rng(seed))
    view = View(192, 144, 0.6, 0.45)
    theirs = povray.render(scene, view, tmp_path)
    assert psnr_db(render(scene, view).rgb, theirs) >= LEAST_DB


def crowd(rng: np.random.Generator) -> Scene:
    def vector(low: float, high: float) -> Vec3:
        x, y, z = (int(raw) for raw in rng.integers(int(low * ONE), int(high * ONE), 3))
        return (x, y, z)

    def material() -> Material:
        grey = int(rng.integers(ONE // 2))
        shine = vector(0, 0.7) if rng.random() < 0.5 else BLACK
        return Material(vector(0, 0.3), vector(0.1, 0.6), (grey, grey, grey), shine)

    return Scene(
        camera=Camera(vector(4, 8), vector(0.5, 1), vector(-1, 1)),
        lights=tuple(Light(vector(-9, 9), vector(0, 0.6)) for _ in range(3)),
        spheres=tuple(Sphere(material(), vector(-3, 3), int(rng.integers(4, 14))) for _ in range(3)),
        triangles=tuple(
            Triangle(material(), (vector(-4, 4), vector(-4, 4), vector(-4, 4))) for _ in range(12)
        ),
        ambient=vector(0.2, 0.5),
        background=vector(0, 0.5),
    )


PLAIN = Material((100, 0, 0), (500, 0, 0), (300, 300, 300))
CAMERA = Camera((0, 0, 5 * ONE), (0, ONE, 0), (0, 0, 0))
CORNERS = ((0, 0, 0), (ONE, 0, 0), (0, ONE, 0))


@pytest.mark.parametrize(
    ("material", "problem"),
    [
        (replace(PLAIN, specular=(1, 2, 3)), "object 1: specular is not grey"),
        (replace(PLAIN, diffuse=BLACK), "ambient light has no diffuse"),
        (replace(PLAIN, transparency=(1, 2, 3)), "beside diffuse or ambient"),
        (replace(PLAIN, transparency=(ONE, ONE, ONE)), "beside diffuse or ambient"),
        (replace(PLAIN, transparency=(512, 512, 512), index=4), "not 1 together"),
    ],
)
def test_what_povray_cannot_say_is_refused_by_name(material: Material, problem: str) -> None:
    plain = Sphere(PLAIN, (0, 0, 0), 8)
    scene = Scene(CAMERA, (), (plain,), (Triangle(material, CORNERS),), (ONE, ONE, ONE), BLACK)
    with pytest.raises(NotComparable, match=problem):
        to_pov(scene, View.book(4, 4))


def test_a_scene_of_the_project_that_is_not_comparable_says_so() -> None:
    file, view = project_scene("inside")
    with pytest.raises(NotComparable, match="specular"):
        to_pov(file.scene, view)


def test_the_text_says_what_the_scene_does() -> None:
    glass = Material(BLACK, BLACK, (ONE, ONE, ONE), BLACK, (256, ONE, 64), 4)
    scene = Scene(
        CAMERA,
        (Light((ONE, 2 * ONE, 0), (512, 512, 0)),),
        (Sphere(glass, (512, 0, 0), 12),),
        (Triangle(PLAIN, CORNERS),),
        (512, 512, 512),
        (0, 0, ONE),
    )
    text = to_pov(scene, View.book(4, 4), 3)
    for part in (
        "max_trace_level 3",
        "background { rgb <0, 0, 1> }",
        "light_source { <1, 2, 0> rgb <0.5, 0.5, 0> }",
        "sphere { <0.5, 0, 0> 1.5 texture",
        "rgbf <0.25, 1, 0.0625, 1>",
        "interior { ior 1.5 } no_shadow",
        "pigment { rgbf <0.5, 1, 0.25, 1> } no_image no_reflection",
        "triangle { <0, 0, 0>, <1, 0, 0>, <0, 1, 0> texture",
        "ambient rgb <0.10000000000000001, 0, 0>",
    ):
        assert part in text


@needs_povray
def test_a_text_that_povray_refuses_is_an_error_with_its_words(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(povray, "to_pov", lambda *_: "sphere {\n")
    with pytest.raises(RuntimeError, match="povray failed"):
        povray.render(crowd(np.random.default_rng(0)), View.book(4, 4), tmp_path)
