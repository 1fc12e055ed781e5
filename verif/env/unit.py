"""What a unit is, to the tests outside the simulator and to the bench inside it.

A folder `verif/units/<unit>/` holds `unit.py`, which names the module, its parameter sets, ports
and model as a `Unit`, and `bench.py`, which the simulator runs. This module imports no cocotb.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from numpy.random import Generator

from models.latency import LATENCY
from verif.env.fields import Field, Operands

Parameters = Mapping[str, int]
"""Parameters of a module, and macros of its build: those that begin with `RT_`, as the header's do."""

TAG_W = 8
"""Width of the tag in benches: wide enough that no two operands in flight share one."""


def macros(parameters: Parameters) -> Parameters:
    """Those that are macros of the build, such as `models.header.defines` names its knobs."""
    return {name: value for name, value in parameters.items() if name.startswith("RT_")}


def of_module(parameters: Parameters) -> Parameters:
    """Those that are the module's own."""
    return {name: value for name, value in parameters.items() if not name.startswith("RT_")}


@dataclass(frozen=True)
class Break:
    """One changed line of the design, which the unit's bench must notice.

    file: relative to `hdl/`. old, new: text that occurs once in the file, and what replaces it.
    set: the parameter set whose run must fail.
    """

    file: str
    old: str
    new: str
    set: str = "default"


@dataclass(frozen=True)
class Unit:
    """One module under test.

    name: module, folder and latency entry. parameters: the Verilog's defaults. sets: named
    changes to them and macros, each a build; `default` is always there. defines: macros of the build.
    exhaustive: the set, if any, narrow enough to try every operand. top: module at the top of the
    build, where it is not the module itself but a wrapper in the unit's folder. tests: of a set with
    which all of them would take too long, the one that is run. breaks: changes of the design that prove
    that the bench can fail.
    """

    name: str
    parameters: Parameters = field(default_factory=dict)
    sets: Mapping[str, Parameters] = field(default_factory=dict)
    defines: Mapping[str, int] = field(default_factory=dict)
    exhaustive: str | None = None
    top: str = ""
    tests: Mapping[str, str] = field(default_factory=dict)
    breaks: tuple[Break, ...] = ()

    @property
    def module(self) -> str:
        """The module that the bench sees."""
        return self.top or self.name

    def parameter_sets(self) -> dict[str, Parameters]:
        """Every set, complete."""
        return {
            name: {**self.parameters, **changes} for name, changes in {"default": {}, **self.sets}.items()
        }


def _as_drawn(_parameters: Parameters, operands: Operands) -> Operands:
    return operands


@dataclass(frozen=True)
class ArithmeticUnit(Unit):
    """A unit that gives one result for each operand, in order, after a constant latency.

    inputs, outputs: ports beside those of the handshake. model: outputs from operands,
    vectorised. legal: maps arbitrary operands to those that the unit's header allows. directed:
    given a generator and a size, about as many operands of classes that random ones miss; they
    are mixed into the fast stream.
    """

    inputs: Callable[[Parameters], tuple[Field, ...]] = lambda _: ()
    outputs: Callable[[Parameters], tuple[Field, ...]] = lambda _: ()
    model: Callable[[Parameters, Operands], Operands] = lambda _, operands: operands
    legal: Callable[[Parameters, Operands], Operands] = _as_drawn
    directed: Callable[[Parameters, Generator, int], Operands] | None = None

    def latency(self, parameters: Parameters) -> int:
        """Clocks from operand to result, as promised."""
        return LATENCY[self.name](parameters)


@dataclass(frozen=True)
class PipelinedUnit(ArithmeticUnit):
    """A unit that takes an operand every clock and never stalls; a tag rides along."""

    def parameter_sets(self) -> dict[str, Parameters]:
        """Every set, complete, with the bench's tag width."""
        return {name: {**found, "TAG_W": TAG_W} for name, found in super().parameter_sets().items()}


@dataclass(frozen=True)
class StreamUnit(ArithmeticUnit):
    """A unit between two valid/ready streams, ``in`` and ``out``: one result an operand.

    Its latency counts from the acceptance of an operand to the offer of its result. clocks_per_item:
    the promised rate; without it a result takes as long as its latency.
    """

    clocks_per_item: Callable[[Parameters], int] | None = None

    def rate(self, parameters: Parameters) -> int:
        """Clocks from one result to the next where neither side waits."""
        return (self.clocks_per_item or self.latency)(parameters)
