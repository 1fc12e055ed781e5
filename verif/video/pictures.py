"""Streams of pictures, whole and broken, and the pictures that a frame buffer makes of what it is sent."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from hypothesis import strategies as st
from numpy.random import Generator
from numpy.typing import NDArray

from models.images import Rgb
from models.video import Store
from verif.env.fields import Field, bit
from verif.env.pipelined import Mismatch
from verif.env.streams import Naming, Stream, Transaction

SIZE_W = 12
LARGEST = (1 << SIZE_W) - 1
"""Width or height of a picture."""
_TILE = 61
"""Pixels after which a painted picture repeats: no power of two, so that an address too large is seen."""
Word = tuple[int, int, int, int, int]
"""tdata, tuser, tlast, and the ports width and height in the same clock."""

VIDEO = Stream(
    "video",
    (
        Field("s_axis_video_tdata", 24, signed=False),
        bit("s_axis_video_tuser"),
        bit("s_axis_video_tlast"),
        Field("width", SIZE_W, signed=False),
        Field("height", SIZE_W, signed=False),
    ),
    Naming("{prefix}_tvalid", "{prefix}_tready", "{field}"),
)
"""The size is a field as the others are, so that it is wrong wherever it need not be right."""


@dataclass(frozen=True)
class Shot:
    """One picture in the stream.

    cut: so many pixels are sent, then the next picture begins; None: all. slip: the pixel whose tlast is
    wrong; None: none is.
    """

    width: int
    height: int
    cut: int | None = None
    slip: int | None = None

    @property
    def whole(self) -> bool:
        """It is to be shown."""
        return self.slip is None and self.cut is None


def shots(store: Store) -> st.SearchStrategy[Shot]:
    """Pictures mostly of the stored size, some smaller and larger, some broken."""

    def broken(size: tuple[int, int]) -> st.SearchStrategy[Shot]:
        pixels = size[0] * size[1]
        cut = st.integers(1, pixels - 1).map(lambda number: Shot(*size, cut=number))
        places = st.sampled_from([0, size[0] - 1, pixels - 1]) | st.integers(0, pixels - 1)
        slip = places.map(lambda number: Shot(*size, slip=number))
        return slip if pixels == 1 else cut | slip

    side = st.integers(1, store.width + 3), st.integers(1, store.height + 3)
    sizes = st.just((store.width, store.height)) | st.tuples(*side)
    return st.one_of(
        st.just(Shot(store.width, store.height)),
        st.just(Shot(store.width, store.height)),
        sizes.map(lambda size: Shot(*size)),
        sizes.flatmap(broken),
    )


def extremes(store: Store) -> list[Shot]:
    """The stored size, the smallest pictures, the longest line and the longest column."""
    small = [Shot(side, side) for side in (3, 2, 1)]
    return [Shot(store.width, store.height), *small, Shot(LARGEST, 1), Shot(1, LARGEST)]


def powers() -> list[Shot]:
    """Lines and columns that need one bit of their size alone, each of those bits."""
    sides = [1 << bit for bit in range(1, SIZE_W)]
    return [Shot(*size) for side in sides for size in ((side, 1), (1, side))]


class Painter:
    """Pictures of which any two differ in each pixel, also in what a store keeps of them."""

    def __init__(self, generator: Generator, store: Store) -> None:
        self._generator, self._store = generator, store
        self._most = 1 << store.depth_bits
        self._base: NDArray[np.int64] = generator.integers(0, self._most, (_TILE, _TILE))
        self._step = int(generator.integers(0, self._most)) | 1
        self._painted = 0

    def paint(self, width: int, height: int) -> Rgb:
        """The next picture: its own step from the others in each code, and noise in the bits not kept."""
        self._painted += 1
        rows, columns = np.arange(height) % _TILE, np.arange(width) % _TILE
        codes = self._base[np.ix_(rows, columns)] + self._step * self._painted
        picture = self._store.colours((codes % self._most).astype(np.uint32))
        noise = self._generator.integers(0, 256, picture.shape, dtype=np.uint8)
        kept = np.array([256 - (1 << 8 - bits) for bits in self._store.channel_bits], dtype=np.uint8)
        return np.asarray(picture & kept | noise & ~kept)


def words(shot: Shot, picture: Rgb, generator: Generator) -> Iterator[Word]:
    """A picture as words of the stream; behind the first the ports of the size hold anything."""
    colours = picture.reshape(-1, 3).astype(int)[: shot.cut]
    sizes = generator.integers(0, 1 << SIZE_W, (len(colours), 2)).tolist()
    sizes[0] = [shot.width, shot.height]
    for number, (colour, (width, height)) in enumerate(zip(colours.tolist(), sizes, strict=True)):
        last = (number % shot.width == shot.width - 1) != (number == shot.slip)
        red, green, blue = colour
        yield red << 16 | green << 8 | blue, int(number == 0), int(last), width, height


class Assembler:
    """What a frame buffer must make of the words that it takes: `pictures`, those that are complete."""

    def __init__(self) -> None:
        self.pictures: list[Rgb] = []
        self.taken = 0
        self._pixels: list[int] = []
        self._size = (0, 0)
        self._receiving = False

    def receive(self, word: Transaction) -> None:
        """The next word that was taken."""
        self.taken += 1
        if word.s_axis_video_tuser:
            self._receiving, self._pixels, self._size = True, [], (word.width, word.height)
        if not self._receiving:
            return
        width, height = self._size
        self._pixels.append(word.s_axis_video_tdata)
        column = (len(self._pixels) - 1) % width
        if bool(word.s_axis_video_tlast) != (column == width - 1):
            self._receiving = False
        elif len(self._pixels) == width * height:
            self._receiving = False
            packed = np.array(self._pixels, dtype=np.uint32).reshape(height, width)
            channels = [packed >> 16 & 255, packed >> 8 & 255, packed & 255]
            self.pictures.append(np.stack(channels, axis=-1).astype(np.uint8))

    @property
    def receiving(self) -> bool:
        """A picture has begun and may become complete."""
        return self._receiving

    def drop(self) -> None:
        """The core's side is reset: what is not complete is lost."""
        self._receiving = False

    def forget(self) -> None:
        """The screen's side is reset: all is lost."""
        self.pictures.clear()
        self.drop()


def check_order(
    seen: Sequence[NDArray[np.uint8]], written: Sequence[NDArray[np.uint8]], start: int = -1
) -> int:
    """Raises Mismatch where a picture seen is not the one before it or the next one written, whole.

    -1 is the black before the first. Returns the number of the last one seen.
    """
    shown = start
    for number, picture in enumerate(seen):
        if shown + 1 < len(written) and np.array_equal(picture, written[shown + 1]):
            shown += 1
        elif not (np.array_equal(picture, written[shown]) if shown >= 0 else not picture.any()):
            raise Mismatch(f"frame {number} of the screen, behind picture {shown}, {_kind(picture, written)}")
    return shown


def _kind(picture: NDArray[np.uint8], written: Sequence[NDArray[np.uint8]]) -> str:
    for number, other in enumerate(written):
        if np.array_equal(picture, other):
            return f"is picture {number}"
    shares = _shares(picture, written)
    return f"is no picture written; pixels of each one: {dict(shares)} of {picture[..., 0].size}"


def _shares(picture: NDArray[np.uint8], written: Iterable[NDArray[np.uint8]]) -> Iterator[tuple[int, int]]:
    for number, other in enumerate(written):
        if equal := int((picture == other).all(axis=-1).sum()):
            yield number, equal
