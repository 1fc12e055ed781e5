"""The corpus: drawn values can be written, every entry is of use, and replayed before anything is drawn."""

import importlib
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from models.cores import CORES
from models.limits import Fault
from models.scene.strategies import whole_scenes
from verif.core.strategies import Shot, shots
from verif.env import breaks, codec, corpus, sources, units
from verif.env.corpus import CorpusError, Entry
from verif.env.simulators import Simulator
from verif.env.unit import Break

_LEAVES = (
    st.none()
    | st.booleans()
    | st.integers()
    | st.floats(allow_nan=False)
    | st.text()
    | st.sampled_from(Fault)
)
_VALUES = st.recursive(
    _LEAVES,
    lambda inner: (
        st.lists(inner, max_size=3)
        | st.lists(inner, max_size=3).map(tuple)
        | st.dictionaries(st.text(), inner, max_size=3)
        | st.frozensets(st.integers(), max_size=3)
    ),
    max_leaves=12,
)
_ARRAYS = arrays.arrays(
    st.sampled_from((np.int64, np.uint8, np.bool_)), arrays.array_shapes(max_dims=2, max_side=4)
)


def _written(value: Any) -> Any:
    """A value that has been to a file and back."""
    return codec.decode(json.loads(json.dumps(codec.encode(value))))


@given(_VALUES)
def test_values_come_back_as_they_were(value: Any) -> None:
    """With their types: a tuple is no list."""
    back = _written(value)
    assert back == value
    assert json.dumps(codec.encode(back)) == json.dumps(codec.encode(value))


@given(_ARRAYS)
def test_arrays_come_back_with_their_type_and_shape(value: Any) -> None:
    """Nothing is widened."""
    back = _written(value)
    assert (back.dtype, back.shape) == (value.dtype, value.shape)
    assert (back == value).all()


@given(shots(CORES["default"].formats, 48, whole_scenes()))
def test_pictures_of_whole_scenes_come_back_equal(shot: Shot) -> None:
    """Frozen dataclasses of dataclasses, as the core's properties draw them."""
    assert _written(shot) == shot


@pytest.mark.parametrize(
    "value", [object(), {1: 2}, {1, 2}], ids=["no known type", "numbers as keys", "a set that changes"]
)
def test_what_has_no_json_is_refused_with_a_sentence(value: Any) -> None:
    """And so is never written half."""
    with pytest.raises(codec.CodecError, match="has no JSON"):
        codec.encode(value)


_BROKEN = {
    "no such class": '{"of": "verif.core.strategies:Nobody", "x": 1}',
    "fields of another time": '{"of": "models.scene.types:Camera", "place": 1}',
    "a class of strangers": '{"of": "subprocess:Popen", "args": "true"}',
    "no such member": '{"enum": "models.limits:Fault", "name": "HUNGER"}',
    "no known kind": '{"scene": "glass"}',
}


@pytest.mark.parametrize("value", _BROKEN.values(), ids=_BROKEN)
def test_an_entry_that_no_longer_decodes_is_an_error_that_names_its_file(value: str, tmp_path: Path) -> None:
    """Whatever became of the class that it needs."""
    path = tmp_path / "old.json"
    path.write_text(f'{{"property": "p", "set": "default", "why": "w", "values": [{value}]}}')
    with pytest.raises(CorpusError, match=r"old\.json: .*; mend the file, or delete it"):
        corpus.select(tmp_path, "p", "default")


def test_an_entry_without_a_reason_is_an_error(tmp_path: Path) -> None:
    """Nobody keeps what nobody can explain."""
    (tmp_path / "mute.json").write_text('{"property": "p", "set": "default", "values": []}')
    with pytest.raises(CorpusError, match=r"mute\.json: no why"):
        corpus.select(tmp_path, "p", "default")


def test_an_entry_of_no_property_or_no_set_is_an_error(tmp_path: Path) -> None:
    """A test that was renamed does not lose its examples in silence."""
    corpus.keep(Entry("an_old_name", "default", (1,), "why"), tmp_path)
    with pytest.raises(CorpusError, match="no property an_old_name"):
        corpus.check(tmp_path, ["a_new_name"], ["default"])
    with pytest.raises(CorpusError, match="no set default, only narrow"):
        corpus.check(tmp_path, ["an_old_name"], ["narrow"])


_BENCHES = tuple(sorted(path.parent for path in sources.VERIF.rglob(corpus.NAME) if any(path.glob("*.json"))))


def _tests(folder: Path) -> list[str]:
    """Names of the tests, and all else, in the modules of a folder."""
    modules = [".".join(path.relative_to(sources.ROOT).with_suffix("").parts) for path in folder.glob("*.py")]
    return [name for module in modules for name in vars(importlib.import_module(module))]


@pytest.mark.parametrize("folder", _BENCHES, ids=lambda path: path.name)
def test_every_entry_is_of_a_property_and_a_set_that_there_is(folder: Path) -> None:
    """And decodes."""
    sets = units.find(folder.name).parameter_sets() if folder.parent.name == "units" else CORES
    corpus.check(folder / corpus.NAME, _tests(folder), list(sets))


_CHANGE = Break("arith/mul.v", "g_piece[k-1].total + term", "g_piece[k-1].total - term")
_PROPERTY = "every_operand_drawn_gives_the_models_result"


def test_the_corpus_is_replayed_before_anything_is_drawn() -> None:
    """One example is drawn, the simplest there is, and it notices nothing; an entry does."""
    outcome = units.simulate(
        "mul",
        Simulator.VERILATOR,
        "default",
        seed=1,
        effort=units.Effort(examples=1, operands=16),
        replacements=breaks.changed(_CHANGE),
        run_name="corpus-mul",
    )
    text = outcome.tests[_PROPERTY] or ""
    assert "replayed from" in text and "verif/units/mul/corpus/" in text
