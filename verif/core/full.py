"""A scene of all that the core holds, each object of it seen, in colours of any bits."""

from collections.abc import Sequence

from models.fixed import BOOK, COLOUR, RADIUS
from models.scene.frame import Capacity
from models.scene.types import INDEX, Camera, Light, Material, Scene, Sphere, Triangle, Vec3

STRIPES = (COLOUR.max // 3, COLOUR.max - COLOUR.max // 3, COLOUR.max)
"""Every other bit is 1, the others are, all are: so much more than 1 that most colours saturate."""
USUAL = (COLOUR.one // 2, COLOUR.one // 3, COLOUR.one // 5)

_SPACING = 3 * BOOK.one // 2
"""Between the rows and columns of objects; a ball's diameter is less, a triangle's sides are as long."""
_FAR = 150


def full_scene(capacity: Capacity, stripes: Sequence[int]) -> Scene:
    """As many objects and lights as there can be, none before another one, all glass that mirrors.

    Every second object and light, the background and the ambient light have colours of these values, the
    others usual ones. All lights but one are far away.
    """
    numbers = range(capacity.spheres + capacity.triangles)
    columns = next(side for side in range(1, len(numbers) + 1) if side * side >= len(numbers))
    corner = -columns * _SPACING // 2
    places = [(corner + n % columns * _SPACING, corner + n // columns * _SPACING) for n in numbers]
    materials = [_material(stripes if n % 2 else USUAL, n) for n in numbers]
    balls = capacity.spheres
    camera = Camera((0, 0, corner * 2), (0, BOOK.one, 0), (0, 0, 0))
    return Scene(
        camera,
        tuple(_light(stripes, number) for number in range(capacity.lights)),
        tuple(_ball(materials[n], *places[n]) for n in numbers[:balls]),
        tuple(_tile(materials[n], *places[n]) for n in numbers[balls:]),
        _colour(stripes, 0),
        _colour(stripes, 1),
    )


def _colour(values: Sequence[int], first: int) -> Vec3:
    red, green, blue = (values[(first + channel) % len(values)] for channel in range(3))
    return red, green, blue


def _material(values: Sequence[int], first: int) -> Material:
    ambient, diffuse, specular, reflection, transparency = (_colour(values, first + n) for n in range(5))
    return Material(ambient, diffuse, specular, reflection, transparency, 1 + first % INDEX.max)


def _light(values: Sequence[int], number: int) -> Light:
    """In front of the objects, beside the camera, the further the higher its number."""
    away = _FAR * BOOK.one * number // (number + 1)
    intensity = _colour(values if number % 2 else (COLOUR.one,), number)
    return Light((away, away // 3, -away - BOOK.one), intensity)


def _ball(material: Material, x: int, y: int) -> Sphere:
    half = _SPACING // 2
    return Sphere(material, (x + half, y + half, 0), RADIUS.one // 2)


def _tile(material: Material, x: int, y: int) -> Triangle:
    return Triangle(material, ((x, y, 0), (x + _SPACING, y, 0), (x, y + _SPACING, 0)))
