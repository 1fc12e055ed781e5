"""The unit vector of any vector: ports, parameter sets, model.

Primary rays have the set `screen`; the bench of light_vector covers the third width of the core.
"""

import numpy as np
from numpy.random import Generator

from models.core import unit_vector
from models.fixed import Format
from models.formats import Knobs, formats
from verif.env import vectors
from verif.env.fields import Field, Operands, bit
from verif.env.unit import Break, Parameters, PipelinedUnit

FMTS = formats(Knobs())


def _inputs(p: Parameters) -> tuple[Field, ...]:
    return (Field("vector", p["IN_W"], lanes=3),)


def _outputs(p: Parameters) -> tuple[Field, ...]:
    return (
        Field.of("unit", FMTS.unit, lanes=3),
        Field.of("norm", Format(2, FMTS.unit.frac_bits + 1, signed=False)),
        Field("shift", (p["IN_W"] - 1).bit_length(), signed=False),
        bit("degenerate"),
    )


def _model(p: Parameters, operands: Operands) -> Operands:
    return unit_vector(operands["vector"], p["IN_W"], FMTS)._asdict()


def _directed(p: Parameters, generator: Generator, size: int) -> Operands:
    """Vectors of every length in every direction; some zero, some with a component of -1."""
    fmt = Format(p["IN_W"], 0)
    lengths = 2.0 ** generator.uniform(-1.0, p["IN_W"] - 1, size)
    anywhere = vectors.truncated(vectors.directions(generator, size) * lengths, fmt)
    tiny = generator.integers(-1, 0, (3, size), endpoint=True)
    negative = -generator.integers(0, 1, (3, size), endpoint=True) << generator.integers(0, p["IN_W"], size)
    few = np.where(generator.random(size) < 0.5, tiny, negative)
    return {"vector": np.where(generator.random(size) < 0.1, few, anywhere)}


UNIT = PipelinedUnit(
    name="unit_vector",
    parameters={"IN_W": 40},
    sets={"screen": {"IN_W": FMTS.screen.width}, "narrow": {"IN_W": 4}},
    exhaustive="narrow",
    inputs=_inputs,
    outputs=_outputs,
    model=_model,
    directed=_directed,
    breaks=(
        Break("trace/unit_vector.v", ".in_tag    ({shifted_by, ", ".in_tag    ({~shifted_by, "),
        Break("trace/unit_vector.v", ".in_valid  (shifted_valid)", ".in_valid  (in_valid)"),
        Break("trace/unit_vector.v", ".a         (shifted)", ".a         (shifted & ~1)"),
    ),
)
