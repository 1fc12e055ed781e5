"""Thin Verilog around a pipelined unit: everything in on one port, everything out on one port.

One access a clock and side instead of one a port is what makes a fast stream fast. The text is
made from the unit's ports, so no bench has a wrapper to keep.
"""

from collections.abc import Sequence

from verif.env.fields import Field
from verif.env.unit import TAG_W, Parameters, PipelinedUnit, of_module

TOP = "harness"
"""Name of the generated module."""


def control(top: str) -> str:
    """Verilator control file that keeps just the signals of the top module visible."""
    return f'`verilator_config\npublic_flat_rw -module "{top}" -var "*"\n'


CONTROL = control(TOP)
"""Control file of the generated module."""


def framed(fields: Sequence[Field]) -> tuple[Field, ...]:
    """What one side carries, most significant first: valid, tag, the unit's ports."""
    return (Field("valid", 1, signed=False), Field("tag", TAG_W, signed=False), *fields)


def _connections(side: str, fields: Sequence[Field]) -> list[str]:
    names = {"valid": f"{side}_valid", "tag": f"{side}_tag"}
    low = sum(field.bits for field in fields)
    lines = []
    for field in fields:
        low -= field.bits
        lines.append(f".{names.get(field.name, field.name)}({side}[{low}+:{field.bits}])")
    return lines


def verilog(unit: PipelinedUnit, parameters: Parameters) -> str:
    """The harness of a unit with these parameters."""
    given, got = framed(unit.inputs(parameters)), framed(unit.outputs(parameters))
    values = ", ".join(f".{name}({value})" for name, value in of_module(parameters).items())
    ports = [".clk(clk)", ".rst(rst)", *_connections("in", given), *_connections("out", got)]
    return "\n".join(
        [
            f"module {TOP} (",
            "    input wire clk,",
            "    input wire rst,",
            f"    input wire [{sum(field.bits for field in given) - 1}:0] in,",
            f"    output wire [{sum(field.bits for field in got) - 1}:0] out",
            ");",
            f"    {unit.module} #({values}) dut (",
            "        " + ",\n        ".join(ports),
            "    );",
            "endmodule",
            "",
        ]
    )
