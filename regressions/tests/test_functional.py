"""What a record says of functional coverage."""

from dataclasses import replace
from pathlib import Path

from regressions.record import Bin
from regressions.sections.functional import unit
from verif.coverage import designs


def _bins(hits: dict[str, dict[str, int]], exclusions: Path) -> tuple[dict[str, Bin], list[str]]:
    """Of the control, by name, and the notes."""
    found, notes = unit(replace(designs.find("control"), exclusions=exclusions), hits)
    return {f"{point.name}.{one.name}": one for point in found.points for one in point.bins}, notes


def test_an_excluded_bin_that_was_hit_counts_as_hit_and_is_told(tmp_path: Path) -> None:
    names = list(_bins({}, tmp_path / "none.toml")[0])[:2]
    owned = 'reason = "r"\nowner = "o"\nreview = 9999-01-01\n'
    entries = (f'[[exclude]]\nbin = "{name}"\n{owned}' for name in names)
    exclusions = tmp_path / "exclusions.toml"
    exclusions.write_text("\n".join(entries))
    bins, notes = _bins({names[0]: {"run": 3}}, exclusions)
    assert (bins[names[0]].hits, bins[names[0]].excluded) == (3, "")
    assert (bins[names[1]].hits, bins[names[1]].excluded) == (0, "r")
    assert notes == [f"control: {names[0]} was hit; take it out of its exclusions.toml"]
