"""A bench that fails on the unit itself: nothing can be said of mutants with it."""

from typing import Any

import cocotb


@cocotb.test()
async def nothing_is_right(_: Any) -> None:
    """Always fails."""
    raise AssertionError("nothing is")
