"""Every value of a TOML text is found on the line where it stands."""

import tomllib
from collections.abc import Iterator

from hypothesis import given
from hypothesis import strategies as st

from models.scene.toml_lines import Key, LineIndex

TEXT = """\
a = 101 # ] = [
"b.c" = "102 \\" # ' \\\\"
'd' . e = '103 " \\'
f . g.h = [ 104, # ]
  105, [106,
   107] ,
]
i = { j = 108, k.l = [109, {m = 110}], n = '}' }
o = \"\"\"
x = 1
[[nothing]]
111 \\\"\"\" \"\"\"\"\"
p = '''
# y = 2
112 '' '''''
q = 1979-05-27T07:32:00Z
[table]
r = 113
[ table . "sub table" ] # [
s = 114
[[many]]
t = 115
[[many.few]]
u = 116
[[many.few]]
u = 117
[many.few.one]
v = [[118, 0.5],
[119, 0.5]]
[[many]]
t = 120
[[many.few]]
u = 121
[other]
[other.w]
x = 122"""


def leaves(value: object, key: Key = ()) -> Iterator[tuple[Key, object]]:
    if isinstance(value, dict):
        for name, item in value.items():
            yield from leaves(item, (*key, name))
    elif isinstance(value, list):
        for position, item in enumerate(value):
            yield from leaves(item, (*key, position))
    else:
        yield key, value


def line_of(text: str, marker: str) -> int:
    return next(number for number, line in enumerate(text.split("\n"), 1) if marker in line)


def assert_all_found(text: str) -> None:
    index = LineIndex(text)
    markers = 0
    for key, value in leaves(tomllib.loads(text)):
        if isinstance(value, int):
            markers += 1
            assert index.line(key) == line_of(text, str(value)), key
    assert markers >= 18


def test_values_of_all_kinds_are_found() -> None:
    assert_all_found(TEXT)
    assert_all_found(TEXT + "\n")


def test_texts_are_found_where_they_begin() -> None:
    index = LineIndex(TEXT)
    assert index.line(("o",)) == line_of(TEXT, 'o = """')
    assert index.line(("p",)) == line_of(TEXT, "p = '''")
    assert index.line(("b.c",)) == 2
    assert index.line(("d", "e")) == 3


def test_tables_are_found_at_their_headers() -> None:
    index = LineIndex(TEXT)
    assert index.line(("table", "sub table")) == line_of(TEXT, "[ table")
    assert index.line(("many", 1)) == line_of(TEXT, "t = 120") - 1
    assert index.line(("many",)) == line_of(TEXT, "t = 115") - 1
    assert index.line(("many", 0, "few", 1)) == line_of(TEXT, "u = 117") - 1


def test_what_is_missing_is_found_at_the_table_that_misses_it() -> None:
    index = LineIndex(TEXT)
    assert index.line(("many", 1, "few", 0, "colour", 3)) == line_of(TEXT, "u = 121") - 1
    assert index.line(("nothing",)) is None
    assert LineIndex("").line(("a", 0)) is None


@given(st.lists(st.tuples(st.integers(0, 9), st.sampled_from(["", "# [x]", "  ", "\t# '"])), max_size=12))
def test_blank_lines_and_comments_shift_the_lines_after_them(extra: list[tuple[int, str]]) -> None:
    lines = TEXT.split("\n")
    # Not inside the two multi-line texts: there a comment is text.
    places = [0, 1, 2, 3, 8, 16, 17, 20, 26, len(lines)]
    for place, line in sorted(extra, reverse=True):
        lines.insert(places[place], line)
    assert_all_found("\n".join(lines))
