"""Where the values of a TOML text stand: `tomllib` gives values without lines, messages need them.

The text must be one that `tomllib` accepts; the scanner relies on it and checks nothing.
"""

import tomllib

Key = tuple[str | int, ...]
"""Path of a value: names of tables and keys, positions in arrays."""

_QUOTES = ('"""', "'''", '"', "'")


class LineIndex:
    """Lines of all tables, keys and array elements of a text."""

    def __init__(self, text: str) -> None:
        """Scan a text that `tomllib` accepts."""
        self._lines = _Scanner(text).scan()

    def line(self, key: Key) -> int | None:
        """Line of a value, or of the nearest table or array around it; None for the file as a whole."""
        while key:
            if key in self._lines:
                return self._lines[key]
            key = key[:-1]
        return None


class _Scanner:
    def __init__(self, text: str) -> None:
        self._text = text
        self._at = 0
        self._line = 1
        self._lines: dict[Key, int] = {}
        self._counts: dict[Key, int] = {}

    def scan(self) -> dict[Key, int]:
        table: Key = ()
        self._skip_blank()
        while self._at < len(self._text):
            if self._text[self._at] == "[":
                table = self._header()
            else:
                self._pair(table)
            self._skip_blank()
        return self._lines

    def _advance(self, count: int) -> str:
        taken = self._text[self._at : self._at + count]
        self._line += taken.count("\n")
        self._at += len(taken)
        return taken

    def _skip_blank(self, more: str = "") -> None:
        """Skip white space, comments and the characters of `more`."""
        while self._at < len(self._text):
            if self._text[self._at] == "#":
                end = self._text.find("\n", self._at)
                self._advance((len(self._text) if end < 0 else end) - self._at)
            elif self._text[self._at] in " \t\r\n" + more:
                self._advance(1)
            else:
                return

    def _header(self) -> Key:
        line, many = self._line, self._text.startswith("[[", self._at)
        self._advance(2 if many else 1)
        names = self._names("]")
        self._advance(2 if many else 1)
        table: Key = ()
        for name in names[:-1]:
            table = self._latest((*table, name))
        table = (*table, names[-1])
        self._lines.setdefault(table, line)
        if many:
            self._counts[table] = self._counts.get(table, 0) + 1
            table = self._latest(table)
            self._lines[table] = line
        return table

    def _latest(self, table: Key) -> Key:
        """The last element where the path is an array of tables."""
        return (*table, self._counts[table] - 1) if table in self._counts else table

    def _names(self, end: str) -> list[str]:
        """The parts of a dotted key up to, not including, the character `end`."""
        names: list[str] = []
        while True:
            self._skip_blank(".")
            if self._text[self._at] == end:
                return names
            if self._text[self._at] in "\"'":
                names.append(tomllib.loads(f"key = {self._string()}")["key"])
            else:
                start = self._at
                while self._text[self._at] not in f" \t.{end}":
                    self._advance(1)
                names.append(self._text[start : self._at])

    def _pair(self, table: Key) -> None:
        line = self._line
        key = table
        for name in self._names("="):
            key = (*key, name)
            self._lines.setdefault(key, line)
        self._advance(1)
        self._skip_blank()
        self._value(key)

    def _value(self, key: Key) -> None:
        first = self._text[self._at]
        if first in "\"'":
            self._string()
        elif first == "[":
            self._array(key)
        elif first == "{":
            self._inline_table(key)
        else:
            while self._at < len(self._text) and self._text[self._at] not in ",]}#\n":
                self._advance(1)

    def _string(self) -> str:
        """Skip a string of any of the four kinds and return it with its quotes."""
        start = self._at
        quote = next(quote for quote in _QUOTES if self._text.startswith(quote, start))
        self._advance(len(quote))
        while not self._text.startswith(quote, self._at):
            escaped = quote[0] == '"' and self._text[self._at] == "\\"
            self._advance(2 if escaped else 1)
        self._advance(len(quote))
        # Up to two quotes more belong to a multi-line string that ends in quotes.
        while len(quote) > 1 and self._text.startswith(quote[0], self._at):
            self._advance(1)
        return self._text[start : self._at]

    def _array(self, key: Key) -> None:
        self._advance(1)
        position = 0
        self._skip_blank(",")
        while self._text[self._at] != "]":
            self._lines[(*key, position)] = self._line
            self._value((*key, position))
            position += 1
            self._skip_blank(",")
        self._advance(1)

    def _inline_table(self, key: Key) -> None:
        self._advance(1)
        self._skip_blank(",")
        while self._text[self._at] != "}":
            self._pair(key)
            self._skip_blank(",")
        self._advance(1)
