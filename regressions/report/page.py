"""The page as one file: template, style, script and data put together, with nothing left to be fetched."""

import base64
import hashlib
import html
import json
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from regressions.record import Record
from regressions.report.data import sections
from regressions.report.texts import texts

PAGE = "report.html"
"""The file, beside the record."""

ASSETS = Path(__file__).with_name("assets")

_SCRIPTS = (
    *("dom", "data", "route", "table", "chart", "summary", "plan"),
    *("functional", "closure", "code", "words", "source", "mutation", "tests", "main"),
)
"""One script in the end, in this order."""


def page(record: Record) -> str:
    """The HTML of a record, with the sources of its revision."""
    style = (ASSETS / "page.css").read_text()
    script = "\n".join((ASSETS / f"{name}.js").read_text() for name in _SCRIPTS)
    parts = {
        "policy": _policy(style, script),
        "title": html.escape(f"{record.list} {record.id}"),
        "style": style,
        "script": script,
        "data": _data(sections(record, texts(record))),
    }
    return re.sub(r"\{\{(\w+)\}\}", lambda found: parts[found[1]], (ASSETS / "page.html").read_text())


def _policy(style: str, script: str) -> str:
    """What browsers may do with the page: this style and this script, and no request at all."""
    return (
        f"default-src 'none'; img-src data:; style-src 'sha256-{_digest(style)}'; "
        f"script-src 'sha256-{_digest(script)}'"
    )


def _digest(text: str) -> str:
    return base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()


def _data(found: Mapping[str, Any]) -> str:
    return "\n".join(
        f'<script type="application/json" id="data-{name}">{_json(value)}</script>'
        for name, value in found.items()
    )


def _json(value: object) -> str:
    """JSON in which no text can end the element it is in."""
    return json.dumps(value, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")
