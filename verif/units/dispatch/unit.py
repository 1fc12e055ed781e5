"""The dispatch of rays to one, two, three and four units, side by side in a wrapper; every input is tried."""

from collections.abc import Mapping

import numpy as np

from models.fixed import Raw
from verif.env.fields import Field, Operands, bit
from verif.env.unit import Break, Parameters, PipelinedUnit

MOST = 4
"""Units of the largest dispatch."""


def _units(name: str, units: int) -> Field:
    return Field(name, units, signed=False)


def _inputs(_: Parameters) -> tuple[Field, ...]:
    free = [_units(f"{kind}_free", MOST) for kind in ("ray", "shadow")]
    return (bit("ray_valid"), bit("shadow_valid"), *free)


def _outputs(_: Parameters) -> tuple[Field, ...]:
    ready = [_units(f"{kind}_ready", MOST) for kind in ("ray", "shadow")]
    starts = [
        _units(f"{kind}_start_{units}", units) for units in range(1, MOST + 1) for kind in ("ray", "shadow")
    ]
    return (*ready, *starts)


def _lowest(bits: Raw) -> Raw:
    return np.asarray(bits & -bits)


def _highest(bits: Raw) -> Raw:
    """The powers of two of 4-bit numbers; 0 of none."""
    return np.array([0] + [1 << (number.bit_length() - 1) for number in range(1, 1 << MOST)])[bits]


def _model(_: Parameters, operands: Operands) -> Operands:
    ready = {kind: np.zeros_like(operands["ray_valid"]) for kind in ("ray", "shadow")}
    starts: dict[str, Raw] = {}
    for units in range(1, MOST + 1):
        free: Mapping[str, Raw] = {kind: operands[f"{kind}_free"] & ((1 << units) - 1) for kind in ready}
        shadow = _lowest(free["shadow"]) * operands["shadow_valid"]
        left = free["ray"] & ~shadow
        starts[f"shadow_start_{units}"] = shadow
        starts[f"ray_start_{units}"] = _highest(left) * operands["ray_valid"]
        ready["shadow"] |= (free["shadow"] != 0).astype(np.int64) << (units - 1)
        ready["ray"] |= (left != 0).astype(np.int64) << (units - 1)
    return {**starts, **{f"{kind}_ready": bits for kind, bits in ready.items()}}


_FILE = "trace/dispatch.v"

UNIT = PipelinedUnit(
    name="dispatch",
    top="dispatch_units",
    exhaustive="default",
    inputs=_inputs,
    outputs=_outputs,
    model=_model,
    breaks=(
        Break(_FILE, "ray_free & ~shadow_start;", "ray_free;"),
        Break(_FILE, "ray_free & ~shadow_start;", "ray_free & ~first;"),
        Break(_FILE, "ray_valid && left[unit] && (left >> unit) == 1;", "ray_valid && left[unit];"),
        Break(_FILE, "first & {UNITS{shadow_valid}};", "first;"),
        Break(_FILE, "shadow_free & (~shadow_free + 1'b1);", "shadow_free & ~(shadow_free << 1);"),
        Break(
            _FILE,
            "shadow_ready = shadow_free != {UNITS{1'b0}};",
            "shadow_ready = shadow_free == {UNITS{1'b1}};",
        ),
    ),
)
