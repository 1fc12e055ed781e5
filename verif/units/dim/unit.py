"""Light behind an object: ports, model, products at the limit, shares that are full and none."""

import numpy as np
from numpy.random import Generator

from models.arith import vec_mul
from models.formats import BUILDS
from models.header import defines, selected
from verif.env.fields import Field, Operands
from verif.env.unit import Break, Parameters, PipelinedUnit
from verif.units.products import pairs_at_the_limit
from verif.units.shading import colours


def _inputs(p: Parameters) -> tuple[Field, ...]:
    fmts = selected(p)
    return (Field.of("colour", fmts.shade, lanes=3), Field.of("share", fmts.coeff, lanes=3))


def _outputs(p: Parameters) -> tuple[Field, ...]:
    return (Field.of("dimmed", selected(p).shade, lanes=3),)


def _model(p: Parameters, operands: Operands) -> Operands:
    fmts = selected(p)
    return {"dimmed": vec_mul(operands["colour"], operands["share"], fmts.shade, fmts.coeff, fmts.shade)}


def _directed(p: Parameters, generator: Generator, size: int) -> Operands:
    """Colours and shares as scenes have them, and pairs whose product is next to the largest colour."""
    fmts = selected(p)
    product = {
        "A_INT": fmts.shade.int_bits,
        "A_FRAC": fmts.shade.frac_bits,
        "B_INT": fmts.coeff.int_bits,
        "B_FRAC": fmts.coeff.frac_bits,
        "OUT_INT": fmts.shade.int_bits,
        "OUT_FRAC": fmts.shade.frac_bits,
        "SIGNED": 0,
    }
    colour, share = pairs_at_the_limit(product, generator, (3, size))
    usual = generator.random(size) < 0.7
    return {
        "colour": np.where(usual, colours(generator, size, fmts.shade), colour),
        "share": np.where(usual, colours(generator, size, fmts.coeff), share),
    }


_FILE = "trace/dim.v"

UNIT = PipelinedUnit(
    name="dim",
    top="dim_port",
    sets={"book": defines(BUILDS["book"])},
    inputs=_inputs,
    outputs=_outputs,
    model=_model,
    directed=_directed,
    breaks=(
        Break(_FILE, "`RT_COEFF_INT + 1)", "`RT_COEFF_INT)"),
        Break(_FILE, "({1'b0, product})", "({product[PRODUCT_W-1], product})"),
        Break(_FILE, "share[lane*SHARE_W+:SHARE_W];", "share[0+:SHARE_W];"),
        Break(_FILE, ".OUT_SIGNED(0)", ".OUT_SIGNED(1)"),
    ),
)
