"""Tests of cover points, without a simulator: models give the results.

A recipe must reach its own bin by itself, in some parameter set; a bin that another one's recipe reaches by
accident would be a hole on the day when that one changes.
"""

import functools

import numpy as np
import pytest
from numpy.random import Generator

from verif.coverage.designs import find as design
from verif.coverage.exclusions import of_unit
from verif.env import units
from verif.env.coverage.declared import coverage_of_name
from verif.env.coverage.flow import IDLE
from verif.env.coverage.points import Bin, Samples
from verif.env.coverage.sieve import with_results
from verif.env.fields import Operands, count
from verif.env.operands import stream, uniform
from verif.env.unit import ArithmeticUnit, Parameters

SEED = 20240607
SIZES = (32, 256, 2048)


def _arithmetic() -> tuple[str, ...]:
    return tuple(name for name in units.names() if isinstance(units.find(name), ArithmeticUnit))


@functools.cache
def _unit(name: str) -> ArithmeticUnit:
    found = units.find(name)
    assert isinstance(found, ArithmeticUnit)
    return found


def _sampled(unit: ArithmeticUnit, parameters: Parameters, operands: Operands) -> Samples:
    """As a bench samples it that sends one operand after the other."""
    legal = unit.legal(parameters, operands)
    samples = {**with_results(unit, parameters, legal), IDLE: np.zeros(count(legal), dtype=np.int64)}
    return coverage_of_name(unit.name).seen(parameters, samples)


def _reaches(unit: ArithmeticUnit, parameters: Parameters, found: Bin, generator: Generator) -> bool:
    assert found.recipe.shape is not None and found.holds is not None
    for size in SIZES:
        drawn = unit.legal(parameters, uniform(generator, unit.inputs(parameters), size))
        samples = _sampled(unit, parameters, found.recipe.shape(parameters, generator, drawn))
        if found.holds(parameters, samples).any():
            return True
    return False


@pytest.mark.parametrize("name", _arithmetic())
def test_every_recipe_reaches_its_bin(name: str) -> None:
    unit, coverage = _unit(name), coverage_of_name(name)
    generator = np.random.default_rng(SEED)
    excluded = {found.what for found in of_unit(design(name).exclusions, [n for n, _ in coverage.bins()])}
    missed = [
        bin_name
        for bin_name, found in coverage.bins()
        if bin_name not in excluded
        and not any(_reaches(unit, p, found, generator) for p in unit.parameter_sets().values())
    ]
    assert not missed


@pytest.mark.parametrize("name", _arithmetic())
def test_arithmetic_unit_has_points_that_hold_or_not_of_each_operand_in_every_parameter_set(
    name: str,
) -> None:
    unit, coverage = _unit(name), coverage_of_name(name)
    assert coverage.points
    for parameters in unit.parameter_sets().values():
        drawn = stream(np.random.default_rng(SEED), unit.inputs(parameters), 100)
        samples = _sampled(unit, parameters, drawn)
        for bin_name, found in coverage.bins():
            assert found.holds is not None
            held = found.holds(parameters, samples)
            assert (bin_name, held.shape, held.dtype) == (bin_name, (100,), np.dtype(bool))
