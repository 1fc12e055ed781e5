"""Clocks from ``in_valid`` to ``out_valid`` of every unit, by module name, from its Verilog parameters.

For an iterative unit it is the time from the acceptance of an operand. A parameter that is not given has
the default of the module.
"""

from collections.abc import Callable, Mapping

Parameters = Mapping[str, int]

_MUL = 3
_RESULT_REGISTER = 1


def _constant(clocks: int) -> Callable[[Parameters], int]:
    return lambda _: clocks


def _sqrt(parameters: Parameters) -> int:
    adjust = 1
    return parameters.get("D_W", 40) // 2 + adjust


def _div_core(parameters: Parameters) -> int:
    return parameters.get("QUOT_W", 18)


def _fixed_bits(parameters: Parameters) -> int:
    return parameters.get("INT", 9) + parameters.get("FRAC", 10) + parameters.get("GUARD", 0)


def _div(parameters: Parameters) -> int:
    magnitudes = sign = 1
    return magnitudes + _div_core({"QUOT_W": _fixed_bits(parameters) - 1}) + sign


def _norm(parameters: Parameters) -> int:
    square_sum = 1
    return _MUL + square_sum + _sqrt({"D_W": 2 * (_fixed_bits(parameters) + 1)})


def _normalise(parameters: Parameters) -> int:
    sign = 1
    return _norm(parameters) + _div_core({"QUOT_W": parameters.get("OUT_FRAC", 10) + 1}) + sign


LATENCY: dict[str, Callable[[Parameters], int]] = {
    "add_sub": _constant(1),
    "block_shift": _constant(2),
    "cross_product": _constant(_MUL + 1 + _RESULT_REGISTER),
    "delay": lambda parameters: parameters.get("DEPTH", 1),
    "div": _div,
    "div_core": _div_core,
    "div_iter": lambda parameters: parameters.get("NUM_W", 24),
    "dot": _constant(_MUL + 1 + _RESULT_REGISTER),
    "iterate": lambda parameters: parameters.get("STEPS", 20),
    "mul": _constant(_MUL),
    "mul_piece": _constant(1),
    "norm": _norm,
    "normalise": _normalise,
    "resize": _constant(0),
    "sqrt": _sqrt,
    "sqrt_iter": lambda parameters: parameters.get("D_W", 40) // 2,
    "sqrt_step": _constant(0),
    "valid_pipe": lambda parameters: parameters.get("LATENCY", 1),
    "vec_mul": _constant(_MUL + _RESULT_REGISTER),
    "vec_scale": _constant(_MUL + _RESULT_REGISTER),
}
"""Latency of each module as a function of its parameters."""
