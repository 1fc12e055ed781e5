"""Tests of the trace unit against a model of it, at every clock: when it is free, what it tests and finds."""

import itertools
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import cocotb
import numpy as np
from hypothesis import strategies as st

from models.core.trace import MISS
from models.fixed import COLOUR, RADIUS
from models.header import selected
from models.latency import LATENCY
from models.limits import INFINITY
from models.scene.types import BLACK, Sphere, Triangle, Vec3
from verif.env import context
from verif.env.block import holds, same
from verif.env.fields import split
from verif.env.unit import Parameters
from verif.units.trace_unit import unit
from verif.units.trace_unit.driver import IDLE, Manners, TraceBench
from verif.units.trace_unit.frames import Frame, Lines, Table, material, scene, vector

_PART = 60
"""Rays of the long run with one table and one manner."""


def _frames(p: Parameters) -> st.SearchStrategy[Frame]:
    few = st.integers(0, 2) | st.integers(0, p["OBJECTS"])
    kinds = st.lists(st.booleans(), min_size=1, max_size=3 * min(p["ROOM"], 8))
    return st.builds(Frame, few, few, kinds, st.integers(0, (1 << 32) - 1))


def _manners() -> st.SearchStrategy[Manners]:
    waits = st.lists(st.sampled_from([0, 0, 0, 1, 2, 9, 60]), min_size=1, max_size=5)
    takes = st.just([True]) | st.lists(st.booleans(), min_size=1, max_size=12)
    return st.builds(Manners, waits, takes, takes)


async def _bench(dut: Any) -> tuple[TraceBench, context.Context]:
    run = context.read()
    bench = TraceBench(dut, run.parameters)
    await bench.restart()
    return bench, run


@cocotb.test()
async def every_ray_finds_what_the_model_finds_when_it_must(dut: Any) -> None:
    """Drawn tables and rays of both kinds, gaps and stalls; one frame behind the other."""
    bench, run = await _bench(dut)

    async def example(first: Frame, second: Frame, manners: Manners) -> None:
        await bench.restart()
        for drawn in (first, second):
            await bench.frame(*drawn.make(run.parameters), manners)

    await holds(run, example, _frames(run.parameters), _frames(run.parameters), _manners(), cost=4)


@cocotb.test()
async def a_long_run_of_both_kinds_matches_the_model(dut: Any) -> None:
    """Volume: seeded tables of all sizes, rays back to back and with gaps by turns."""
    bench, run = await _bench(dut)
    generator, end = run.generator(0), bench.now + max(300, run.operands // 5)
    while bench.now < end:
        spheres, triangles = generator.integers(0, run.parameters["OBJECTS"], 2, endpoint=True).tolist()
        kinds = (generator.random(_PART) < generator.random()).tolist()
        rushed = generator.random() < 0.5
        waits = IDLE if rushed else generator.integers(0, 9, 20).tolist()
        takes = (generator.random((2, 20)) < generator.choice([0.2, 1.0], (2, 1))).tolist()
        frame = Frame(spheres, triangles, kinds, int(generator.integers(1 << 32)))
        await bench.frame(*frame.make(run.parameters), Manners(waits, *takes))
    bench.log.info("%d results checked", bench.checked)


def _lines(p: Parameters, own: Sequence[int], origin: Vec3, direction: Vec3) -> Lines:
    """One line over and over, that starts on one triangle or another; its light is 1."""
    fmts, size = selected(p), len(own)

    def column(vector: Vec3, one: int) -> Any:
        return np.repeat(np.array(vector, dtype=np.int64).reshape(3, 1) * one, size, axis=1)

    return Lines(
        column(origin, fmts.point.one),
        column(direction, fmts.unit.one),
        np.array(own, dtype=np.int64),
        np.full(size, int(INFINITY * fmts.point.one)),
        column((1, 1, 1), fmts.shade.one),
        column(BLACK, 0),
    )


_FACING: tuple[Vec3, Vec3, Vec3] = ((-4096, -4096, 0), (4096, -4096, 0), (0, 4096, 0))
_OCTAVES = range(12, 18)
"""Of depths, in steps of a coordinate: from as far as the triangle is large to the greatest there is."""
_DEPTHS = 6
"""In each octave."""
_RESOLVED = 9
"""Depths differ in their distances where they are this many octaves less apart than they are deep."""
_NEARER = 0.75
"""Share of pairs of which the nearer is found if no distances of neighbours were different."""
_HALF: Vec3 = (512, 512, 512)
_AHEAD: tuple[Vec3, Vec3] = ((0, 0, -4), (0, 0, 1))


def _at_depth(depth: int) -> tuple[Vec3, Vec3, Vec3]:
    """The triangle that faces the ray, moved along it."""
    a, b, c = ((x, y, depth) for x, y, _ in _FACING)
    return a, b, c


@cocotb.test()
async def of_equal_distances_the_lowest_number_is_found_but_never_a_rays_own(dut: Any) -> None:
    """As many equal triangles as there is room for, two, and one; a ray starts on none and on each of them.
    Light loses half at each triangle but its own."""
    bench, run = await _bench(dut)
    fmts, generator = selected(run.parameters), run.generator(1)
    for number in (run.parameters["OBJECTS"], 2, 1):
        table = Table(scene((), [Triangle(material(_HALF), _FACING)] * number), run.parameters)
        own = [MISS, *range(number)]
        lines = _lines(run.parameters, own, *_AHEAD)
        rays = table.jobs(lines, [False] * len(own), generator)
        shadows = table.jobs(lines, [True] * len(own), generator)
        for job, mine in zip(rays, own, strict=True):
            left = [other for other in range(number) if other != mine]
            hit = split(unit.hit(run.parameters), [job.result])
            same(f"hit of {number} triangles", int(bool(left)), int(hit["hit"][0]))
            if left:
                same(f"number of the nearest of {number} triangles", left[0], int(hit["number"][0]))
        for job, mine in zip(shadows, own, strict=True):
            passed = number - (mine != MISS)
            light = split(unit.term(run.parameters), [job.result])["sum"][:, 0].tolist()
            same(f"light behind {passed} triangles", [fmts.shade.one >> passed] * 3, light)
        await bench.frame(table, [job for pair in zip(rays, shadows, strict=True) for job in pair])


@cocotb.test()
async def of_distances_a_step_apart_the_one_that_the_model_finds_is_found(dut: Any) -> None:
    """Two triangles across the ray, in either order, near and far, of neighbouring depths and of such as are
    clearly different: the nearer, but where the distances are rounded to the same."""
    bench, run = await _bench(dut)
    generator, found = run.generator(6), list[bool]()
    for octave in [*_OCTAVES] * _DEPTHS:
        clear = 1 << (octave - _RESOLVED)
        nearer = (1 << octave) + int(generator.integers((1 << octave) - clear))
        for farther in (nearer + 1, nearer + clear):
            for depths in ((nearer, farther), (farther, nearer)):
                triangles = [Triangle(material(_HALF), _at_depth(it)) for it in depths]
                table = Table(scene((), triangles), run.parameters)
                jobs = table.jobs(_lines(run.parameters, [MISS], BLACK, (0, 0, 1)), [False], generator)
                hit = split(unit.hit(run.parameters), [jobs[0].result])
                found.append(depths[int(hit["number"][0])] == nearer)
                await bench.frame(table, jobs)
    assert np.mean(found) > _NEARER, f"the nearer of {len(found)} pairs was found {sum(found)} times"


_GRID = 6
"""Corners and rays are up to so many steps of a coordinate from an axis."""
_ACROSS = 8
"""Triangles across each axis."""
_SEEN = 0.05
"""Least share of rays that must hit, and of those that must miss."""


def _along(axis: int, p: Parameters) -> Lines:
    """Rays along an axis, one at each step around it."""
    fmts = selected(p)
    beside = np.stack(np.meshgrid(*[np.arange(-_GRID, _GRID + 1)] * 2)).reshape(2, -1)
    lines = _lines(p, [MISS] * beside.shape[1], *_AHEAD)
    lines.origin[:2] = beside * (fmts.point.one // fmts.coord.one)
    origin, direction = (np.roll(it, axis, axis=0) for it in (lines.origin, lines.direction))
    return replace(lines, origin=origin, direction=direction)


@cocotb.test()
async def a_step_of_any_corner_decides_which_rays_meet_a_triangle(dut: Any) -> None:
    """Triangles of few steps across each axis, of any transparency, and a ray along it at every step."""
    bench, run = await _bench(dut)
    generator, hits = run.generator(7), list[int]()
    for axis in [0, 1, 2] * _ACROSS:
        corners = np.zeros((3, 3), dtype=np.int64)
        corners[:2] = generator.integers(-_GRID, _GRID, (2, 3), endpoint=True)
        a, b, c = (vector(corner) for corner in np.roll(corners, axis, axis=0).T)
        share = vector(generator.integers(0, COLOUR.max, 3, endpoint=True))
        table = Table(scene((), [Triangle(material(share), (a, b, c))]), run.parameters)
        lines = _along(axis, run.parameters)
        jobs = table.jobs(lines, [False] * lines.own.size, generator)
        hits += [split(unit.hit(run.parameters), [job.result])["hit"][0] for job in jobs]
        await bench.frame(table, jobs)
    assert _SEEN < np.mean(hits) < 1 - _SEEN, f"of {len(hits)} rays {sum(hits)} hit"


@cocotb.test()
async def a_triangle_without_area_is_no_test_wherever_it_stands(dut: Any) -> None:
    """In each place of a full table of others, which let no light through, or far more than there is."""
    bench, run = await _bench(dut)
    most = run.parameters["OBJECTS"]
    for place, share in itertools.product(range(most), (0, COLOUR.max)):
        glass = material((share,) * 3)
        flats = [Triangle(glass, _FACING)] * most
        flats[place] = Triangle(glass, (*_FACING[:2], _FACING[1]))
        table = Table(scene((), flats), run.parameters)
        jobs = table.jobs(_lines(run.parameters, [MISS] * 2, *_AHEAD), [False, True], run.generator(5, place))
        same("tests", [most - 1] * 2, [sum(job.tests) for job in jobs])
        hit = split(unit.hit(run.parameters), [jobs[0].result])
        same("number of the nearest", int(place == 0), int(hit["number"][0]))
        await bench.frame(table, jobs)


@cocotb.test()
async def a_ray_that_starts_on_a_sphere_may_meet_it_again(dut: Any) -> None:
    """From within: its far side, which filters light too, and hides what is behind."""
    bench, run = await _bench(dut)
    ball = Sphere(material(_HALF), BLACK, RADIUS.max)
    table = Table(scene([ball] * 2, ()), run.parameters)
    jobs = table.jobs(
        _lines(run.parameters, [MISS] * 4, BLACK, (0, 0, 1)), [False, True] * 2, run.generator(2)
    )
    hit = split(unit.hit(run.parameters), [jobs[0].result])
    same("hit, number, leaving", [1, 0, 1], [int(hit[name][0]) for name in ("hit", "number", "leaving")])
    await bench.frame(table, jobs)


@cocotb.test()
async def one_test_a_clock_without_a_gap_between_rays(dut: Any) -> None:
    """Rays of both kinds, back to back, with all objects, one, and none: each takes its tests, or a clock."""
    bench, run = await _bench(dut)
    most = run.parameters["OBJECTS"]
    for spheres, triangles in ((most - 1, 1), (1, most - 1), (0, 1), (1, 0), (0, 0)):
        # Results of one kind come as fast as they are taken, so the room behind the tests is no limit.
        kinds = [bool(number % 2) for number in range(min(2 * run.parameters["ROOM"], 30))]
        frame = Frame(spheres, triangles, kinds, int(run.generator(3).integers(1 << 32)))
        table, jobs = frame.make(run.parameters)
        await bench.load(table)
        start = bench.now
        await bench.play(jobs)
        tests = [len(job.tests) for job in jobs]
        same("clocks", sum(tests[:-1]) + 1, bench.now - start)
        same("tests of a ray", True, all(spheres + triangles - 1 <= count <= most for count in tests))
        await bench.drain()


@cocotb.test()
async def a_consumer_that_stops_stops_its_kind_alone_and_nothing_is_lost(dut: Any) -> None:
    """Nobody takes results of a kind: as many rays start as there is room; the other kind goes on."""
    bench, run = await _bench(dut)
    room = run.parameters["ROOM"]
    for stopped in (False, True):
        kinds = [stopped] * (room + 1) + [not stopped] * 10
        table, jobs = Frame(1, 1, kinds, int(run.generator(4).integers(1 << 32))).make(run.parameters)
        waiting, late, others = jobs[:room], jobs[room], jobs[room + 1 :]
        takes = (stopped, not stopped)
        await bench.load(table)
        for job in (*waiting, *others):
            while not bench.model.free(job.shadow):
                await bench.step(None, *takes)
            await bench.step(job, *takes)
        for _ in range(2 * LATENCY["trace_unit"](run.parameters)):
            await bench.step(None, *takes)
        same("results that wait", room, len(bench.model.results[stopped]))
        same("results of the other kind that wait", 0, len(bench.model.results[not stopped]))
        await bench.play([late])
        await bench.drain()


@cocotb.test()
async def reset_at_any_moment_empties_it(dut: Any) -> None:
    """No result of before comes, and it is free at once; the next frame is whole."""
    bench, run = await _bench(dut)

    async def example(before: Frame, clocks: int, after: Frame, manners: Manners) -> None:
        table, jobs = before.make(run.parameters)
        await bench.load(table)
        await bench.play(jobs, manners, most=clocks)
        await bench.restart()
        await bench.drain()
        await bench.frame(*after.make(run.parameters), manners)

    moments = st.integers(0, 20) | st.integers(0, 200)
    await holds(run, example, _frames(run.parameters), moments, _frames(run.parameters), _manners(), cost=6)
