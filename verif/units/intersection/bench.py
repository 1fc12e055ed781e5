"""Tests of the test of a ray against an object: the standard ones, geometry, and no gap between triangles."""

import numpy as np

from models.fixed import Raw
from models.header import selected
from models.limits import T_MIN
from verif.env import context, vectors
from verif.env.definitions import Holds
from verif.env.fields import Operands, count, describe_all, select
from verif.env.pipelined import Mismatch, PipelinedBench
from verif.env.pipelined_tests import standard_tests
from verif.env.unit import Parameters
from verif.units.intersection import patches, sphere_truth, triangle_truth, triangles
from verif.units.intersection.patches import FAN, PAIR, Patch
from verif.units.intersection.unit import UNIT, alternating

_ALTERNATING_STREAM, _SIDES_STREAM, _GAPS_STREAM, _TIES_STREAM, _CORNERS_STREAM = (
    1 << bit for bit in range(18, 23)
)
_SHARE = 5
"""Each test below gets this part of a fast stream."""
_ENOUGH_WITHIN, _ENOUGH_DECIDED = 0.2, 0.15


def no_hit_is_nearer_than_the_smallest_distance_or_at_the_limit(
    p: Parameters, given: Operands, got: Operands
) -> Holds:
    """Exact, for both kinds and for directions of any length."""
    least = int(T_MIN * selected(p).point.one)
    between = (got["distance"] >= least) & (got["distance"] < given["limit"])
    return vectors.where(got["hit"] == 1, between)


async def spheres_and_triangles_in_turn_do_not_disturb_each_other(
    bench: PipelinedBench, run: context.Context
) -> None:
    """The two kinds share multipliers: kinds that change every clock and runs of one kind match the model."""
    size = run.operands // _SHARE // 2 * 2
    drawn = alternating(run.parameters, run.generator(_ALTERNATING_STREAM), size)
    await bench.run(drawn)
    kind = drawn["triangle"]
    await bench.run(select(drawn, np.concatenate([np.flatnonzero(kind == 1), np.flatnonzero(kind == 0)])))


async def both_sides_of_a_triangle_are_hit_at_the_same_distance(
    bench: PipelinedBench, run: context.Context
) -> None:
    """With two corners exchanged and the normal turned, the other side is seen; nothing else changes.

    The first corner stays: distances are measured from it.
    """
    drawn = alternating(run.parameters, run.generator(_SIDES_STREAM), run.operands // _SHARE)
    front = select(drawn, np.flatnonzero((drawn["triangle"] == 1) & drawn["shape"].any(axis=0)))
    back = {**front, "shape": -front["shape"], "vertices": front["vertices"][[0, 1, 2, 6, 7, 8, 3, 4, 5]]}
    given, got = await bench.answers(front)
    _, turned = await bench.answers(back)
    hit = got["hit"] == 1
    wrong = got["hit"] != turned["hit"]
    wrong |= hit & (got["distance"] != turned["distance"])
    parallel = (given["direction"] * given["shape"]).sum(axis=0) == 0
    wrong |= hit & ~parallel & (got["leaving"] == turned["leaving"])
    assert hit.mean() > _ENOUGH_WITHIN, f"of {hit.size} rays {hit.sum()} hit"
    _refuse(bench, run, given, np.flatnonzero(wrong), "the other side is hit otherwise")


async def of_components_about_as_long_the_same_one_leads_as_in_the_model(
    bench: PipelinedBench, run: context.Context
) -> None:
    """At edges, where the rounding that comes of the longest component decides: ties of two and of three."""
    size, fmts = run.operands // _SHARE, selected(run.parameters)
    drawn = triangles.past_edges(run.generator(_TIES_STREAM), size, fmts)
    await bench.run(drawn)
    hits = UNIT.model(run.parameters, drawn)["hit"].mean()
    assert _ENOUGH_WITHIN < hits < 1 - _ENOUGH_WITHIN, f"of {size} rays at edges {hits:.0%} hit"


async def of_short_directions_at_corners_the_lowest_bits_decide(
    bench: PipelinedBench, run: context.Context
) -> None:
    """As in the model; a ray that is moved by one step often meets the triangle where it did not."""
    size, fmts = run.operands // _SHARE, selected(run.parameters)
    drawn = triangles.past_corners(run.generator(_CORNERS_STREAM), size, fmts)
    await bench.run(drawn)
    moved = {**drawn, "origin": fmts.point.saturate(drawn["origin"] + 1)}
    hits, others = (UNIT.model(run.parameters, operands)["hit"] for operands in (drawn, moved))
    decided = (hits != others).mean()
    assert decided > _ENOUGH_DECIDED, f"of {size} rays at corners a step decides {decided:.1%}"


async def no_ray_passes_between_two_triangles_that_share_an_edge(
    bench: PipelinedBench, run: context.Context
) -> None:
    """Aimed at the edge and a few steps beside it, from all sides, near and far: one of the two is hit."""
    await _no_gap(bench, run, PAIR, 0)


async def no_ray_passes_between_the_triangles_around_a_corner(
    bench: PipelinedBench, run: context.Context
) -> None:
    """Aimed at the shared corner and along the shared edges: one of the fan is hit."""
    await _no_gap(bench, run, FAN, 1)


async def _no_gap(bench: PipelinedBench, run: context.Context, patch: Patch, stream: int) -> None:
    triangles = len(patch.triangles)
    size = max(run.operands // _SHARE // triangles, 1)
    drawn = patches.rays_at(run.generator(_GAPS_STREAM, stream), patch, size, run.parameters)
    given, got = await bench.answers(drawn)
    within = patches.aimed_within(patch, run.parameters, given)
    assert within.mean() > _ENOUGH_WITHIN, (
        f"of {size} rays {within.sum()} are clearly within: that checks little"
    )
    missed = np.flatnonzero(within & (got["hit"].reshape(-1, triangles) == 0).all(axis=1))
    _refuse(
        bench, run, given, missed * triangles, "a ray passes between triangles, of which this is the first"
    )


def _refuse(bench: PipelinedBench, run: context.Context, given: Operands, wrong: Raw, statement: str) -> None:
    """Raises Mismatch with the first of the operands that are wrong."""
    if wrong.size:
        shown = describe_all(UNIT.inputs(run.parameters), given, int(wrong[0]))
        raise Mismatch(f"{statement}; {wrong.size} of {count(given)}:\n{shown}")
    bench.log.info("%d operands", count(given))


globals().update(
    standard_tests(
        UNIT,
        *sphere_truth.DEFINITIONS,
        *triangle_truth.DEFINITIONS,
        no_hit_is_nearer_than_the_smallest_distance_or_at_the_limit,
        more=(
            spheres_and_triangles_in_turn_do_not_disturb_each_other,
            both_sides_of_a_triangle_are_hit_at_the_same_distance,
            of_components_about_as_long_the_same_one_leads_as_in_the_model,
            of_short_directions_at_corners_the_lowest_bits_decide,
            no_ray_passes_between_two_triangles_that_share_an_edge,
            no_ray_passes_between_the_triangles_around_a_corner,
        ),
    )
)
