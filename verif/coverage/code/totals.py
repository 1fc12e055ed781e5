"""Code coverage in numbers: by file, by kind, and what is missing, with its line of source."""

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

from verif.coverage.code.exclusions import Review, Toggle, design_texts
from verif.coverage.code.points import Kind, Point


@dataclass(frozen=True)
class Total:
    """Points that were hit, that are left out, and that there are."""

    hit: int = 0
    excluded: int = 0
    points: int = 0

    def __add__(self, other: "Total") -> "Total":
        return Total(self.hit + other.hit, self.excluded + other.excluded, self.points + other.points)

    @property
    def percent(self) -> float:
        """Of the points that are not left out."""
        meant = self.points - self.excluded
        return 100.0 * self.hit / meant if meant else 100.0

    @property
    def excluded_percent(self) -> float:
        """Of all points."""
        return 100.0 * self.excluded / self.points if self.points else 0.0

    @property
    def complete(self) -> bool:
        """Nothing that is not left out is missing."""
        return self.hit + self.excluded == self.points


def totals(review: Review) -> dict[str, dict[Kind, Total]]:
    """By file and kind."""
    found: dict[str, dict[Kind, Total]] = {}
    for point, hits in review.coverage.points.items():
        of_file = found.setdefault(point.file, {kind: Total() for kind in Kind})
        of_file[point.kind] += Total(int(hits.count > 0), int(point in review.excluded), 1)
    return dict(sorted(found.items()))


def over_files(by_file: Mapping[str, Mapping[Kind, Total]]) -> dict[Kind, Total]:
    """Sums of all files, by kind."""
    return {kind: sum((of[kind] for of in by_file.values()), Total()) for kind in Kind}


def _cell(total: Total) -> str:
    if not total.points:
        return f"{'-':>20}"
    left = f" -{total.excluded}" if total.excluded else ""
    return f"{f'{total.hit}/{total.points}{left}':>20}"


def table(review: Review) -> list[str]:
    """Lines of text: hit/points -excluded of each file and kind, and percentages of all."""
    by_file = totals(review)
    width = max((len(file) for file in by_file), default=4)
    lines = [f"{'file':{width}}" + "".join(f"{kind:>20}" for kind in Kind)]
    lines += [f"{file:{width}}" + "".join(map(_cell, of.values())) for file, of in by_file.items()]
    whole = over_files(by_file)
    lines.append(f"{'all':{width}}" + "".join(map(_cell, whole.values())))
    lines.append(
        f"{'of those not excluded':{width}}" + "".join(f"{t.percent:>18.2f} %" for t in whole.values())
    )
    lines.append(f"{'excluded':{width}}" + "".join(f"{t.excluded_percent:>18.2f} %" for t in whole.values()))
    every = sum(whole.values(), Total())
    lines.append(
        f"{every.hit} of {every.points} points, {every.excluded} excluded ({every.excluded_percent:.2f} %): "
        f"{every.percent:.2f} %"
    )
    return lines


def _ranges(bits: Iterable[int]) -> str:
    """`9:7,3` of 9, 8, 7 and 3."""
    parts: list[list[int]] = []
    for bit in sorted(set(bits), reverse=True):
        if parts and parts[-1][1] == bit + 1:
            parts[-1][1] = bit
        else:
            parts.append([bit, bit])
    return ",".join(str(high) if high == low else f"{high}:{low}" for high, low in parts)


def _named(points: Iterable[Point]) -> Iterator[str]:
    """What is missing on one line; the bits of a signal together."""
    bits: dict[tuple[str, frozenset[str]], list[int | None]] = {}
    edges: dict[tuple[str, int | None], set[str]] = {}
    for point in points:
        if point.kind is not Kind.TOGGLE:
            yield f"{point.kind} {point.what}"
        else:
            toggle = Toggle.of(point.what)
            edges.setdefault((toggle.signal, toggle.bit), set()).add(toggle.edge)
    for (signal, bit), missing in edges.items():
        bits.setdefault((signal, frozenset(missing)), []).append(bit)
    for (signal, missing_edges), found in bits.items():
        known = [bit for bit in found if bit is not None]
        which = f"[{_ranges(known)}]" if known else ""
        direction = "" if len(missing_edges) == 2 else f" {next(iter(missing_edges))}"
        yield f"toggle {signal}{which}{direction}"


def holes(review: Review, files: Iterable[str]) -> list[str]:
    """Lines of text: each line of source with holes, and what they are; files: all, if none is named."""
    wanted = set(files)
    texts = design_texts()
    by_line: dict[tuple[str, int], list[Point]] = {}
    for point in review.holes:
        if not wanted or point.file in wanted:
            by_line.setdefault((point.file, point.line), []).append(point)
    lines: list[str] = []
    for (file, number), points in by_line.items():
        lines.append(f"{file}:{number}: {texts[file][number - 1].strip()}")
        lines += [f"    {name}" for name in _named(points)]
    return lines


def excluded_by(review: Review) -> Counter[str]:
    """How many points each exclusion leaves out."""
    return Counter(str(exclusion) for exclusion in review.excluded.values())
