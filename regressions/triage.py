"""Failures that say the same but for numbers are one: their buckets."""

import re
from collections.abc import Iterable

from regressions.record import Bucket, Result, Status

_PATH = re.compile(r"(?:[\w.~-]*/)+[\w.~-]+")
_BLOB = re.compile(r"b'[^']*'")
_NUMBER = re.compile(r"\b0x[0-9a-fA-FxXzZ]+\b|(?<!\w)[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?\b")
_SAME = re.compile(r"# \(# = #\)|#(?:,? #)+")
_MOST = 240


def normalised(message: str) -> str:
    """The message in one line without numbers, paths and the example; lists of numbers are one number."""
    head = re.split(r"\n(?:Failing test case|Falsifying example):|\n\n", message, maxsplit=1)[0]
    text = _NUMBER.sub("#", _BLOB.sub("#", _PATH.sub("<path>", head)))
    text = re.sub(r"\s+", " ", text).strip()
    while (fewer := _SAME.sub("#", text)) != text:
        text = fewer
    return text[:_MOST]


def buckets(results: Iterable[Result]) -> tuple[Bucket, ...]:
    """What failed, was stopped or killed, or could not be built, the most frequent first."""
    found: dict[str, list[Result]] = {}
    for result in results:
        if result.status is not Status.PASSED:
            found.setdefault(normalised(result.message), []).append(result)
    return tuple(
        Bucket(message, shown[0].message, tuple(result.id for result in shown), shown[0].command)
        for message, shown in sorted(found.items(), key=lambda item: -len(item[1]))
    )
