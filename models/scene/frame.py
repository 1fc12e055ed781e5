"""The packed frame (project book, 7.1.1 to 7.1.3): one bit string, most significant bit first.

Fields in order: camera position, up, center (3 x 57 bits); numbers of lights, spheres, triangles; the lights
(114 each); the spheres (0, material, center, radius: 352 each); the triangles (1, material, three vertices:
461 each); ambient light and background (2 x 57). A material is 289 bits: ambient, diffuse, specular,
reflection, transparency, index. Vectors have x in their most significant bits.

The core reads the string as 32-bit words, first bit in bit 31 of the first word; what is left of the last
word is padding and is ignored.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from models.fixed import BOOK, COLOUR, RADIUS, Format
from models.limits import Fault
from models.scene.types import INDEX, Camera, Light, Material, Scene, Sphere, Triangle, Vec3

WORD_BITS = 32
_WORD_BYTES = WORD_BITS // 8
_WORD_MAX = (1 << WORD_BITS) - 1
_SPHERE_KIND, _TRIANGLE_KIND = 0, 1
_MATERIAL_COLOURS = ("ambient", "diffuse", "specular", "reflection", "transparency")


class FrameError(ValueError):
    """A frame that the core refuses: `fault` is its error code, `field` where in the frame it lies."""

    def __init__(self, fault: Fault, field: str, problem: str) -> None:
        super().__init__(f"{field}: {problem} ({fault.name})")
        self.fault = fault
        self.field = field
        self.problem = problem


@dataclass(frozen=True)
class Capacity:
    """Most objects of each kind that a build of the core holds."""

    lights: int
    spheres: int
    triangles: int


@dataclass(frozen=True)
class CounterWidths:
    """Bits of the three counters of the frame; parameters of the core."""

    lights: int = 2
    spheres: int = 2
    triangles: int = 4

    def __post_init__(self) -> None:
        if min(self.lights, self.spheres, self.triangles) < 1:
            raise ValueError(f"{self}: a counter has at least one bit")

    @property
    def capacity(self) -> Capacity:
        """What the counters can count to."""
        return Capacity((1 << self.lights) - 1, (1 << self.spheres) - 1, (1 << self.triangles) - 1)


DEFAULT_COUNTERS = CounterWidths()


@dataclass(frozen=True)
class Frame:
    """The words of one frame, in the order the core receives them. Faulty frames are frames too."""

    words: tuple[int, ...]

    def __post_init__(self) -> None:
        for position, word in enumerate(self.words):
            if not 0 <= word <= _WORD_MAX:
                raise ValueError(f"word {position}: {word} is not an unsigned {WORD_BITS}-bit number")

    def to_bytes(self) -> bytes:
        """The words, most significant byte first."""
        return b"".join(word.to_bytes(_WORD_BYTES, "big") for word in self.words)

    @classmethod
    def from_bytes(cls, data: bytes) -> "Frame":
        """Inverse of `to_bytes`; ValueError where the bytes are not whole words."""
        if len(data) % _WORD_BYTES:
            raise ValueError(f"{len(data)} bytes are not whole {WORD_BITS}-bit words")
        return cls(
            tuple(
                int.from_bytes(data[start : start + _WORD_BYTES], "big")
                for start in range(0, len(data), _WORD_BYTES)
            )
        )

    def to_hex(self, comment: str = "") -> str:
        """Text for ``$readmemh``: a comment, then one word a line."""
        title = f"frame of {len(self.words)} words of {WORD_BITS} bits, most significant bit first"
        lines = [f"// {line}" for line in (title, *comment.splitlines())]
        return "\n".join([*lines, *(f"{word:08x}" for word in self.words)]) + "\n"

    @classmethod
    def from_hex(cls, text: str) -> "Frame":
        """Words of a ``$readmemh`` text with ``//`` comments; ValueError names the line of a bad one."""
        words = []
        for number, line in enumerate(text.splitlines(), start=1):
            for token in line.split("//")[0].split():
                digits = token.replace("_", "")
                if not 1 <= len(digits) <= WORD_BITS // 4 or not set(digits) <= set("0123456789abcdefABCDEF"):
                    raise ValueError(f"line {number}: {token[:20]!r} is not a word of up to 8 hex digits")
                words.append(int(digits, 16))
        return cls(tuple(words))


class _Writer:
    """Appends fields to a bit string."""

    def __init__(self) -> None:
        self._bits: list[str] = []

    def scalar(self, raw: int, width: int) -> None:
        self._bits.append(format(raw & ((1 << width) - 1), f"0{width}b"))

    def vectors(self, fmt: Format, *vectors: Vec3) -> None:
        for vector in vectors:
            for component in vector:
                self.scalar(component, fmt.width)

    def material(self, material: Material) -> None:
        self.vectors(COLOUR, *(getattr(material, name) for name in _MATERIAL_COLOURS))
        self.scalar(material.index, INDEX.width)

    def frame(self) -> Frame:
        bits = "".join(self._bits)
        bits += "0" * (-len(bits) % WORD_BITS)
        return Frame(tuple(int(bits[at : at + WORD_BITS], 2) for at in range(0, len(bits), WORD_BITS)))


def pack(scene: Scene, counters: CounterWidths = DEFAULT_COUNTERS) -> Frame:
    """The frame of a scene, whether the core would draw it or not.

    Raises ValueError where there are more objects than the counters can say.
    """
    writer = _Writer()
    writer.vectors(BOOK, scene.camera.position, scene.camera.up, scene.camera.center)
    for name in ("lights", "spheres", "triangles"):
        count, limit = len(getattr(scene, name)), getattr(counters.capacity, name)
        if count > limit:
            raise ValueError(
                f"scene.{name}: {count} are more than the {limit} that the frame's counter holds"
            )
        writer.scalar(count, getattr(counters, name))
    for light in scene.lights:
        writer.vectors(BOOK, light.position)
        writer.vectors(COLOUR, light.intensity)
    for sphere in scene.spheres:
        writer.scalar(_SPHERE_KIND, 1)
        writer.material(sphere.material)
        writer.vectors(BOOK, sphere.center)
        writer.scalar(sphere.radius, RADIUS.width)
    for triangle in scene.triangles:
        writer.scalar(_TRIANGLE_KIND, 1)
        writer.material(triangle.material)
        writer.vectors(BOOK, *triangle.vertices)
    writer.vectors(COLOUR, scene.ambient, scene.background)
    return writer.frame()


class _Reader:
    """Takes fields from a bit string; the first that needs bits which never come is FRAME_SHORT."""

    def __init__(self, words: Sequence[int]) -> None:
        self._words = words
        self._bits = "".join(format(word & _WORD_MAX, f"0{WORD_BITS}b") for word in words)
        self._at = 0

    def scalar(self, field: str, width: int, signed: bool = False) -> int:
        end = self._at + width
        if end > len(self._bits):
            raise FrameError(
                Fault.FRAME_SHORT, field, f"needs {end} bits, the frame ends after {len(self._bits)}"
            )
        raw = int(self._bits[self._at : end], 2)
        self._at = end
        return raw - (1 << width) if signed and raw >> (width - 1) else raw

    def vector(self, field: str, fmt: Format) -> Vec3:
        x, y, z = (self.scalar(f"{field}.{axis}", fmt.width, fmt.signed) for axis in "xyz")
        return (x, y, z)

    def count(self, field: str, width: int, limit: int) -> int:
        count = self.scalar(f"number of {field}", width)
        if count > limit:
            raise FrameError(
                Fault.CAPACITY, f"number of {field}", f"{count} is above the capacity of {limit}"
            )
        return count

    def kind(self, field: str, expected: int) -> None:
        if self.scalar(f"{field}.kind", 1) != expected:
            raise FrameError(Fault.KIND, f"{field}.kind", f"is not {expected}")

    def material(self, field: str) -> Material:
        ambient, diffuse, specular, reflection, transparency = (
            self.vector(f"{field}.material.{name}", COLOUR) for name in _MATERIAL_COLOURS
        )
        index = self.scalar(f"{field}.material.index", INDEX.width)
        return Material(ambient, diffuse, specular, reflection, transparency, index)

    def light(self, field: str) -> Light:
        return Light(self.vector(f"{field}.position", BOOK), self.vector(f"{field}.intensity", COLOUR))

    def sphere(self, field: str) -> Sphere:
        self.kind(field, _SPHERE_KIND)
        material, center = self.material(field), self.vector(f"{field}.center", BOOK)
        radius = self.scalar(f"{field}.radius", RADIUS.width)
        if radius == 0:
            raise FrameError(Fault.RADIUS, f"{field}.radius", "is 0")
        return Sphere(material, center, radius)

    def triangle(self, field: str) -> Triangle:
        self.kind(field, _TRIANGLE_KIND)
        material = self.material(field)
        a, b, c = (self.vector(f"{field}.vertices[{number}]", BOOK) for number in range(3))
        return Triangle(material, (a, b, c))

    def end(self) -> None:
        needed = -(-self._at // WORD_BITS)
        if len(self._words) > needed:
            raise FrameError(
                Fault.FRAME_LONG, "frame", f"has {len(self._words)} words, its counts say {needed}"
            )


def unpack(
    frame: Frame, counters: CounterWidths = DEFAULT_COUNTERS, capacity: Capacity | None = None
) -> Scene:
    """The scene of a frame; FrameError for its first fault in the order of the bits, the camera's last."""
    return _parse(frame.words, counters, capacity or counters.capacity)


def check(
    words: Sequence[int], counters: CounterWidths = DEFAULT_COUNTERS, capacity: Capacity | None = None
) -> Fault:
    """The error code that the core's loader gives for these words; NONE where it draws them. Never raises."""
    try:
        _parse(words, counters, capacity or counters.capacity)
    except FrameError as error:
        return error.fault
    return Fault.NONE


def check_camera(camera: Camera) -> None:
    """FrameError where there is no direction of view, or where `up` lies along it; exact in integers."""
    dx, dy, dz = (c - p for c, p in zip(camera.center, camera.position, strict=True))
    x, y, z = camera.up
    if (dx, dy, dz) == (0, 0, 0):
        raise FrameError(Fault.CAMERA_POSITION, "camera.center", "is the camera's own position")
    if (dy * z - dz * y, dz * x - dx * z, dx * y - dy * x) == (0, 0, 0):
        raise FrameError(Fault.CAMERA_UP, "camera.up", "is zero or parallel to the direction of view")


def _parse(words: Sequence[int], counters: CounterWidths, capacity: Capacity) -> Scene:
    reader = _Reader(words)
    position, up, center = (reader.vector(f"camera.{name}", BOOK) for name in ("position", "up", "center"))
    lights = reader.count("lights", counters.lights, capacity.lights)
    spheres = reader.count("spheres", counters.spheres, capacity.spheres)
    triangles = reader.count("triangles", counters.triangles, capacity.triangles)
    scene = Scene(
        camera=Camera(position, up, center),
        lights=tuple(reader.light(f"lights[{number}]") for number in range(lights)),
        spheres=tuple(reader.sphere(f"spheres[{number}]") for number in range(spheres)),
        triangles=tuple(reader.triangle(f"triangles[{number}]") for number in range(triangles)),
        ambient=reader.vector("ambient", COLOUR),
        background=reader.vector("background", COLOUR),
    )
    reader.end()
    check_camera(scene.camera)
    return scene
