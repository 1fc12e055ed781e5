"""What a system finds at the core's AXI4-Lite port, whichever top is behind it: a check of that top's wires.

The core must be idle meanwhile.
"""

from models.registers import REGISTERS, WORD_BYTES, Access, Build, Register, at
from verif.env.axi import OKAY, SLVERR, RegisterPort
from verif.env.block import same

_ADDRESSES = 1 << 8
_ALL = (1 << 8 * WORD_BYTES) - 1
_LARGEST_SIZE = 0x0FFF0FFF
_WORDS = (_ALL, 0, _LARGEST_SIZE, 0, 0x00030004, 0x5555AAAA)


async def every_address(port: RegisterPort) -> None:
    """Reads all byte addresses, and writes those that take no write: each answer is the map's."""
    for address in range(_ADDRESSES):
        register = at(address)
        found = await port.read(address)
        same(f"read of {address:#04x}", SLVERR if register is None else OKAY, found and found.response)
        if register is None or not register.writable:
            found = await port.write(address, b"\xff")
            same(f"write of {address:#04x}", SLVERR, found and found.response)


async def every_word(port: RegisterPort) -> None:
    """Writes words that fit and words that do not: each register reads what the map makes of them."""
    build = Build()
    for word in _WORDS:
        for register in REGISTERS.values():
            if register.writable:
                # A start or a reset would not leave the core as it is.
                data = word & ~sum(field.mask for field in register.fields if field.access is Access.WO)
                expected = register.written(await _read(port, register), data, 0xF, build)
                answer = await port.write(register.address, data.to_bytes(WORD_BYTES, "little"))
                same(f"write of {register.name}", OKAY, answer and answer.response)
                same(f"{register.name}, written {data:#x}", expected, await _read(port, register))


async def _read(port: RegisterPort, register: Register) -> int:
    return register.word(await port.get(register.name))
