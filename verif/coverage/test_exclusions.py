"""Tests of exclusions of bins: what they must say, and that a stale one is an error."""

from datetime import date
from pathlib import Path

import pytest

from verif.coverage.exclusions import Exclusion, ExclusionError, of_unit

TODAY = date(2030, 1, 1)
BINS = ("state.idle", "state.unused")
GOOD = {
    "bin": '"state.unused"',
    "reason": '"the encoding has ten states"',
    "owner": '"verification"',
    "review": "2031-06-01",
}


def _file(folder: Path, **fields: str) -> Path:
    """An exclusion with these fields changed, or left out where they are empty."""
    lines = [f"{name} = {value}" for name, value in {**GOOD, **fields}.items() if value]
    path = folder / "exclusions.toml"
    path.write_text("\n".join(["[[exclude]]", *lines]))
    return path


def test_without_a_file_nothing_is_left_out(tmp_path: Path) -> None:
    assert of_unit(tmp_path / "exclusions.toml", BINS, TODAY) == ()


def test_an_exclusion_is_read(tmp_path: Path) -> None:
    found = of_unit(_file(tmp_path, proof='"control.no_state_is_illegal"'), BINS, TODAY)
    reason, owner = "the encoding has ten states", "verification"
    review, proof = date(2031, 6, 1), "control.no_state_is_illegal"
    assert found == (Exclusion("state.unused", reason, owner, review, proof),)


@pytest.mark.parametrize(
    ("fields", "sentence"),
    [
        ({"bin": ""}, "bin is missing"),
        ({"reason": '""'}, "reason is missing"),
        ({"owner": ""}, "owner is missing"),
        ({"review": '"soon"'}, "review is missing"),
        ({"because": '"so"'}, "because means nothing here"),
        ({"bin": '"state.gone"'}, "no bin is called state.gone"),
        ({"review": "2029-12-31"}, "review was due on 2029-12-31"),
        ({"bin": "]"}, "is no TOML"),
    ],
)
def test_a_wrong_or_stale_exclusion_is_refused_with_its_file(
    tmp_path: Path, fields: dict[str, str], sentence: str
) -> None:
    with pytest.raises(ExclusionError, match=rf"exclusions\.toml.*{sentence}"):
        of_unit(_file(tmp_path, **fields), BINS, TODAY)
