"""What a property draws, as JSON that a person can read, and back.

Numbers, texts and lists stand for themselves; all else is an object of one key that says what it is:

    {"tuple": [...]}    {"set": [...]}    {"dict": {"name": ...}}    {"array": [...], "dtype": "uint8"}
    {"enum": "models.limits:Fault", "name": "RADIUS"}
    {"of": "models.scene.types:Camera", "position": ..., "up": ..., "center": ...}
"""

import dataclasses
import importlib
from collections.abc import Callable, Mapping
from enum import Enum
from typing import Any

import numpy as np

Json = Any
"""What `json.loads` gives."""

_OURS = ("models.", "verif.")
"""Where the classes of drawn values are; no others are made."""


class CodecError(ValueError):
    """A value that has no JSON, or JSON that is no value; the text is a sentence."""


def encode(value: Any) -> Json:
    """The JSON of a value. Raises CodecError where there is none."""
    if isinstance(value, Enum):
        return {"enum": _name(type(value)), "name": value.name}
    if value is None or isinstance(value, bool | int | float | str):
        return value
    if isinstance(value, np.bool_ | np.integer | np.floating):
        return value.item()
    if isinstance(value, np.ndarray):
        dtype = {} if value.dtype == np.int64 else {"dtype": str(value.dtype)}
        return {"array": value.tolist(), **dtype}
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        fields = [field.name for field in dataclasses.fields(value) if field.init]
        return {"of": _name(type(value)), **{name: encode(getattr(value, name)) for name in fields}}
    if isinstance(value, list):
        return [encode(item) for item in value]
    if isinstance(value, tuple):
        return {"tuple": [encode(item) for item in value]}
    if isinstance(value, frozenset):
        return {"set": sorted((encode(item) for item in value), key=str)}
    if isinstance(value, Mapping):
        return {"dict": {_key(key): encode(item) for key, item in value.items()}}
    raise CodecError(
        f"a {type(value).__name__} has no JSON: teach verif/env/codec.py, or draw something else"
    )


def decode(json: Json) -> Any:
    """The value that `encode` made JSON of. Raises CodecError where it is none."""
    if isinstance(json, list):
        return [decode(item) for item in json]
    if not isinstance(json, dict):
        return json
    for kind, read in _READERS.items():
        if kind in json:
            return read(json)
    raise CodecError(f"an object with the keys {', '.join(json)} is no value: one of {', '.join(_READERS)}")


def _array(json: Mapping[str, Json]) -> Any:
    return np.array(json["array"], dtype=json.get("dtype", "int64"))


def _enum(json: Mapping[str, Json]) -> Any:
    try:
        return _class(json["enum"])[json.get("name")]
    except (KeyError, TypeError):
        raise CodecError(f"{json['enum']} has no {json.get('name')}") from None


def _instance(json: Mapping[str, Json]) -> Any:
    values = {name: decode(value) for name, value in json.items() if name != "of"}
    try:
        return _class(json["of"])(**values)
    except (TypeError, ValueError) as error:
        raise CodecError(f"{json['of']} is not made of {', '.join(values)}: {error}") from None


_READERS: Mapping[str, Callable[[Mapping[str, Json]], Any]] = {
    "of": _instance,
    "enum": _enum,
    "array": _array,
    "tuple": lambda json: tuple(map(decode, json["tuple"])),
    "set": lambda json: frozenset(map(decode, json["set"])),
    "dict": lambda json: {key: decode(value) for key, value in json["dict"].items()},
}


def _key(key: Any) -> str:
    if not isinstance(key, str):
        raise CodecError(f"a dictionary with the key {key!r} has no JSON: only texts are keys")
    return key


def _name(of: type) -> str:
    return f"{of.__module__}:{of.__qualname__}"


def _class(name: str) -> Any:
    module, _, path = name.partition(":")
    if not module.startswith(_OURS):
        raise CodecError(f"{name} is no class of {' or '.join(_OURS)}")
    try:
        found = importlib.import_module(module)
        for part in path.split("."):
            found = getattr(found, part)
    except (ImportError, AttributeError):
        raise CodecError(f"there is no class {name}") from None
    return found
