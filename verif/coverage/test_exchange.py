"""cocotb-coverage's files say what was hit, as often as it was."""

import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import pytest

from verif.env import sources

_EXPORT = """
import sys
from pathlib import Path
from verif.coverage.exchange import export
export([("sqrt", {"remainder.zero": 7, "remainder.one": 0}), ("fifo", {"level.full": 1})], Path(sys.argv[1]))
"""


def _exported(path: Path) -> Path:
    """In a process of its own: the database of cocotb-coverage is global."""
    subprocess.run([sys.executable, "-c", _EXPORT, str(path)], check=True, cwd=sources.ROOT)
    return path


def test_every_bin_is_in_the_xml_with_its_hits(tmp_path: Path) -> None:
    root = ElementTree.parse(_exported(tmp_path / "coverage.xml")).getroot()
    found = {(bin_.get("bin"), bin_.get("hits")) for bin_ in root.iter() if bin_.get("bin")}
    assert found == {("zero", "7"), ("one", "0"), ("full", "1")}
    assert (root.get("size"), root.get("coverage")) == ("3", "2")


@pytest.mark.parametrize("name", ["coverage.yml", "coverage.yaml"])
def test_the_name_chooses_yaml(name: str, tmp_path: Path) -> None:
    text = _exported(tmp_path / name).read_text()
    assert "top.sqrt.remainder:" in text and "zero: 7" in text
