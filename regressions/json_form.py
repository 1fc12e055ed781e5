"""Frozen dataclasses as JSON and back, by their annotations alone.

Fields are texts, numbers, truths, members of a `StrEnum`, other dataclasses, tuples and mappings from texts
of these, and any of them or None. A record holds hundreds of thousands of points, so what an annotation asks
for is worked out once.
"""

import dataclasses
import json
import types
from collections.abc import Callable, Mapping
from enum import StrEnum
from functools import cache
from typing import Any, TypeVar, Union, get_args, get_origin, get_type_hints

_Form = TypeVar("_Form")

_Decoder = Callable[[Any], Any]


class FormError(ValueError):
    """JSON that is no such dataclass; the text names the field and what was expected."""


def dumps(value: Any, **first: Any) -> str:
    """A dataclass as JSON, with other fields before its own."""
    return json.dumps({**first, **vars(value)}, default=_plain, separators=(",", ":"))


def _plain(value: Any) -> Any:
    """What `json` cannot write by itself."""
    if isinstance(value, Mapping):
        return dict(value)
    if dataclasses.is_dataclass(value):
        return vars(value)
    raise TypeError(f"{value!r} has no form in JSON")


def decode(form: type[_Form], value: Any) -> _Form:
    """A dataclass from the JSON of `dumps`. Fields that have a default may be absent. Raises FormError."""
    decoder: _Decoder = _decoder(form)  # type: ignore[arg-type]  # a class is hashable
    found: _Form = _within("record", decoder, value)
    return found


def _within(place: str, decoder: _Decoder, value: Any) -> Any:
    """Decodes once more what did not decode, for the place of what is wrong: telling it always takes long."""
    try:
        return decoder(value)
    except FormError as error:
        raise FormError(f"{place}{'' if str(error).startswith(('[', ':')) else '.'}{error}") from None


@cache
def _decoder(form: Any) -> _Decoder:
    origin = get_origin(form)
    if origin in (Union, types.UnionType):
        return _optional(form)
    if origin is tuple:
        return _tuple(get_args(form))
    if origin is not None and issubclass(origin, Mapping):
        return _mapping(_decoder(get_args(form)[1]))
    if dataclasses.is_dataclass(form):
        return _dataclass(form)
    if isinstance(form, type) and issubclass(form, StrEnum):
        return _member(form)
    return _plain_value(form)


def _wrong(what: str) -> FormError:
    return FormError(f": is not {what}")


def _plain_value(form: type) -> _Decoder:
    def decoder(value: Any) -> Any:
        if type(value) is form:
            return value
        if form is float and type(value) is int:
            return float(value)
        raise _wrong(f"of type {form.__name__}")

    return decoder


def _member(form: type[StrEnum]) -> _Decoder:
    members = {str(member): member for member in form}

    def decoder(value: Any) -> Any:
        if not isinstance(value, str) or value not in members:
            raise _wrong(f"one of {', '.join(members)}")
        return members[value]

    return decoder


def _optional(form: Any) -> _Decoder:
    (inner,) = (_decoder(part) for part in get_args(form) if part is not types.NoneType)
    return lambda value: None if value is None else inner(value)


def _mapping(inner: _Decoder) -> _Decoder:
    def decoder(value: Any) -> Any:
        if not isinstance(value, dict):
            raise _wrong("an object")
        try:
            return {key: inner(item) for key, item in value.items()}
        except FormError:
            return {key: _within(key, inner, item) for key, item in value.items()}

    return decoder


def _tuple(parts: tuple[Any, ...]) -> _Decoder:
    endless = parts[1:] == (Ellipsis,)
    decoders = [_decoder(part) for part in parts if part is not Ellipsis]

    def decoder(value: Any) -> Any:
        if not isinstance(value, list):
            raise _wrong("a list")
        forms = decoders * len(value) if endless else decoders
        if len(forms) != len(value):
            raise _wrong(f"a list of {len(forms)}")
        pairs = list(zip(forms, value, strict=True))
        try:
            return tuple([inner(item) for inner, item in pairs])
        except FormError:
            return tuple(_within(f"[{at}]", inner, item) for at, (inner, item) in enumerate(pairs))

    return decoder


def _dataclass(form: Any) -> _Decoder:
    decoders = {name: _decoder(hint) for name, hint in get_type_hints(form).items()}
    absent = dataclasses.MISSING
    needed = {
        field.name
        for field in dataclasses.fields(form)
        if field.default is absent and field.default_factory is absent
    }

    def decoder(value: Any) -> Any:
        if not isinstance(value, dict):
            raise _wrong("an object")
        for name in sorted(needed - value.keys()):
            raise FormError(f"{name}: is missing")
        for name in sorted(value.keys() - decoders.keys()):
            raise FormError(f"{name}: is no field of {form.__name__}")
        try:
            return form(**{name: decoders[name](item) for name, item in value.items()})
        except FormError:
            return form(**{name: _within(name, decoders[name], item) for name, item in value.items()})

    return decoder
