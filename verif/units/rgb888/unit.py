"""Colours as bytes: ports, model, colours around every byte's edge."""

import numpy as np
from numpy.random import Generator

from models.core import rgb888
from models.core.pixel import FULL
from models.formats import Knobs, formats
from verif.env.fields import Field, Operands
from verif.env.unit import Break, Parameters, PipelinedUnit

FMTS = formats(Knobs())


def _inputs(_: Parameters) -> tuple[Field, ...]:
    return (Field.of("colour", FMTS.shade, lanes=3),)


def _outputs(_: Parameters) -> tuple[Field, ...]:
    return (Field.of("pixel", FMTS.channel, lanes=3),)


def _model(_: Parameters, operands: Operands) -> Operands:
    return {"pixel": rgb888(operands["colour"], FMTS)}


def _directed(_: Parameters, generator: Generator, size: int) -> Operands:
    """The edges of all bytes in turn, 1 and a little more, and then their neighbours."""
    edges = -(-np.arange(FULL + 3) * FMTS.shade.one // FULL)
    beside = (edges + np.array([[0], [-1], [1]])).ravel()
    turns = [np.resize(generator.permutation(beside), size) for _ in range(3)]
    return {"colour": FMTS.shade.saturate(turns)}


UNIT = PipelinedUnit(
    name="rgb888",
    inputs=_inputs,
    outputs=_outputs,
    model=_model,
    directed=_directed,
    breaks=(
        Break("pixel/rgb888.v", " | {CHANNEL_W{over}}", ""),
        Break("pixel/rgb888.v", "{{CHANNEL_W{1'b0}}, c}", "{{CHANNEL_W + 1{1'b0}}, c[W-1:1]}"),
        Break("pixel/rgb888.v", ".LATENCY(1)", ".LATENCY(2)"),
    ),
)
