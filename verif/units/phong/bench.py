"""Tests of what a light adds to a hit: the standard ones, and Phong's equation in float64.

Every product is floored and saturated, so no result is above the equation's; below it by at most
what the floors of both cosines (v), of the powers, of the products and of the last one (w) leave:

    (S - e_S) A - w   with e_S = k_diffuse v + k_specular e_power + 2 w

where S is the sum of both terms, held in range, and A the intensity of the light.
"""

from dataclasses import dataclass

import numpy as np

from models.formats import Formats
from models.header import selected
from models.limits import SHININESS
from verif.env.context import Context
from verif.env.definitions import Holds, all_lanes
from verif.env.fields import Operands, count, describe_all
from verif.env.pipelined import Mismatch, PipelinedBench
from verif.env.pipelined_tests import mixed, standard_tests
from verif.env.unit import Parameters
from verif.env.vectors import SLACK, Floats, where
from verif.units.highlight.bench import power_bound
from verif.units.phong.unit import UNIT

_MONOTONE_STREAM = 1 << 18


def _exact_cosine(given: Operands, name: str, fmts: Formats) -> tuple[Floats, Holds, Holds]:
    """Cosine with L held in range; where it is not positive, and where a step of it or more is left."""
    total = (given[name] * given["direction"]).sum(axis=0)
    number = total / fmts.unit.one**2
    most = fmts.cosine.max / fmts.cosine.one
    return np.clip(number, 0.0, most), total <= 0, total >= fmts.unit.one


@dataclass(frozen=True)
class _Limits:
    """The equation of lit points, (3, n), and how far below it a result may be."""

    most: Floats
    least: Floats

    @classmethod
    def of(cls, given: Operands, fmts: Formats) -> "_Limits":
        """For all operands as if they were lit."""
        step, shade_step = 1.0 / fmts.cosine.one, 1.0 / fmts.shade.one
        names = ("k_diffuse", "k_specular", "intensity")
        diffuse, specular, intensity = (fmts.coeff.to_float(given[name]) for name in names)
        cosine, mirror = (_exact_cosine(given, name, fmts)[0] for name in ("normal", "mirrored"))
        power = np.minimum(mirror**SHININESS, fmts.cosine.max * step)
        most = fmts.shade.max * shade_step
        both = np.minimum(diffuse * cosine + specular * power, most)
        error = diffuse * step + specular * power_bound(mirror, step, step) + 2.0 * shade_step
        below = np.maximum(both - error, 0.0) * intensity
        return cls(
            np.minimum(both * intensity, most) + SLACK,
            np.minimum(below, most) - shade_step - SLACK,
        )


def light_behind_the_surface_or_dark_adds_nothing(p: Parameters, given: Operands, got: Operands) -> Holds:
    """N.L <= 0, exactly, or a light without a direction."""
    behind = _exact_cosine(given, "normal", selected(p))[1] | (given["dark"] == 1)
    return where(behind, all_lanes(got["colour"] == 0))


def light_in_front_adds_what_the_equation_says(p: Parameters, given: Operands, got: Operands) -> Holds:
    """Where a step of N.L is left; never more than the equation, less by no more than the bound."""
    fmts = selected(p)
    front = _exact_cosine(given, "normal", fmts)[2] & (given["dark"] == 0)
    limits, colour = _Limits.of(given, fmts), fmts.shade.to_float(got["colour"])
    return where(front, all_lanes((limits.least <= colour) & (colour <= limits.most)))


def light_that_is_off_adds_nothing(_: Parameters, given: Operands, got: Operands) -> Holds:
    """A channel without intensity stays black."""
    nothing = given["intensity"] == 0
    return where(nothing.any(axis=0), all_lanes(~nothing | (got["colour"] == 0)))


async def more_light_never_darkens(bench: PipelinedBench, run: Context) -> None:
    """The same operands with more light or more reflectance: no channel is less."""
    generator = run.generator(_MONOTONE_STREAM)
    drawn = mixed(bench.unit, generator, run, min(run.operands // 4, 10_000))
    _, before = await bench.answers(drawn)
    names = ("k_diffuse", "k_specular", "intensity")
    most = selected(run.parameters).coeff.max
    more = {
        name: np.minimum(drawn[name] + generator.integers(0, 500, drawn[name].shape), most) for name in names
    }
    _, after = await bench.answers({**drawn, **more})
    darker = np.flatnonzero((after["colour"] < before["colour"]).any(axis=0))
    if darker.size:
        text = describe_all(bench.unit.inputs(run.parameters), drawn, int(darker[0]))
        raise Mismatch(f"{darker.size} of {count(drawn)} operands are darker in more light, as\n{text}")


globals().update(
    standard_tests(
        UNIT,
        light_behind_the_surface_or_dark_adds_nothing,
        light_in_front_adds_what_the_equation_says,
        light_that_is_off_adds_nothing,
        more=(more_light_never_darkens,),
    )
)
