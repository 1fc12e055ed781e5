"""What code coverage leaves out, and why: read from TOML, held to the text of the design and to what was hit.

    [[exclude]]
    reason = "The low bit of an odd number is 1."
    owner = "verification"
    review = 2027-06-30
    proof = "make unit UNIT=sqrt"       # where there is one
    types = ["toggle"]                  # line, branch, expr, toggle
    places = [
        { file = "hdl/arith/sqrt_step.v", code = "operand =", signal = "operand", bits = "7:4,0" },
    ]

One reason may hold in many places. `file` may be a pattern, as `hdl/**/*.v`. `code` is on the line meant, so
that edits above it change nothing. `signal` and `bits` are of toggles, where not all of the line are meant;
`what` is in the name of the point, as `add==1`, where not all on the line are meant.

An exclusion says that its points cannot be hit. It is stale where it matches nothing, where that was hit all
the same, or where its date has passed.
"""

import datetime
import re
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fnmatch import fnmatch
from functools import cached_property
from pathlib import Path
from typing import Any

from verif.coverage.code.points import CodeCoverage, Hits, Kind, Point
from verif.env import sources

FILE = Path(__file__).with_name("exclusions.toml")

_REQUIRED = ("reason", "owner", "review", "types", "places")
_OPTIONAL = ("proof",)
_PLACE = ("file", "code")
_OPTIONAL_OF_PLACE = ("signal", "bits", "what")
_TOGGLE = re.compile(r"(?P<signal>.*?)(\[(?P<bit>\d+)\])?:(?P<edge>0->1|1->0)")


class ExclusionError(ValueError):
    """An entry is wrong in itself; the text names file, entry, field and remedy."""


@dataclass(frozen=True)
class Toggle:
    """A toggle point's name, taken apart; bit: None of a signal of one bit."""

    signal: str
    bit: int | None
    edge: str

    @classmethod
    def of(cls, what: str) -> "Toggle":
        """From `signal[bit]:0->1`. Raises ValueError where it is something else."""
        found = _TOGGLE.fullmatch(what)
        if found is None:
            raise ValueError(f"{what} is no toggle")
        bit = found["bit"]
        return cls(found["signal"], None if bit is None else int(bit), found["edge"])


@dataclass(frozen=True)
class Exclusion:
    """One place of an entry; see above. bits: the excluded ones as (highest, lowest), none for all."""

    file: str
    code: str
    kinds: tuple[Kind, ...]
    reason: str
    owner: str
    review: datetime.date
    signal: str | None = None
    bits: tuple[tuple[int, int], ...] = ()
    what: str = ""
    proof: str = ""

    def __str__(self) -> str:
        named = f" {self.signal or self.what}" if self.signal or self.what else ""
        ranges = (str(high) if high == low else f"{high}:{low}" for high, low in self.bits)
        bits = f"[{','.join(ranges)}]" if self.bits else ""
        return f"{self.file}, `{self.code}`{named}{bits}"

    @property
    def names_points(self) -> bool:
        """It names points, and not just what is left of a line."""
        return bool(self.what)

    def concerns(self, file: str) -> bool:
        """Whether a file is meant."""
        return self.file == file or fnmatch(file, self.file.replace("**/", "*"))

    def matches(self, point: Point) -> bool:
        """Whether a point is meant, the file and the line's text aside."""
        if point.kind not in self.kinds or self.what not in point.what:
            return False
        if point.kind is not Kind.TOGGLE or self.signal is None:
            return True
        toggle = Toggle.of(point.what)
        if toggle.signal != self.signal:
            return False
        return not self.bits or any(low <= (toggle.bit or 0) <= high for high, low in self.bits)


@dataclass(frozen=True)
class Review:
    """What exclusions do to a coverage.

    excluded: points left out, each with its exclusion. problems: the stale ones, a sentence each.
    """

    coverage: CodeCoverage
    excluded: Mapping[Point, Exclusion] = field(default_factory=dict)
    problems: tuple[str, ...] = ()

    @cached_property
    def holes(self) -> tuple[Point, ...]:
        """Points that are neither hit nor left out, in the order of the text."""
        points = self.coverage.points
        return tuple(sorted(p for p, hits in points.items() if not hits.count and p not in self.excluded))


def _bits(text: str) -> tuple[tuple[int, int], ...]:
    ranges = (part.partition(":") for part in text.split(","))
    return tuple((int(high), int(low or high)) for high, _, low in ranges)


def _checked(where: str, entry: Mapping[str, Any], required: Sequence[str], optional: Sequence[str]) -> None:
    for name in required:
        if not entry.get(name):
            raise ExclusionError(f"{where}: has no {name}; write one")
    for name in entry:
        if name not in (*required, *optional):
            raise ExclusionError(
                f"{where}: {name} is no field; there are {', '.join((*required, *optional))}"
            )


def _place(where: str, common: Mapping[str, Any], place: Mapping[str, Any]) -> Exclusion:
    _checked(where, place, _PLACE, _OPTIONAL_OF_PLACE)
    if "bits" in place and "signal" not in place:
        raise ExclusionError(f"{where}: bits are those of a signal; name it in signal")
    try:
        bits = _bits(place["bits"]) if "bits" in place else ()
    except (ValueError, AttributeError):
        raise ExclusionError(f'{where}: bits={place["bits"]!r} is not like "7:4,1"') from None
    return Exclusion(**common, **{**place, "bits": bits})


def _entry(path: Path, number: int, entry: Mapping[str, Any]) -> Iterator[Exclusion]:
    where = f"{path}, entry {number}"
    _checked(where, entry, _REQUIRED, _OPTIONAL)
    if not isinstance(entry["review"], datetime.date):
        raise ExclusionError(f"{where}: review={entry['review']!r} is no date such as 2027-06-30")
    try:
        kinds = tuple(Kind(kind) for kind in entry["types"])
    except ValueError as error:
        raise ExclusionError(f"{where}: types: {error}; choose of {', '.join(Kind)}") from None
    common = {name: value for name, value in entry.items() if name not in ("types", "places")}
    for place in entry["places"]:
        yield _place(f"{where}, {place.get('file', '?')}", {**common, "kinds": kinds}, place)


def read(path: Path | None = None) -> tuple[Exclusion, ...]:
    """The entries of a file, the project's without one. Raises ExclusionError where one is wrong."""
    file = path or FILE
    try:
        found = tomllib.loads(file.read_text())
    except (OSError, tomllib.TOMLDecodeError) as error:
        raise ExclusionError(f"{file}: cannot be read: {error}") from error
    entries: Sequence[Mapping[str, Any]] = found.get("exclude", [])
    return tuple(place for number, entry in enumerate(entries, 1) for place in _entry(file, number, entry))


def _contradicted(exclusion: Exclusion, matched: Mapping[Point, Hits]) -> str | None:
    """What was hit although it cannot be: the first such, if any.

    A constant 1 rises once, when the simulation begins; a bit toggles that goes both ways. Of an expression's
    or a line's other points the exclusion leaves out what is left, unless it names them.
    """
    both: set[tuple[int, str, int | None]] = set()
    for point, hits in matched.items():
        if point.kind is Kind.TOGGLE and hits.count:
            toggle = Toggle.of(point.what)
            bit = (point.line, toggle.signal, toggle.bit)
            if bit in both:
                return f"{toggle.signal}" + ("" if toggle.bit is None else f"[{toggle.bit}]")
            both.add(bit)
        elif hits.count and exclusion.names_points:
            return point.what
    return None


def _stale(
    exclusion: Exclusion,
    matched: Mapping[Point, Hits],
    texts: Sequence[str],
    whole: bool,
    today: datetime.date,
) -> Iterator[str]:
    if exclusion.review < today:
        yield f"{exclusion}: was to be reviewed by {exclusion.review}; review it and set the next date"
    if not texts:
        yield f"{exclusion}: there is no such file; take the exclusion out"
    elif not any(exclusion.code in text for text in texts):
        yield f"{exclusion}: no line holds this code; take the exclusion out or mend its code"
    elif whole and not matched:
        yield f"{exclusion}: there is no such point; take the exclusion out or mend it"
    elif matched and all(hits.count for hits in matched.values()):
        yield f"{exclusion}: all that it leaves out was hit; take it out"
    elif hit := _contradicted(exclusion, matched):
        yield f"{exclusion}: {hit} was hit; narrow the exclusion or take it out"


def design_texts() -> dict[str, list[str]]:
    """The lines of each file of the design."""
    paths = sorted(sources.HDL.rglob("*.v"))
    return {str(path.relative_to(sources.ROOT)): path.read_text().splitlines() for path in paths}


def apply(
    exclusions: Sequence[Exclusion],
    coverage: CodeCoverage,
    *,
    texts: Mapping[str, Sequence[str]] | None = None,
    whole: bool = True,
    today: datetime.date | None = None,
) -> Review:
    """Leaves out what the exclusions name.

    texts: lines of each file. whole: everything has been run, so that an exclusion without points is stale.
    """
    lines = design_texts() if texts is None else texts
    day = today or datetime.datetime.now(datetime.UTC).date()
    of_files = coverage.of_files()
    excluded: dict[Point, Exclusion] = {}
    problems: list[str] = []
    for exclusion in exclusions:
        files = [file for file in lines if exclusion.concerns(file)]
        matched = {
            point: hits
            for file in files
            for point, hits in of_files.get(file, {}).items()
            if exclusion.code in lines[file][point.line - 1] and exclusion.matches(point)
        }
        meant = [line for file in files for line in lines[file]]
        problems += _stale(exclusion, matched, meant, whole, day)
        for point, hits in matched.items():
            if not hits.count:
                excluded.setdefault(point, exclusion)
    return Review(coverage, excluded, tuple(problems))
