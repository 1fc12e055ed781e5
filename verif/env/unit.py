"""What a unit is, to the tests outside the simulator and to the bench inside it.

A folder `verif/units/<unit>/` holds `unit.py`, which names the module, its parameter sets, ports
and model as a `Unit`, and `bench.py`, which the simulator runs. This module imports no cocotb.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from models.latency import LATENCY
from verif.env.fields import Field, Operands

Parameters = Mapping[str, int]

TAG_W = 8
"""Width of the tag in benches: wide enough that no two operands in flight share one."""


@dataclass(frozen=True)
class Unit:
    """One module under test.

    name: module, folder and latency entry. parameters: the Verilog's defaults. sets: named
    changes to them, each a build; `default` is always there. defines: macros of the build.
    exhaustive: the set, if any, narrow enough to try every operand.
    """

    name: str
    parameters: Parameters = field(default_factory=dict)
    sets: Mapping[str, Parameters] = field(default_factory=dict)
    defines: Mapping[str, int] = field(default_factory=dict)
    exhaustive: str | None = None

    def parameter_sets(self) -> dict[str, Parameters]:
        """Every set, complete."""
        return {
            name: {**self.parameters, **changes} for name, changes in {"default": {}, **self.sets}.items()
        }


def _as_drawn(_parameters: Parameters, operands: Operands) -> Operands:
    return operands


@dataclass(frozen=True)
class PipelinedUnit(Unit):
    """A unit that takes an operand every clock and answers after a constant latency.

    inputs, outputs: ports beside valid and tag. model: outputs from operands, vectorised. legal:
    maps arbitrary operands to those that the unit's header allows. directed: more operands worth
    trying, mixed into the fast stream.
    """

    inputs: Callable[[Parameters], tuple[Field, ...]] = lambda _: ()
    outputs: Callable[[Parameters], tuple[Field, ...]] = lambda _: ()
    model: Callable[[Parameters, Operands], Operands] = lambda _, operands: operands
    legal: Callable[[Parameters, Operands], Operands] = _as_drawn
    directed: Callable[..., Operands] | None = None

    def parameter_sets(self) -> dict[str, Parameters]:
        """Every set, complete, with the bench's tag width."""
        return {name: {**found, "TAG_W": TAG_W} for name, found in super().parameter_sets().items()}

    def latency(self, parameters: Parameters) -> int:
        """Clocks from operand to result, as promised."""
        return LATENCY[self.name](parameters)
