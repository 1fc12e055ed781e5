"""Primary rays leave through the centers of the pixels: u points right, v points down."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given

from models.reference.camera import basis, primary_directions
from models.reference.render import render
from models.scene.frame import FrameError
from models.scene.strategies import cameras, undrawable_cameras
from models.scene.types import BLACK, Camera, Material, Scene, Sphere, View

ONE = 1024
AHEAD = Camera(position=(0, 0, 8 * ONE), up=(0, ONE, 0), center=(0, 0, 0))
GREY = Material((ONE, ONE, ONE), BLACK, BLACK)


def hit_pixels(center: tuple[int, int, int], camera: Camera = AHEAD) -> tuple[float, float]:
    """Mean row and column at which a small sphere appears in a picture of 64 x 64."""
    scene = Scene(camera, (), (Sphere(GREY, center, 4),), (), (ONE, ONE, ONE), BLACK)
    rows, columns = np.nonzero(render(scene, View.book(64, 64)).hit == 0)
    assert len(rows) > 0
    return float(rows.mean()), float(columns.mean())


def test_what_lies_toward_up_appears_in_the_upper_rows() -> None:
    row, column = hit_pixels((0, 2 * ONE, 0))
    assert row < 24
    assert column == pytest.approx(31.5)


def test_what_lies_to_the_right_appears_in_the_right_columns() -> None:
    row, column = hit_pixels((2 * ONE, 0, 0))
    assert row == pytest.approx(31.5)
    assert column > 40


def test_turning_up_over_turns_the_picture_over() -> None:
    row, column = hit_pixels((ONE, 2 * ONE, 0))
    turned = hit_pixels((ONE, 2 * ONE, 0), replace(AHEAD, up=(0, -ONE, 0)))
    assert turned == pytest.approx((63 - row, 63 - column))


def test_the_length_of_up_and_of_the_view_does_not_matter() -> None:
    longer = Camera(position=(0, 0, 8 * ONE), up=(0, 9 * ONE, 5 * ONE), center=(0, 0, -77 * ONE))
    np.testing.assert_allclose(basis(longer), basis(AHEAD), atol=1e-15)


@given(cameras())
def test_the_basis_is_orthonormal(camera: Camera) -> None:
    axes = np.concatenate(basis(camera), axis=1)
    np.testing.assert_allclose(axes.T @ axes, np.eye(3), atol=1e-9)


@given(undrawable_cameras())
def test_a_camera_that_the_core_refuses_is_refused(camera: Camera) -> None:
    with pytest.raises(FrameError):
        basis(camera)


def test_rays_go_through_the_centers_of_pixels() -> None:
    view = View(4, 2, 1.0, 0.5)
    directions = primary_directions(AHEAD, view, np.arange(2)).reshape(3, 2, 4)
    for row, y in enumerate((0.25, -0.25)):
        for column, x in enumerate((-0.75, -0.25, 0.25, 0.75)):
            length = math.sqrt(x * x + y * y + 1)
            expected = (x / length, y / length, -1 / length)
            np.testing.assert_allclose(directions[:, row, column], expected, atol=1e-15)
