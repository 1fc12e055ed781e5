"""Registers begin with random bits on Verilator, others for each seed: what works from 0 only is caught."""

import pytest

from verif.env import breaks, units
from verif.env.run import Outcome, run
from verif.env.simulators import Simulator
from verif.env.unit import Break

_SEEDS = (1, 2, 3)

_FIRST = {
    "control": "every_frame_ends_in_done_or_error_in_the_right_order",
    "loader": "every_record_of_every_frame_is_handed_on_exactly",
    "camera": "basis_matches_the_model_for_every_camera_size_and_tangent",
    "object_setup": "rows_of_every_frame_are_exact_and_on_time",
    "ray_store": "every_ray_comes_once_the_deepest_first",
    "pixel_queue": "every_pixel_comes_once_and_in_its_place",
}
"""Units that remember much, and a property of each that one reset precedes."""

_NO_RESET = Break("control.v", "if (rst) state_reg <= S_IDLE;", "if (1'b0) state_reg <= S_IDLE;")


def _run(unit: str, seed: int, change: Break | None = None, random: bool = True) -> Outcome:
    """One property of a unit; without ``random`` registers begin with 0, as they do where coverage counts."""
    found = units.find(unit)
    parameters = found.parameter_sets()["default"]
    replacements = breaks.changed(change) if change else None
    return run(
        units.build(found, Simulator.VERILATOR, parameters, replacements=replacements, coverage=not random),
        f"verif.units.{unit}.bench",
        f"initial-{unit}-{seed}" + ("" if random else "-zero"),
        seed=seed,
        settings={"parameters": dict(parameters), "examples": 4, "extra": {"shrink": False}},
        tests=_FIRST[unit],
    )


def test_a_missing_reset_is_caught_by_what_registers_begin_with() -> None:
    """By random bits of some seed, and not by zeros: a control that has no reset happens to begin idle."""
    zeros = _run("control", 1, _NO_RESET, random=False)
    assert zeros.passed, zeros.complaint()
    caught = [seed for seed in _SEEDS if not _run("control", seed, _NO_RESET).passed]
    assert caught, f"none of the seeds {_SEEDS} begins in a state that shows"


@pytest.mark.parametrize("unit", _FIRST)
def test_one_reset_is_enough_whatever_registers_begin_with(unit: str) -> None:
    """Several beginnings of units that remember much."""
    for seed in _SEEDS:
        outcome = _run(unit, seed)
        assert outcome.passed, outcome.complaint()
