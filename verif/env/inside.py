"""Signals below the top of a design, by their path."""

import re
from typing import Any

_NOT_A_NAME = re.compile(r"\W+")


def flat(path: str) -> str:
    """The one name that stands for a path where the design is a flattened netlist."""
    return _NOT_A_NAME.sub("_", path)


def inside(dut: Any, path: str) -> Any:
    """A signal by its path, as ``u_core.state_reg``; ``scope[3]`` is one of a generated array. None where the
    array has no such scope. Raises AttributeError where there is no such signal."""
    flattened = getattr(dut, flat(path), None)
    if flattened is not None:
        return flattened
    handle = dut
    for part in path.split("."):
        scope, _, index = part.partition("[")
        handle = getattr(handle, scope)
        if index:
            try:
                handle = handle[int(index.removesuffix("]"))]
            except IndexError:
                return None
    return handle
