"""What a scene is made of (project book, 7.1.1 to 7.1.3): frozen dataclasses of raw fixed-point integers.

A raw integer is ``value * 2**frac_bits`` of the field's format. The types hold exactly what the packed frame
can hold, faulty scenes included (a radius of 0, a camera at its own center of interest): whether a frame is
drawn is judged in one place, `models.scene.frame`.
"""

import math
from dataclasses import dataclass
from pathlib import Path

from models.fixed import BOOK, COLOUR, RADIUS, Format
from models.limits import BOOK_HALF_ANGLE_DEGREES, INDEX_STEP

Vec3 = tuple[int, int, int]
"""Raw x, y, z, or red, green, blue."""

INDEX = Format(4, 0, signed=False)
"""Code of the refractive index: n = 1 + code / 8."""

BLACK: Vec3 = (0, 0, 0)


def _check_scalar(owner: str, field: str, raw: int, fmt: Format) -> None:
    if not isinstance(raw, int) or isinstance(raw, bool):
        raise ValueError(f"{owner}.{field}: {raw!r} is not a raw integer")
    if not fmt.min <= raw <= fmt.max:
        raise ValueError(f"{owner}.{field}: raw {raw} is outside {fmt.min} to {fmt.max} of {fmt}")


def _check_vector(owner: str, field: str, raw: Vec3, fmt: Format) -> None:
    if not isinstance(raw, tuple) or len(raw) != 3:
        raise ValueError(f"{owner}.{field}: {raw!r} is not a tuple of three raw integers")
    for axis, component in zip("xyz", raw, strict=True):
        _check_scalar(owner, f"{field}.{axis}", component, fmt)


@dataclass(frozen=True)
class Material:
    """Colour definitions of an object (7.1.3): five unsigned [9.10] colours, code of the refractive index."""

    ambient: Vec3
    diffuse: Vec3
    specular: Vec3
    reflection: Vec3 = BLACK
    transparency: Vec3 = BLACK
    index: int = 0

    def __post_init__(self) -> None:
        for field in ("ambient", "diffuse", "specular", "reflection", "transparency"):
            _check_vector("material", field, getattr(self, field), COLOUR)
        _check_scalar("material", "index", self.index, INDEX)

    @property
    def refractive_index(self) -> float:
        """n of Snell's law."""
        return float(1 + self.index * INDEX_STEP)


@dataclass(frozen=True)
class Light:
    """Point light: position in signed, intensity in unsigned [9.10]."""

    position: Vec3
    intensity: Vec3

    def __post_init__(self) -> None:
        _check_vector("light", "position", self.position, BOOK)
        _check_vector("light", "intensity", self.intensity, COLOUR)


@dataclass(frozen=True)
class Sphere:
    """Center in signed [9.10], radius in unsigned [2.3]; radius 0 is a fault of the frame that holds it."""

    material: Material
    center: Vec3
    radius: int

    def __post_init__(self) -> None:
        _check_vector("sphere", "center", self.center, BOOK)
        _check_scalar("sphere", "radius", self.radius, RADIUS)


@dataclass(frozen=True)
class Triangle:
    """Three vertices in signed [9.10]; a triangle without area is drawn as nothing."""

    material: Material
    vertices: tuple[Vec3, Vec3, Vec3]

    def __post_init__(self) -> None:
        if not isinstance(self.vertices, tuple) or len(self.vertices) != 3:
            raise ValueError(f"triangle.vertices: {self.vertices!r} is not a tuple of three vertices")
        for number, vertex in enumerate(self.vertices):
            _check_vector("triangle", f"vertices[{number}]", vertex, BOOK)


@dataclass(frozen=True)
class Camera:
    """Point of view, normal direction of the world, and the point looked at (8.2.1), in signed [9.10]."""

    position: Vec3
    up: Vec3
    center: Vec3

    def __post_init__(self) -> None:
        for field in ("position", "up", "center"):
            _check_vector("camera", field, getattr(self, field), BOOK)


@dataclass(frozen=True)
class Scene:
    """Everything one frame says. Object numbers count the spheres first, then the triangles."""

    camera: Camera
    lights: tuple[Light, ...]
    spheres: tuple[Sphere, ...]
    triangles: tuple[Triangle, ...]
    ambient: Vec3
    background: Vec3

    def __post_init__(self) -> None:
        _check_vector("scene", "ambient", self.ambient, COLOUR)
        _check_vector("scene", "background", self.background, COLOUR)

    @property
    def objects(self) -> tuple[Sphere | Triangle, ...]:
        """Spheres, then triangles: the position in this tuple is the object number."""
        return (*self.spheres, *self.triangles)


@dataclass(frozen=True)
class View:
    """Size of the picture in pixels and the tangents of the half angles of view; registers of the core."""

    width: int
    height: int
    tan_h: float
    tan_v: float

    def __post_init__(self) -> None:
        if self.width < 1 or self.height < 1:
            raise ValueError(f"view: {self.width} x {self.height} is not a picture")
        for field in ("tan_h", "tan_v"):
            value = getattr(self, field)
            if not (math.isfinite(value) and value > 0):
                raise ValueError(f"view.{field}: {value!r} is not above 0")

    @classmethod
    def book(cls, width: int, height: int) -> "View":
        """The book's view (8.2.1): half an angle of 30 degrees across, and of 30 degrees * h / w down.

        Raises ValueError where the picture is so high that the vertical half angle reaches 90 degrees.
        """
        if width < 1 or height < 1:
            raise ValueError(f"view: {width} x {height} is not a picture")
        half_v = BOOK_HALF_ANGLE_DEGREES * height / width
        if half_v >= 90:
            raise ValueError(f"view: {width} x {height} is too high for the book's field of view")
        return cls(width, height, _tan_degrees(BOOK_HALF_ANGLE_DEGREES), _tan_degrees(half_v))

    @classmethod
    def square(cls, width: int, height: int, angle: float) -> "View":
        """Square pixels and a full vertical angle of view in degrees."""
        if not 0 < angle < 180:
            raise ValueError(f"view.angle: {angle:g} is not between 0 and 180 degrees")
        tan_v = _tan_degrees(angle / 2)
        return cls(width, height, tan_v * width / height, tan_v)


def _tan_degrees(angle: float) -> float:
    return math.tan(math.radians(angle))


@dataclass(frozen=True)
class SceneFile:
    """A scene as it was read: the view it asks for (None: none), remarks for its reader, and where it stood.

    `square_pixels` says that the file gave an angle of view, which is kept when the picture's size changes.
    """

    scene: Scene
    view: View | None
    notes: tuple[str, ...]
    path: Path
    title: str = ""
    square_pixels: bool = False

    def view_for(self, width: int, height: int) -> View:
        """The view at another size: the file's vertical angle and square pixels, or else the book's rule."""
        if self.view is not None and self.square_pixels:
            return View(width, height, self.view.tan_v * width / height, self.view.tan_v)
        return View.book(width, height)
