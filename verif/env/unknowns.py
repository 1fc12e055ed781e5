"""What an input carries while its valid is low: nothing that anybody may look at.

Where the simulator knows X that is X, and a design that looks turns it into an unknown result; elsewhere it
is the complement of what was or will be there, and the result is wrong.
"""

import cocotb

Drive = int | str
"""What a port can be set to: a number, or its bits as text."""


def _knows_x() -> bool:
    """Whether this simulator has four values; a process has one simulator."""
    return "icarus" in getattr(cocotb, "SIM_NAME", "").lower()


def instead(value: int, bits: int) -> Drive:
    """What a port of so many bits carries in place of a value."""
    return "X" * bits if _knows_x() else ~value & ((1 << bits) - 1)


def idle(word: int, bits: int) -> Drive:
    """As `instead`, for a port whose top bit is its valid: that is low, and known."""
    return "0" + "X" * (bits - 1) if _knows_x() else ~word & ((1 << (bits - 1)) - 1)


def partly(value: int, bits: int, shown: int, lanes: int) -> Drive:
    """``value`` in lanes whose bit of ``shown`` is set, else as `instead`; lane 0 is in the low bits."""
    width = bits // lanes
    mask = sum(((1 << width) - 1) << width * lane for lane in range(lanes) if shown >> lane & 1)
    if not _knows_x():
        return ~(value ^ mask) & ((1 << bits) - 1)
    text = f"{value & mask:0{bits}b}"
    known = f"{mask:0{bits}b}"
    return "".join(bit if seen == "1" else "X" for bit, seen in zip(text, known, strict=True))
