"""Frozen dataclasses as JSON and back, by their annotations alone.

Fields are texts, numbers, truths, members of a `StrEnum`, other dataclasses, tuples and mappings from texts
of these, and any of them or None.
"""

import dataclasses
import types
from collections.abc import Mapping
from enum import StrEnum
from typing import Any, TypeVar, Union, get_args, get_origin, get_type_hints

_Form = TypeVar("_Form")


class FormError(ValueError):
    """JSON that is no such dataclass; the text names the field and what was expected."""


def encode(value: Any) -> Any:
    """The value as what `json.dumps` takes."""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return {field.name: encode(getattr(value, field.name)) for field in dataclasses.fields(value)}
    if isinstance(value, StrEnum):
        return str(value)
    if isinstance(value, Mapping):
        return {key: encode(item) for key, item in value.items()}
    if isinstance(value, tuple):
        return [encode(item) for item in value]
    return value


def decode(form: type[_Form], value: Any, at: str = "record") -> _Form:
    """A dataclass from what `encode` made of it.

    Fields that have a default may be absent. Raises FormError.
    """
    found: _Form = _decode(form, value, at)
    return found


def _decode(form: Any, value: Any, at: str) -> Any:
    origin = get_origin(form)
    if origin in (Union, types.UnionType):
        return _optional(form, value, at)
    if origin is tuple:
        return _tuple(get_args(form), value, at)
    if origin is not None and issubclass(origin, Mapping):
        _need(isinstance(value, dict), at, "an object")
        return {key: _decode(get_args(form)[1], item, f"{at}.{key}") for key, item in value.items()}
    if dataclasses.is_dataclass(form):
        return _dataclass(form, value, at)
    if isinstance(form, type) and issubclass(form, StrEnum):
        _need(value in list(form), at, f"one of {', '.join(form)}")
        return form(value)
    if form is float and type(value) is int:
        return float(value)
    _need(type(value) is form, at, f"of type {form.__name__}")
    return value


def _need(holds: bool, at: str, what: str) -> None:
    if not holds:
        raise FormError(f"{at}: is not {what}")


def _optional(form: Any, value: Any, at: str) -> Any:
    (inner,) = (part for part in get_args(form) if part is not types.NoneType)
    return None if value is None else _decode(inner, value, at)


def _tuple(parts: tuple[Any, ...], value: Any, at: str) -> tuple[Any, ...]:
    _need(isinstance(value, list), at, "a list")
    forms = parts[:1] * len(value) if parts[1:] == (Ellipsis,) else parts
    _need(len(forms) == len(value), at, f"a list of {len(forms)}")
    pairs = zip(forms, value, strict=True)
    return tuple(_decode(part, item, f"{at}[{number}]") for number, (part, item) in enumerate(pairs))


def _dataclass(form: Any, value: Any, at: str) -> Any:
    _need(isinstance(value, dict), at, "an object")
    hints = get_type_hints(form)
    absent = dataclasses.MISSING
    needed = {
        field.name
        for field in dataclasses.fields(form)
        if field.default is absent and field.default_factory is absent
    }
    for name in sorted(needed - value.keys()):
        raise FormError(f"{at}.{name}: is missing")
    for name in sorted(value.keys() - hints.keys()):
        raise FormError(f"{at}.{name}: is no field of {form.__name__}")
    return form(**{name: _decode(hints[name], item, f"{at}.{name}") for name, item in value.items()})
