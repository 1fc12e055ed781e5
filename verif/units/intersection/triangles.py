"""Rays that pass a triangle in every way there is: through it, at its rim, beside it, along it, behind."""

import numpy as np
from numpy.random import Generator

from models.core.setup import triangle_normals
from models.fixed import Raw
from models.formats import Formats
from models.limits import INFINITY, T_MIN
from verif.env import vectors
from verif.env.fields import Operands
from verif.env.vectors import Floats

Corners = tuple[Raw, Raw, Raw]

_SHORTER = 6
"""Directions of 2^-6 and more reach a corner whose mantissa is full within the greatest distance of a hit."""


def corners(generator: Generator, size: int, fmts: Formats) -> Corners:
    """Corners (3, n) in `coord`: of all sizes, near 0, anywhere, at the range's edge; slivers, axis-aligned
    ones, some without area.
    """
    one, coord = fmts.coord.one, fmts.coord
    near = generator.integers(-8 * one, 8 * one, (3, size))
    anywhere = generator.integers(coord.min, coord.max, (3, size), endpoint=True)
    edge = generator.choice([coord.min, coord.max], (3, size))
    first = vectors.pick(generator, near, near, near, anywhere, edge)
    usual, extreme = generator.uniform(0.0, 6.5, size), generator.uniform(-9.0, 8.5, size)
    extent = 2.0 ** vectors.pick(generator, usual, usual, extreme)
    sides = generator.standard_normal((2, 3, size)) * extent
    share = generator.uniform(-0.5, 1.5, size)
    thin = sides[0] * share + sides[1] * 2.0 ** -generator.uniform(4.0, 12.0, size)
    sides[1] = vectors.pick(generator, sides[1], sides[1], sides[1], sides[1], thin)
    flattened = generator.integers(0, 3, size)[None, :] == np.arange(3)[:, None]
    sides = np.where(flattened & (generator.random(size) < 0.3), 0.0, sides)
    steps = np.rint(sides * one).astype(np.int64)
    second, third = (coord.saturate(first + step) for step in steps)
    collapsed = generator.random(size)
    second = np.where(collapsed < 0.01, first, second)
    third = np.where((collapsed > 0.01) & (collapsed < 0.02), second, third)
    middle = np.where(((second - first) % 2).any(axis=0), first, (first + second) // 2)
    third = np.where((collapsed > 0.02) & (collapsed < 0.03), middle, third)
    return first, second, third


def targets(generator: Generator, size: int) -> Floats:
    """Barycentric weights (3, n): inside, on edges and corners, just beside them, well outside."""
    inside = generator.dirichlet([1.0, 1.0, 1.0], size).T
    share = generator.random(size)
    edge = np.stack([share, 1.0 - share, np.zeros(size)])
    corner = np.stack([np.ones(size), np.zeros(size), np.zeros(size)])
    step = generator.choice([-1.0, 1.0], size) * 2.0 ** -generator.uniform(2.0, 22.0, size)
    beyond = -generator.uniform(0.1, 4.0, size)
    across, outside = (np.stack([-far / 2, -far / 2, far]) for far in (step, beyond))
    chosen = vectors.pick(
        generator,
        *(10 * [inside]),
        edge,
        edge + across,
        corner,
        corner + across,
        edge + outside,
        edge + outside,
    )
    turn = (np.arange(3)[:, None] + generator.integers(0, 3, size)) % 3
    return np.take_along_axis(chosen, turn, axis=0)


def ways(generator: Generator, corner: Corners, size: int) -> Floats:
    """Directions (3, n): any, from both sides; in the triangle's plane, along its edges, and almost so."""
    first, second, third = (np.asarray(place, dtype=np.float64) for place in corner)
    anywhere = vectors.directions(generator, size)
    plane = np.cross(second - first, third - first, axis=0)
    square = vectors.unit(plane) * generator.choice([-1.0, 1.0], size)
    share = generator.uniform(-1.0, 1.0, size)
    along = vectors.unit(vectors.pick(generator, second - first, third - first + share * (second - first)))
    lean = 2.0 ** -generator.uniform(1.0, 18.0, size) * generator.choice([-1.0, 0.0, 1.0], size)
    edge_on = vectors.unit(along + square * lean)
    slanted = vectors.unit(square + vectors.directions(generator, size) * generator.uniform(0.0, 1.5, size))
    diagonal = vectors.unit(generator.integers(-1, 1, (3, size), endpoint=True).astype(np.float64))
    chosen = vectors.pick(generator, anywhere, *(6 * [slanted]), square, square, diagonal, diagonal, edge_on)
    return np.where(vectors.length(chosen) > 0.5, chosen, anywhere)


def past_triangles(generator: Generator, size: int, fmts: Formats) -> Operands:
    """Tests of rays against triangles; limits have still to be chosen and are as far as can be.

    The direction is rounded before the origin is found, so that far rays pass where they were aimed.
    """
    corner = corners(generator, size, fmts)
    direction = vectors.truncated(ways(generator, corner, size), fmts.unit)
    return _aimed(generator, corner, direction, targets(generator, size), fmts)


def past_edges(generator: Generator, size: int, fmts: Formats) -> Operands:
    """The same at edges alone, along directions whose longest components are as long to a few steps."""
    share = generator.random(size)
    weight = np.stack([share, 1.0 - share, np.zeros(size)])
    turn = (np.arange(3)[:, None] + generator.integers(0, 3, size)) % 3
    weight = np.take_along_axis(weight, turn, axis=0)
    return _aimed(generator, corners(generator, size, fmts), _ties(generator, size, fmts), weight, fmts)


def past_corners(generator: Generator, size: int, fmts: Formats) -> Operands:
    """Rays through corners, to a step, along directions so short that their products have few bits: the
    lowest ones decide whether the triangle is hit, and where.

    A corner is as many of its direction away as its mantissa holds, and no farther than a hit may be.
    """
    corner = corners(generator, size, fmts)
    longest = fmts.unit.one >> _SHORTER
    direction = generator.integers(-longest, longest, (3, size), endpoint=True)
    leading = generator.integers(0, 3, size)[None, :] == np.arange(3)[:, None]
    direction = np.where(leading, generator.choice([-longest, longest], size), direction)
    reach = (1 << (fmts.unit.width - 1)) // longest
    times = generator.integers(reach // 2, reach, size)
    chosen = np.stack(corner)[generator.integers(0, 3, size), :, np.arange(size)].T
    shift = fmts.point.frac_bits - fmts.coord.frac_bits
    beside = generator.integers(-1, 1, (3, size), endpoint=True)
    return {
        "origin": fmts.point.saturate((chosen << shift) - direction * times + beside),
        "direction": direction,
        "limit": np.full(size, int(INFINITY * fmts.point.one)),
        "triangle": np.ones(size, dtype=np.int64),
        "shape": triangle_normals(*corner, fmts).normal,
        "vertices": np.concatenate(corner),
    }


def _ties(generator: Generator, size: int, fmts: Formats) -> Raw:
    """Directions (3, n) in `unit`, most of them not of length one."""
    usual = np.rint(fmts.unit.one / np.sqrt(generator.integers(2, 3, size, endpoint=True))).astype(np.int64)
    longest = vectors.pick(generator, usual, generator.integers(1, fmts.unit.max, size, endpoint=True))
    tied = np.maximum(longest + generator.integers(-3, 3, (3, size), endpoint=True), 0)
    shorter = (tied * generator.random(size)).astype(np.int64)
    which = generator.integers(0, 6, size)[None, :] == np.arange(3)[:, None]
    sign = generator.choice([-1, 1], (3, size))
    return fmts.unit.saturate(sign * np.where(which, shorter, tied))


def _aimed(generator: Generator, corner: Corners, direction: Raw, weight: Floats, fmts: Formats) -> Operands:
    """Tests of rays of these directions that pass triangles where ``weight`` says, from any distance."""
    size = int(direction.shape[1])
    target = sum(w * fmts.coord.to_float(place) for w, place in zip(weight, corner, strict=True))
    few_steps = generator.integers(-6, 6, size, endpoint=True) / fmts.point.one
    ahead = vectors.pick(
        generator,
        float(T_MIN) + few_steps,
        float(INFINITY) + few_steps,
        *(generator.uniform(0.0, 10.0, size) for _ in range(6)),
        *(2.0 ** generator.uniform(-6.0, 8.0, size) for _ in range(4)),
        -generator.uniform(0.0, 10.0, size),
        np.zeros(size),
    )
    start = np.rint((target - fmts.unit.to_float(direction) * ahead) * fmts.point.one).astype(np.int64)
    shift = fmts.point.frac_bits - fmts.coord.frac_bits
    at_corner = generator.random(size) < 0.02
    return {
        "origin": fmts.point.saturate(np.where(at_corner, corner[0] << shift, start)),
        "direction": direction,
        "limit": np.full(size, int(INFINITY * fmts.point.one)),
        "triangle": np.ones(size, dtype=np.int64),
        "shape": triangle_normals(*corner, fmts).normal,
        "vertices": np.concatenate(corner),
    }
