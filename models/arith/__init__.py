"""Bit-exact models of the arithmetic units in ``hdl/arith``: one file and one function a unit, same names.

All take and return raw ``int64`` arrays (see `models.fixed`) and work on many operands at once; vectors
have shape (3, n). Batches of some 8,000 operands are the fastest: their arrays stay in the cache.
"""

from models.arith.add_sub import add_sub
from models.arith.block_shift import Shifted, block_shift
from models.arith.cross_product import cross_product
from models.arith.div import Quotient, div
from models.arith.div_core import div_core
from models.arith.div_iter import div_iter
from models.arith.divide import Division, truncating_divide
from models.arith.dot import dot, exact_dot
from models.arith.mul import mul
from models.arith.norm import norm, norm_format
from models.arith.normalise import Normalised, normalise
from models.arith.resize import resize
from models.arith.sqrt import SquareRoot, isqrt, sqrt, sqrt_iter
from models.arith.vec_mul import vec_mul
from models.arith.vec_scale import vec_scale

__all__ = [
    "Division",
    "Normalised",
    "Quotient",
    "Shifted",
    "SquareRoot",
    "add_sub",
    "block_shift",
    "cross_product",
    "div",
    "div_core",
    "div_iter",
    "dot",
    "exact_dot",
    "isqrt",
    "mul",
    "norm",
    "norm_format",
    "normalise",
    "resize",
    "sqrt",
    "sqrt_iter",
    "truncating_divide",
    "vec_mul",
    "vec_scale",
]
