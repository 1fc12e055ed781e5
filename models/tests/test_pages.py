"""What is generated or drawn from the tables and models, and checked in, is fresh."""

from pathlib import Path

import numpy as np
import pytest

from models import header, stages
from models.core import registers, render
from models.fixed import Format
from models.formats import BUILDS, formats
from models.images import load_png
from models.scene.load import load

_ROOT = Path(__file__).parents[2]
_SCENES = _ROOT / "models" / "scenes"
_PICTURES = [
    path
    for path in sorted((_ROOT / "hdl" / "pictures").glob("*.png"))
    if (_SCENES / f"{path.stem}.toml").exists()
]


def test_the_header_is_what_the_tables_say() -> None:
    assert header.HEADER.read_text() == header.text()


def test_the_page_of_the_core_has_the_tables_as_they_are() -> None:
    page = stages.PAGE.read_text()
    assert stages.refreshed(page) == page


def test_a_page_without_a_marker_is_an_error() -> None:
    with pytest.raises(ValueError, match="has no <!-- stages -->"):
        stages.refreshed("nothing")


@pytest.mark.parametrize("picture", _PICTURES, ids=lambda path: path.stem)
def test_the_pictures_of_the_readme_are_what_the_core_draws(picture: Path) -> None:
    file = load(_SCENES / f"{picture.stem}.toml")
    fmts = formats(BUILDS["default"])
    shown = load_png(picture)
    height, width, _ = shown.shape
    drawn = render(file.scene, registers(file.view_for(width, height), fmts), fmts)
    assert np.array_equal(shown, drawn.rgb)


@pytest.mark.parametrize(
    ("a", "b", "expected"),
    [((2, 16), (2, 16), 1), ((9, 10), (9, 10), 1), ((10, 15), (2, 16), 2), ((10, 15), (10, 15), 4)],
)
def test_multipliers_are_counted_in_pieces(a: tuple[int, int], b: tuple[int, int], expected: int) -> None:
    assert stages.multipliers(Format(*a), Format(*b)) == expected
