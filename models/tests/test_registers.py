"""The register map: its shape, the rules by which fields keep what is written, and what is made from it."""

import tomllib
from itertools import combinations
from math import radians, tan
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from models import registers
from models.limits import MAX_DEPTH, Fault
from models.registers import ADDRESS_W, REGISTERS, WORD_BYTES, Access, Build, at

_ROOT = Path(__file__).parents[2]
_WORDS = st.integers(0, (1 << 32) - 1)
_STROBES = st.integers(0, 15)
_BUILDS = (Build(), Build(units=1, size_w=10, max_depth=1), Build(size_w=16, max_depth=7, triangles=255))
_ALL_BYTES = 0b1111


def _written(name: str, word: int, build: Build = _BUILDS[0], strobe: int = _ALL_BYTES) -> dict[str, int]:
    register = REGISTERS[name]
    return register.values(register.written(register.reset(build), word, strobe, build))


def test_addresses_are_words_in_order_and_fit_the_port() -> None:
    addresses = [register.address for register in REGISTERS.values()]
    assert addresses == list(range(0, WORD_BYTES * len(addresses), WORD_BYTES))
    assert addresses[-1] < 1 << ADDRESS_W
    assert [register.name for register in REGISTERS.values()] == list(REGISTERS)


def test_fields_do_not_overlap_and_their_numbers_fit() -> None:
    for register in REGISTERS.values():
        for one, other in combinations(register.fields, 2):
            assert not one.mask & other.mask, f"{register.name}: {one.name}, {other.name}"
        for build in _BUILDS:
            assert register.values(register.reset(build)) == {
                field.name: build.number(field.reset) for field in register.fields
            }


def test_an_address_selects_its_word() -> None:
    assert all(
        at(register.address + byte) is register for register in REGISTERS.values() for byte in range(4)
    )
    assert at(WORD_BYTES * len(REGISTERS)) is None


def test_the_version_is_that_of_the_project() -> None:
    project = tomllib.loads((_ROOT / "pyproject.toml").read_text())["project"]
    major, minor, _ = project["version"].split(".")
    assert (int(major), int(minor)) == registers.VERSION
    assert REGISTERS["ID"].reset(Build()).to_bytes(4) == bytes((ord("R"), ord("T"), *registers.VERSION))


def test_reset_values_are_those_of_the_book() -> None:
    build = Build()
    assert REGISTERS["SIZE"].values(REGISTERS["SIZE"].reset(build)) == {"width": 512, "height": 512}
    for name in ("TAN_H", "TAN_V"):
        assert abs(REGISTERS[name].reset(build) / 2**16 - tan(radians(30))) <= 2**-17
    assert REGISTERS["DEPTH"].reset(build) == MAX_DEPTH
    assert REGISTERS["CONTROL"].values(REGISTERS["CONTROL"].reset(build))["auto"] == 1


def test_the_code_of_every_fault_fits() -> None:
    assert max(Fault) < 1 << REGISTERS["ERROR"].field("code").width


@pytest.mark.parametrize(
    ("name", "word", "kept"),
    [
        ("DEPTH", 0, {"value": 1}),
        ("DEPTH", 3, {"value": 3}),
        ("DEPTH", 6, {"value": 5}),
        ("DEPTH", 0x8000_0001, {"value": 5}),
        ("SIZE", 0x0FFF_0FFF, {"width": 4095, "height": 4095}),
        ("SIZE", 0x1000_0280, {"width": 640, "height": 0}),
        ("SIZE", 0x01E0_1000, {"width": 0, "height": 480}),
        ("TAN_H", 0x7_FFFF, {"value": 0x7_FFFF}),
        ("TAN_H", 0x8_0000, {"value": 0x7_FFFF}),
        ("CONTROL", 0b111, {"start": 0, "auto": 1, "reset": 0}),
        ("ERROR", 0b111, {"code": 0}),
    ],
)
def test_what_becomes_of_a_write(name: str, word: int, kept: dict[str, int]) -> None:
    assert _written(name, word) == kept


def test_a_one_clears_and_a_zero_does_not() -> None:
    interrupt = REGISTERS["INTERRUPT"]
    assert [interrupt.written(0b11, data, _ALL_BYTES, Build()) for data in range(4)] == [
        0b11,
        0b10,
        0b01,
        0b00,
    ]
    assert interrupt.written(0b11, 0b11, 0b1110, Build()) == 0b11


def test_what_a_write_asks_for() -> None:
    control = REGISTERS["CONTROL"]
    assert control.asked(0b111, _ALL_BYTES) == {"start", "reset"}
    assert control.asked(0b001, 0b0001) == {"start"}
    assert control.asked(0b111, 0b1110) == frozenset()


@given(st.sampled_from(list(REGISTERS)), _WORDS, _WORDS, _STROBES, st.sampled_from(_BUILDS))
def test_bytes_that_are_not_written_stay(name: str, first: int, data: int, strobe: int, build: Build) -> None:
    """A write of some bytes is a write of the whole word with the others as they were."""
    register = REGISTERS[name]
    old = register.written(register.reset(build), first, _ALL_BYTES, build)
    lanes = registers.byte_lanes(strobe)
    # Where a written 1 clears, a byte that stays is one written as 0.
    whole = data & lanes if register.access is Access.RW1C else old & ~lanes | data & lanes
    assert register.written(old, data, strobe, build) == register.written(old, whole, _ALL_BYTES, build)
    assert register.written(old, data, 0, build) == old


@given(st.sampled_from(list(REGISTERS)), _WORDS, st.sampled_from(_BUILDS))
def test_what_is_kept_can_be_written_back(name: str, data: int, build: Build) -> None:
    register = REGISTERS[name]
    kept = register.written(register.reset(build), data, _ALL_BYTES, build)
    if register.access is Access.RW:
        assert register.written(register.reset(build), kept, _ALL_BYTES, build) == kept
    if not register.writable:
        assert kept == register.reset(build)


@given(st.sampled_from(list(REGISTERS)), st.data())
def test_fields_make_a_word_and_a_word_fields(name: str, data: st.DataObject) -> None:
    register = REGISTERS[name]
    drawn = {field.name: data.draw(st.integers(0, (1 << field.width) - 1)) for field in register.fields}
    assert register.values(register.word(drawn)) == drawn


def test_a_number_that_does_not_fit_its_field_is_refused() -> None:
    with pytest.raises(ValueError, match=r"SIZE\.width: 65536 does not fit 16 bits"):
        REGISTERS["SIZE"].word({"width": 1 << 16})
    with pytest.raises(KeyError, match="SIZE has no field depth"):
        REGISTERS["SIZE"].word({"depth": 1})


def test_the_build_comes_from_the_parameters_of_the_verilog() -> None:
    build = Build.of({"UNITS": 3, "SIZE_W": 11, "TRIANGLES": 255})
    assert (build.units, build.max_size, build.lights) == (3, 2047, 3)
    assert REGISTERS["CAPACITY"].reset(build) == 255 << 16 | 3 << 8 | 3
    assert REGISTERS["UNITS"].reset(build) == 3


def test_the_macros_name_every_register_once() -> None:
    names = [line.split()[1] for line in registers.macros()]
    assert len(names) == len(set(names))
    assert {f"RT_REG_{name}" for name in REGISTERS} <= set(names)
    masks = dict(line.split()[1:] for line in registers.macros() if "ABLE " in line and "64'h" in line)
    assert {name: int(value.partition("h")[2], 16) for name, value in masks.items()} == {
        "RT_REG_WRITABLE": sum(1 << r.address // 4 for r in REGISTERS.values() if r.writable),
        "RT_REG_READABLE": (1 << len(REGISTERS)) - 1,
    }
