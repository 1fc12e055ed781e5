"""Cover points that most units share: classes of an operand, signs of a pair, limits of a result.

A point over a port with several lanes is hit where any lane is in the class. Ports come from the unit's
own description, so that the classes follow its parameters.
"""

from collections.abc import Callable, Mapping, Sequence

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from models.fixed import Raw
from verif.env.coverage.points import Bin, Holds, Point, Recipe, Samples, Shape
from verif.env.fields import Field, Operands
from verif.env.unit import Parameters

Ports = Callable[[Parameters], Sequence[Field]]
"""A unit's `inputs` or `outputs`."""

Matches = Callable[[Field, Raw], NDArray[np.bool_]]
Values = Callable[[Field, Generator, int], Raw]


def port(ports: Ports, parameters: Parameters, name: str) -> Field:
    """A port by name. Raises KeyError where the unit has none of this name."""
    for field in ports(parameters):
        if field.name == name:
            return field
    raise KeyError(f"no port is called {name}")


def any_lane(found: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Per column: in any lane."""
    return np.asarray(found.reshape(-1, found.shape[-1]).any(axis=0))


def all_lanes(found: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Per column: in all lanes."""
    return np.asarray(found.reshape(-1, found.shape[-1]).all(axis=0))


def before(values: Raw, clocks: int = 1) -> Raw:
    """A block's signal so many clocks ago; -1 where that was not sampled."""
    earlier = np.full_like(values, -1)
    earlier[..., clocks:] = values[..., :-clocks]
    return earlier


def scenario(name: str) -> Recipe:
    """A recipe that the bench plays, by name."""
    return Recipe(name)


def told(name: str, doc: str, recipes: Mapping[str, str]) -> Point:
    """A point whose bins the bench tells of; recipes: the scenario that reaches each bin."""
    return Point(name, doc, tuple(Bin(found, Recipe(played)) for found, played in recipes.items()))


def put(ports: Ports, name: str, values: Values) -> Shape:
    """Operands with one lane of a port, a drawn one each, replaced."""

    def shape(parameters: Parameters, generator: Generator, operands: Operands) -> Operands:
        field = port(ports, parameters, name)
        changed = operands[name].copy()
        size = changed.shape[-1]
        wanted = values(field, generator, size)
        if field.lanes == 1:
            return {**operands, name: wanted}
        changed[generator.integers(0, field.lanes, size), np.arange(size)] = wanted
        return {**operands, name: changed}

    return shape


def put_all(ports: Ports, name: str, values: Values) -> Shape:
    """Operands with every lane of a port replaced."""

    def shape(parameters: Parameters, generator: Generator, operands: Operands) -> Operands:
        field = port(ports, parameters, name)
        lanes = [values(field, generator, operands[name].shape[-1]) for _ in range(field.lanes)]
        return {**operands, name: np.stack(lanes) if field.lanes > 1 else lanes[0]}

    return shape


def _constant(value: Callable[[Field], int]) -> tuple[Matches, Values]:
    def matches(field: Field, values: Raw) -> NDArray[np.bool_]:
        return np.asarray(values == value(field))

    def draw(field: Field, _generator: Generator, size: int) -> Raw:
        return np.full(size, value(field), dtype=np.int64)

    return matches, draw


def _is_power(values: Raw) -> NDArray[np.bool_]:
    return np.asarray((values > 1) & (values & (values - 1) == 0))


def _positive_between(field: Field, values: Raw) -> NDArray[np.bool_]:
    return np.asarray(~_is_power(values) & (values > 1) & (values < field.high - 1))


def _negative_between(field: Field, values: Raw) -> NDArray[np.bool_]:
    return np.asarray(~_is_power(-values) & (values < -1) & (values > field.low + 1))


def _powers(field: Field, generator: Generator, size: int) -> Raw:
    exponents = generator.integers(1, max(2, field.high.bit_length()), size)
    return np.asarray(np.minimum(np.int64(1) << exponents, field.high), dtype=np.int64)


def _others(field: Field, generator: Generator, size: int) -> Raw:
    return generator.integers(field.low, field.high, size, dtype=np.int64, endpoint=True)


def _classes(signed: bool) -> dict[str, tuple[Matches, Values]]:
    found = {
        "zero": _constant(lambda _: 0),
        "one": _constant(lambda _: 1),
        "highest": _constant(lambda field: field.high),
        "just_below_highest": _constant(lambda field: field.high - 1),
        "power_of_two": (lambda _, values: _is_power(values), _powers),
    }
    if not signed:
        return {**found, "any_other": (_positive_between, _others)}
    return {
        **found,
        "minus_one": _constant(lambda _: -1),
        "lowest": _constant(lambda field: field.low),
        "just_above_lowest": _constant(lambda field: field.low + 1),
        "minus_power_of_two": (
            lambda field, values: _is_power(-values) & (values != field.low),
            lambda field, generator, size: -np.minimum(_powers(field, generator, size), field.high // 2 + 1),
        ),
        "other_positive": (_positive_between, _positive),
        "other_negative": (_negative_between, _negative),
    }


def _positive(field: Field, generator: Generator, size: int) -> Raw:
    return generator.integers(1, field.high, size, dtype=np.int64, endpoint=True)


def _negative(field: Field, generator: Generator, size: int) -> Raw:
    return generator.integers(field.low, -1, size, dtype=np.int64, endpoint=True)


def _in_class(ports: Ports, name: str, matches: Matches) -> Holds:
    def holds(parameters: Parameters, samples: Samples) -> NDArray[np.bool_]:
        return any_lane(matches(port(ports, parameters, name), samples[name]))

    return holds


def operand(ports: Ports, name: str, *, signed: bool = True, leave_out: Sequence[str] = ()) -> Point:
    """Zero, one, the extremes and their neighbours, powers of two of both signs, and all between."""
    bins = [
        Bin(found, Recipe(f"{name} {found}", put(ports, name, values)), _in_class(ports, name, matches))
        for found, (matches, values) in _classes(signed).items()
        if found not in leave_out
    ]
    return Point(name, f"classes of {name}", tuple(bins))


_SIGNS: Mapping[str, tuple[Matches, Values]] = {
    "negative": (lambda _, values: values < 0, _negative),
    "zero": _constant(lambda _: 0),
    "positive": (lambda _, values: values > 0, _positive),
}


def sign(ports: Ports, name: str, lane: int | None = None) -> Point:
    """Negative, zero, positive: of all lanes alike, or of one. For crosses."""
    label = name if lane is None else f"{name}_{lane}"
    bins = []
    for found, (matches, values) in _SIGNS.items():
        shape = put_all(ports, name, values) if lane is None else _put_lane(ports, name, lane, values)
        bins.append(Bin(found, Recipe(f"{label} {found}", shape), _all_in(ports, name, lane, matches)))
    return Point(f"sign_of_{label}", f"sign of {label}", tuple(bins))


def _put_lane(ports: Ports, name: str, lane: int, values: Values) -> Shape:
    def shape(parameters: Parameters, generator: Generator, operands: Operands) -> Operands:
        changed = operands[name].copy()
        changed[lane] = values(port(ports, parameters, name), generator, changed.shape[-1])
        return {**operands, name: changed}

    return shape


def _all_in(ports: Ports, name: str, lane: int | None, matches: Matches) -> Holds:
    def holds(parameters: Parameters, samples: Samples) -> NDArray[np.bool_]:
        values = samples[name].reshape(-1, samples[name].shape[-1])
        chosen = values if lane is None else values[lane : lane + 1]
        return np.asarray(matches(port(ports, parameters, name), chosen).all(axis=0))

    return holds


def result(ports: Ports, name: str, recipes: Mapping[str, Recipe]) -> Point:
    """Where a result lies: lowest, just_above_lowest, negative, zero, positive, just_below_highest, highest.

    recipes: the bins that there are, with what reaches each; `highest` and `lowest` are where a
    saturated result is, the neighbours where it is just not.
    """
    bins = tuple(
        Bin(found, recipe, _in_class(ports, name, _RESULTS[found])) for found, recipe in recipes.items()
    )
    return Point(name, f"where {name} lies", bins)


_RESULTS: Mapping[str, Matches] = {
    "lowest": lambda field, values: values == field.low,
    "just_above_lowest": lambda field, values: values == field.low + 1,
    "negative": lambda field, values: (values < 0) & (values > field.low),
    "zero": lambda _, values: values == 0,
    "positive": lambda field, values: (values > 0) & (values < field.high),
    "just_below_highest": lambda field, values: values == field.high - 1,
    "highest": lambda field, values: values == field.high,
}


def flag(name: str, recipes: Mapping[str, Recipe]) -> Point:
    """A port of one bit; recipes: of the bins `high` and `low`."""
    values = {"low": 0, "high": 1}
    bins = tuple(Bin(found, recipe, _equals(name, values[found])) for found, recipe in recipes.items())
    return Point(name, f"value of {name}", bins)


def _equals(name: str, value: int) -> Holds:
    def holds(_parameters: Parameters, samples: Samples) -> NDArray[np.bool_]:
        return any_lane(samples[name] == value)

    return holds


def values(name: str, doc: str, wanted: Mapping[str, tuple[int, Recipe]], point: str = "") -> Point:
    """Values of a narrow port or signal, each by a name, such as the states of a state machine."""
    bins = tuple(Bin(found, recipe, _equals(name, value)) for found, (value, recipe) in wanted.items())
    return Point(point or name, doc, bins)
