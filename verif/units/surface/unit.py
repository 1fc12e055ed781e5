"""Hit point and normal: ports, model, hits that the ray-sphere test has found."""

from typing import Any

import numpy as np
from numpy.random import Generator

from models.core import sphere_intersect, surface
from models.fixed import Raw
from models.formats import Knobs, formats
from verif.env.fields import Field, Operands, bit
from verif.env.unit import Break, Parameters, PipelinedUnit
from verif.units.sphere_intersect import rays

FMTS = formats(Knobs())


def _inputs(_: Parameters) -> tuple[Field, ...]:
    return (
        Field.of("direction", FMTS.unit, lanes=3),
        Field.of("offset", FMTS.offset, lanes=3),
        Field.of("half_chord", FMTS.half_chord),
        bit("leaving"),
        Field.of("center", FMTS.coord, lanes=3),
        Field.of("inv_radius", FMTS.inv_radius),
    )


def _outputs(_: Parameters) -> tuple[Field, ...]:
    return (Field.of("point", FMTS.point, lanes=3), Field.of("normal", FMTS.unit, lanes=3))


def _model(p: Parameters, operands: Operands) -> Operands:
    given: dict[str, Any] = {port.name: operands[port.name] for port in _inputs(p)}
    given["leaving"] = given["leaving"] == 1
    return surface(**given, fmts=FMTS)._asdict()


def _directed(_: Parameters, generator: Generator, size: int) -> Operands:
    """Consistent hits; about a third of the rays hits."""
    center, radius = rays.spheres(generator, 3 * size, FMTS)
    origin, direction = rays.aimed(generator, center, radius, 3 * size, FMTS)
    found = sphere_intersect(origin, direction, center, radius * radius, FMTS.point.max, FMTS)
    hit = np.flatnonzero(found.hit)[:size]
    return {
        "direction": direction[:, hit],
        "offset": found.offset[:, hit],
        "half_chord": found.half_chord[hit],
        "leaving": found.leaving[hit].astype(np.int64),
        "center": center[:, hit],
        "inv_radius": inverse(radius[hit]),
    }


def inverse(radius: Raw) -> Raw:
    """1 / radius in `inv_radius` of radii in `radius`, floored."""
    return np.asarray((1 << (FMTS.inv_radius.frac_bits + FMTS.radius.frac_bits)) // radius)


UNIT = PipelinedUnit(
    name="surface",
    inputs=_inputs,
    outputs=_outputs,
    model=_model,
    directed=_directed,
    breaks=(
        Break("shade/surface.v", "chord_leaving ? m_wide : -m_wide", "-m_wide"),
        Break("shade/surface.v", "chord_leaving ? q_wide - h_wide : q_wide + h_wide", "q_wide + h_wide"),
        Break("shade/surface.v", "({point_reg, turned_tag})", "({point_next, turned_tag})"),
    ),
)
