"""Where every key and value of a TOML text stands: what `tomllib` knows and does not tell.

The text must be one that `tomllib` accepts; nothing is checked again here. Offsets are indices into the text with
line feeds as line ends. Source: TOML v1.0.0, sections "Keys", "String", "Array", "Inline Table", "Array of Tables".
"""

import re
from bisect import bisect_right
from collections.abc import Callable
from dataclasses import dataclass, field

KeyPath = tuple[str | int, ...]
"""The keys that lead to a value, with the index (from 0) after the key of an array."""

_BLANK = re.compile(r"(?:[ \t\n]|#[^\n]*)*")
_BARE_KEY = re.compile(r"[A-Za-z0-9_-]+")
_BARE_VALUE = re.compile(r"[^,\]}\n#]+")
_BARE_LIST = re.compile(r"""\[[^\]\["'{}#]*\]""")
"""A list of nothing but numbers, dates and truths, which may be hundreds of thousands: told apart at once."""
_BARE_ENTRY = re.compile(r"[^,\s](?:[^,\n]*[^,\s])?")
_FOLD = re.compile(r"\\[ \t]*\n[ \t\n]*")
_PLAIN_STRING = re.compile(r""""[^"\\\n]+"|'[^'\n]+'""")
"""A string in one row without an escape, as nearly all are: where its letters are is said at once."""
_ESCAPE = re.compile(r"\\(?:u[0-9A-Fa-f]{4}|U[0-9A-Fa-f]{8}|.)", re.DOTALL)


@dataclass(slots=True)
class Places:
    """The offset of each key and value by key path; of a string also the offset of each of its characters.

    `ends` holds the offset just past each value, `headers` those of the `[table]` headers in the order of the text.
    """

    text: str
    keys: dict[KeyPath, int] = field(default_factory=dict)
    values: dict[KeyPath, int] = field(default_factory=dict)
    ends: dict[KeyPath, int] = field(default_factory=dict)
    headers: list[int] = field(default_factory=list)
    chars: dict[KeyPath, list[int]] = field(default_factory=dict)
    line_starts: list[int] = field(default_factory=list)

    @classmethod
    def of(cls, text: str) -> "Places":
        """The places of a text that `tomllib` accepts."""
        places = cls(text.replace("\r\n", "\n"))
        places.line_starts = [0, *(match.end() for match in re.finditer("\n", places.text))]
        _Scanner(places).document()
        return places

    def find(self, path: KeyPath, char: int | None = None, at_key: bool = False) -> tuple[int, int]:
        """Line and column of the value at `path`, of its character `char`, or of its key.

        A path that the file lacks stands where its nearest parent does; an index just past a string, at its last
        character.
        """
        chars = self.chars.get(path)
        if char is not None and chars:
            return self._line_column(chars[min(char, len(chars) - 1)])
        first, second = (self.keys, self.values) if at_key else (self.values, self.keys)
        if path and path not in first and (*path, 0) in second | first:  # a list of tables begins with its first
            path = (*path, 0)
        while path and path not in first and path not in second:
            path = path[:-1]
        return self._line_column(first.get(path, second.get(path, 0)))

    def _line_column(self, offset: int) -> tuple[int, int]:
        line = bisect_right(self.line_starts, offset)
        return line, offset - self.line_starts[line - 1] + 1


def first_value(text: str, wanted: Callable[[str], bool]) -> tuple[int, str]:
    """Offset and text of the first number, date or truth that is `wanted`; `tomllib` accepts all that precedes it."""
    try:
        _Scanner(Places(text), wanted).document()
    except _FoundError as found:
        return found.offset, found.value
    raise AssertionError("there is such a value")


class _FoundError(Exception):
    def __init__(self, offset: int, value: str) -> None:
        self.offset, self.value = offset, value


def _nothing(_: str) -> bool:
    return False


class _Scanner:
    """Walks the text once and fills `Places`; stops at a bare value that is `wanted`."""

    def __init__(self, places: Places, wanted: Callable[[str], bool] = _nothing) -> None:
        self.places = places
        self.text = places.text
        self.wanted = wanted
        self.at = 0
        self.tables_in: dict[KeyPath, int] = {}  # last index of each array of tables

    def document(self) -> None:
        table: KeyPath = ()
        while self._skip_blank():
            if self._peek("[["):
                table = self._header("[[", "]]")
            elif self._peek("["):
                table = self._header("[", "]")
            else:
                self._pair(table)

    def _header(self, opening: str, closing: str) -> KeyPath:
        offset = self.at
        self.at += len(opening)
        keys = self._keys()
        self.at = self.text.index(closing, self.at) + len(closing)
        path = self._resolved(keys[:-1])
        path = (*path, keys[-1])
        if opening == "[[":
            self.tables_in[path] = self.tables_in.get(path, -1) + 1
            path = (*path, self.tables_in[path])
        self.places.keys.setdefault(path, offset)
        self.places.headers.append(offset)
        return path

    def _resolved(self, keys: KeyPath) -> KeyPath:
        """`keys` with the last index after each key that names an array of tables."""
        path: KeyPath = ()
        for key in keys:
            path = (*path, key)
            if path in self.tables_in:
                path = (*path, self.tables_in[path])
        return path

    def _pair(self, table: KeyPath) -> None:
        offset = self.at
        keys = self._keys()
        for depth in range(1, len(keys) + 1):
            self.places.keys.setdefault((*table, *keys[:depth]), offset)
        self.at = self.text.index("=", self.at) + 1
        self._value((*table, *keys))

    def _keys(self) -> KeyPath:
        keys: list[str] = []
        while True:
            self._skip_blank()
            if self.text[self.at] in "\"'":
                keys.append("".join(c for c, _ in self._string()))
            else:
                word = _BARE_KEY.match(self.text, self.at)
                assert word, "tomllib accepted a key that is none"
                keys.append(word.group())
                self.at = word.end()
            self._skip_blank()
            if not self._peek("."):
                return tuple(keys)
            self.at += 1

    def _value(self, path: KeyPath) -> None:
        self._skip_blank()
        self.places.values[path] = self.at
        if self.text[self.at] in "\"'":
            self.places.chars[path] = [offset for _, offset in self._string()]
        elif self._peek("["):
            self._list(path)
        elif self._peek("{"):
            self._inline_table(path)
        else:
            bare = _BARE_VALUE.match(self.text, self.at)
            assert bare, "tomllib accepted a value that is none"
            if self.wanted(bare.group()):
                raise _FoundError(self.at, bare.group())
            self.at += len(bare.group().rstrip())
        self.places.ends[path] = self.at

    def _list(self, path: KeyPath) -> None:
        if bare := _BARE_LIST.match(self.text, self.at):
            self._bare_list(path, bare.end())
            return
        self.at += 1
        index = 0
        while self._skip_blank() and not self._peek("]"):
            self._value((*path, index))
            index += 1
            self._skip_blank()
            self.at += self._peek(",")
        self.at += 1

    def _bare_list(self, path: KeyPath, end: int) -> None:
        """The entries of a list up to `end` of which each is a bare value."""
        spans = [entry.span() for entry in _BARE_ENTRY.finditer(self.text, self.at + 1, end - 1)]
        for start, stop in spans if self.wanted is not _nothing else ():
            if self.wanted(self.text[start:stop]):
                raise _FoundError(start, self.text[start:stop])
        paths = [(*path, index) for index in range(len(spans))]
        self.places.values.update(zip(paths, [start for start, _ in spans], strict=True))
        self.places.ends.update(zip(paths, [stop for _, stop in spans], strict=True))
        self.at = end

    def _inline_table(self, path: KeyPath) -> None:
        self.at += 1
        while self._skip_blank() and not self._peek("}"):
            self._pair(path)
            self._skip_blank()
            self.at += self._peek(",")
        self.at += 1

    def _string(self) -> list[tuple[str, int]]:
        """The characters of the string that starts here, with their offsets; an escape is one character."""
        if plain := _PLAIN_STRING.match(self.text, self.at):
            self.at = plain.end()
            return list(zip(plain[0][1:-1], range(plain.start() + 1, plain.end() - 1), strict=True))
        quote = self.text[self.at]
        closing = quote * 3 if self._peek(quote * 3) else quote
        self.at += len(closing)
        if len(closing) == 3:
            self.at += self._peek("\n")
        found: list[tuple[str, int]] = []
        while not self._peek(closing):
            fold = _FOLD.match(self.text, self.at) if quote == '"' else None
            escape = _ESCAPE.match(self.text, self.at) if quote == '"' else None
            if fold:
                self.at = fold.end()
                continue
            found.append((self.text[self.at], self.at))
            self.at = escape.end() if escape else self.at + 1
        self.at += len(closing)
        while len(closing) == 3 and self._peek(quote):  # a quote or two may end the text of a """string"""
            found.append((quote, self.at - len(closing)))
            self.at += 1
        return found

    def _peek(self, word: str) -> bool:
        return self.text.startswith(word, self.at)

    def _skip_blank(self) -> bool:
        """Go past blanks, line ends and comments; whether there is more text."""
        blank = _BLANK.match(self.text, self.at)
        assert blank
        self.at = blank.end()
        return self.at < len(self.text)
