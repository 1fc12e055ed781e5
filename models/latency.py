"""Clocks from ``in_valid`` to ``out_valid`` of every unit, by module name, from its Verilog parameters.

For an iterative unit it is the time from the acceptance of an operand. A parameter that is not given has
the default of the module.
"""

from collections.abc import Callable, Mapping

from models.formats import Knobs, formats
from models.header import selected

Parameters = Mapping[str, int]

_MUL = 3
_BLOCK_SHIFT = 2
_RESULT_REGISTER = 1
_DOT = _MUL + 1 + _RESULT_REGISTER
_PRODUCT = _MUL + _RESULT_REGISTER


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


def _object_setup(frame: Parameters) -> int:
    """Of a frame with SPHERES (1) and TRIANGLES (0); NORMALISER: latency of the one that it shares."""
    ends = next_object = read = load = write = 1
    around = next_object + read + load + write
    sphere = around + formats(Knobs()).inv_radius.width
    asked = 1
    normaliser = frame.get("NORMALISER", _unit_vector({}))
    triangle = around + 9 + _MUL + asked + normaliser
    return 2 * next_object + ends + frame.get("SPHERES", 1) * sphere + frame.get("TRIANGLES", 0) * triangle


def _camera(_: Parameters) -> int:
    """Of a camera without a fault: d and u are normalised together, v behind them."""
    fmts = formats(Knobs())
    view = asked = done = 1
    products = 6 + _MUL
    bases = 2 * (asked + _unit_vector({})) + asked
    divisions = 6 * (asked + fmts.span.width)
    return view + 3 * products + bases + divisions + done


def _unit_vector(parameters: Parameters) -> int:
    fmts = selected(parameters)
    unit = {"INT": 1, "FRAC": fmts.mantissa.frac_bits, "OUT_FRAC": fmts.unit.frac_bits}
    return _BLOCK_SHIFT + _normalise(unit)


def _light_vector(parameters: Parameters) -> int:
    difference = limit = 1
    return difference + _unit_vector(parameters) + limit


def _intersection(parameters: Parameters) -> int:
    corners = 1 + _BLOCK_SHIFT
    move = offset = square_sum = discriminant = ends = hit = 1
    root = _sqrt({"D_W": 2 * selected(parameters).half_chord.width})
    to_offset = corners + _DOT + _MUL + move + offset
    return to_offset + _MUL + square_sum + discriminant + root + ends + hit


_SURFACE = _PRODUCT + 1 + _PRODUCT
_REFLECT = _DOT + _PRODUCT + 1
_HIGHLIGHT = 4 * _PRODUCT
_COLOUR_ADD = 1
_PHONG = _DOT + _HIGHLIGHT + _PRODUCT + _COLOUR_ADD + _PRODUCT + _RESULT_REGISTER


def _refract(_: Parameters) -> int:
    sine = radicand = gain = total = 1
    root = _sqrt({"D_W": 2 * formats(Knobs()).gain.frac_bits + 2})
    return _MUL + sine + _MUL + radicand + root + gain + _MUL + total + _RESULT_REGISTER


_TABLE = 1
_FIFO = 2


def _trace_unit(parameters: Parameters) -> int:
    """From a ray's last test to its result, where nothing is before it."""
    nearest = 1
    return _TABLE + _intersection(parameters) + nearest + _FIFO


def _children(_: Parameters) -> int:
    return _TABLE + _PRODUCT + _refract({}) + _RESULT_REGISTER


def _lighting(parameters: Parameters) -> int:
    return _light_vector(parameters) + _TABLE + _PHONG + _PRODUCT + _RESULT_REGISTER


LATENCY: dict[str, Callable[[Parameters], int]] = {
    "add_sub": _constant(1),
    "block_shift": _constant(_BLOCK_SHIFT),
    "camera": _camera,
    "children": _children,
    "colour_add": _constant(_COLOUR_ADD),
    "cross_product": _constant(_DOT),
    "delay": lambda parameters: parameters.get("DEPTH", 1),
    "dim": _constant(0),
    "dispatch": _constant(0),
    "div": _div,
    "div_core": _div_core,
    "div_iter": lambda parameters: parameters.get("NUM_W", 24),
    "dot": _constant(_DOT),
    "highlight": _constant(_HIGHLIGHT),
    "intersection": _intersection,
    "iterate": lambda parameters: parameters.get("STEPS", 20),
    "light_vector": _light_vector,
    "lighting": _lighting,
    "merge": _constant(1),
    "mul": _constant(_MUL),
    "mul_piece": _constant(1),
    "norm": _norm,
    "normalise": _normalise,
    "object_setup": _object_setup,
    "phong": _constant(_PHONG),
    "reflect": _constant(_REFLECT),
    "refract": _refract,
    "resize": _constant(0),
    "rgb888": _constant(1),
    "sqrt": _sqrt,
    "sqrt_iter": lambda parameters: parameters.get("D_W", 40) // 2,
    "sqrt_step": _constant(0),
    "steps": _constant(1),
    "surface": _constant(_SURFACE),
    "trace_unit": _trace_unit,
    "unit_vector": _unit_vector,
    "valid_pipe": lambda parameters: parameters.get("LATENCY", 1),
    "vec_mul": _constant(_PRODUCT),
    "vec_scale": _constant(_PRODUCT),
}
"""Latency of each module as a function of its parameters."""
