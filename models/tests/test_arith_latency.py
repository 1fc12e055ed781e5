"""The table of latencies against the Verilog and its header comments."""

import ast
import re
from pathlib import Path

import pytest

from models.latency import LATENCY

HDL = Path(__file__).parents[2] / "hdl" / "arith"
MODULES = sorted(path.stem for path in HDL.glob("*.v"))
PARAMETER = re.compile(r"^    parameter (\w+)\s*= (\d+)", re.MULTILINE)
STATED = re.compile(r"^// Latency ([A-Z0-9_+/ ]+?)(?: \(|,| clocks from| clocks of)", re.MULTILINE)


def stated_latency(text: str, parameters: dict[str, int]) -> int:
    """The latency that a header comment states, a sum and quotient of parameters and numbers."""
    if re.search(r"^// Combinational\.", text, re.MULTILINE):
        return 0
    found = STATED.search(text)
    assert found is not None, "the header comment states no latency"
    return int(_evaluate(ast.parse(found[1], mode="eval").body, parameters))


def _evaluate(node: ast.expr, parameters: dict[str, int]) -> int:
    match node:
        case ast.Constant(value=int(number)):
            return number
        case ast.Name(id=name):
            return parameters[name]
        case ast.BinOp(left=left, op=ast.Add(), right=right):
            return _evaluate(left, parameters) + _evaluate(right, parameters)
        case ast.BinOp(left=left, op=ast.Div(), right=right):
            return _evaluate(left, parameters) // _evaluate(right, parameters)
    raise AssertionError(f"a latency of {ast.dump(node)}")


def test_every_unit_has_a_latency_and_every_latency_a_unit() -> None:
    assert set(MODULES) <= set(LATENCY)


@pytest.mark.parametrize("module", MODULES)
@pytest.mark.parametrize("more", [0, 2, 4])
def test_the_latency_in_the_header_is_the_one_of_the_table(module: str, more: int) -> None:
    text = (HDL / f"{module}.v").read_text(encoding="utf-8")
    parameters = {name: int(number) + more for name, number in PARAMETER.findall(text)}
    assert LATENCY[module](parameters) == stated_latency(text, parameters)


@pytest.mark.parametrize("module", MODULES)
def test_a_parameter_that_is_not_given_has_the_default_of_the_module(module: str) -> None:
    text = (HDL / f"{module}.v").read_text(encoding="utf-8")
    defaults = {name: int(number) for name, number in PARAMETER.findall(text)}
    assert LATENCY[module]({}) == LATENCY[module](defaults)
