"""The TOML file as it was read: what it says, its text, and every fault of its syntax with line and column.

`tomllib` stops at the first fault. To name the others too, the faulty line is set aside and the rest read again, as
long as that line does not open a table (without it, later keys would land in the wrong one).
"""

import codecs
import re
import sys
import tomllib
from dataclasses import dataclass
from pathlib import Path

from station.core.disk.files import read_regular
from station.core.toml.toml_places import first_value

MAX_FILE_BYTES = 1_000_000
"""Our choice: no file that a person writes is longer."""
MAX_SYNTAX_FAULTS = 50
_MOST_READ = 5_000_000
"""So many characters are read again and again for the sake of further faults: about two seconds (our choice)."""
_MOST_KEYS = 100
"""A longer dotted key is a slip or an attack: what `tomllib` remembers of it grows with its square (our choice)."""

_PLACE = re.compile(r" \(at (?:line (\d+), column (\d+)|end of document)\)$")
_KEY = r"""(?:[A-Za-z0-9_-]+|"[^"\n]*"|'[^'\n]*')"""
_ENDLESS_KEY = re.compile(rf"(?:^[ \t]*+\[?+\[?+|[{{,])[ \t]*+(?:{_KEY}[ \t]*+\.[ \t]*+){{{_MOST_KEYS}}}", re.MULTILINE)
_WHOLE = re.compile(r"[+-]?[0-9_]++(?!\.[0-9]|[eE][+-]?[0-9])")
"""How a value begins that `tomllib` reads as a whole number, whatever follows it on the line."""

_NO_KEY = "Invalid initial character for a key part"
_PLAIN_WORDS = (
    ("Expected '=' after a key", "expected = after the key"),
    ("Invalid value", 'expected a value: text in quotes, a number, true, false or a list such as ["a", "b"]'),
    ("Expected newline or end of document after a statement", "expected the end of the line after the value"),
    ("Illegal character '\\n'", "a text in quotes is not closed on its line; expected a closing quote"),
    ("Unclosed array", "a list is not closed; expected , or ]"),
    ("Unclosed inline table", "a table in braces is not closed; expected , or }"),
    ("Unterminated string", "a text is not closed; expected its closing quotes"),
    ("Invalid statement", "expected a key, [a table] or a # comment"),
    (_NO_KEY, "expected a key: letters, digits, _ or -"),
    ("Cannot overwrite a value", "this key was given before"),
    ("Duplicate inline table key", "this key was given before"),
    ("Cannot declare", "this table was given before"),
    ("Expected ']' at the end of a table declaration", "expected ] after the table's name"),
    ("Expected ']]' at the end of an array declaration", "expected ]] after the table's name"),
    ("Unescaped '\\' in a string", 'a \\ in quotes starts an escape such as \\n or \\"; write \\\\ for itself'),
)

_AT_A_SIGN = (_NO_KEY, "Invalid value", "Expected newline or end of document after a statement")
"""Complaints that `tomllib` places at the sign that is the slip."""
_HEADER = re.compile(r"\s*\[{1,2}\s*([^\[\]]{1,40}?)\s*\]")
_AT_LINE_START = ("Cannot overwrite a value", "Cannot declare")
"""Complaints that `tomllib` places after the statement that they are about."""
_CURLY = "“”„‟«»‘’‚‹›"
_CURLED = 'these are curly quotes; expected straight ones, as in "text"'
_BROKEN_BRACES = "a table in braces stands on one line; expected all of it here"
_WRITTEN_TWICE = "this table was given before; where there may be several, each of them is written [[{name}]]"
_SPREADING = (
    "a list is not closed; expected , or ]",
    "a table in braces is not closed; expected , or }",
    "a text is not closed; expected its closing quotes",
    "expected a key, [a table] or a # comment",
)
"""Plain words that are true of each line after the one at fault; they are told of the first of these lines."""
_AFTER_ESCAPE = "Unescaped '\\' in a string"
"""Placed after the backslash and its letter."""

SyntaxFault = tuple[int, int, str]
"""Line and column from 1, and what was expected."""


@dataclass(frozen=True, slots=True)
class Source:
    """A file or a text by its `name`: `raw` is what it says, `text` what was read in the end (faulty lines blanked)."""

    name: str
    raw: dict[str, object]
    text: str
    syntax: tuple[SyntaxFault, ...] = ()
    is_file: bool = True

    @property
    def is_read(self) -> bool:
        """Whether anything can be said about its values."""
        return bool(self.raw) or not self.syntax


def read_source(path: Path) -> Source:
    """The TOML file at `path`; raises `BadInput` if it cannot be read or is too large."""
    return source_of(read_regular(path, MAX_FILE_BYTES), str(path))


def source_of(data: bytes, name: str) -> Source:
    """What the bytes of the file called `name` say."""
    data = data.removeprefix(codecs.BOM_UTF8)
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError as fault:
        before = data[: fault.start].decode("utf-8")
        return Source(name, {}, before, ((*_end(before), "not UTF-8 text; expected TOML, saved as UTF-8"),))
    return Source(name, *load(text))


def text_source(text: str, name: str) -> Source:
    """What a text says that is no file of its own; `name` names it in faults."""
    if len(text) > MAX_FILE_BYTES:
        return Source(name, {}, "", ((1, 1, f"longer than {MAX_FILE_BYTES} letters"),), is_file=False)
    return Source(name, *load(text), is_file=False)


def load(text: str) -> tuple[dict[str, object], str, tuple[SyntaxFault, ...]]:
    """What the text says, the text as it was read in the end (faulty lines blanked), and its syntax faults."""
    text = text.replace("\r\n", "\n")
    if endless := _ENDLESS_KEY.search(text):
        return {}, "", ((*_end(text[: endless.start()]), f"a key of more than {_MOST_KEYS} parts"),)
    faults: list[SyntaxFault] = []
    set_aside = -1
    for _ in range(min(MAX_SYNTAX_FAULTS, 1 + _MOST_READ // (len(text) + 1))):
        try:
            return tomllib.loads(text), text, tuple(faults)
        except tomllib.TOMLDecodeError as error:
            faults.append(_syntax_fault(str(error), text))
        except ValueError:  # Python reads no longer whole number
            faults.append(_too_long(text))
        except RecursionError:
            return {}, "", ((1, 1, "lists or tables nested too deeply"),)
        lines = text.split("\n")
        line = faults[-1][0] - 1
        follows = len(faults) > 1 and not "".join(lines[set_aside + 1 : line]).strip()
        if follows and faults[-1][2] == faults[-2][2] in _SPREADING:
            del faults[-1]
        set_aside = _last_of(faults[-1], lines)
        if not lines[line].strip() or lines[line].lstrip().startswith("["):
            break
        lines[line : set_aside + 1] = [""] * (set_aside + 1 - line)
        text = "\n".join(lines)
    return {}, "", tuple(faults)


def _syntax_fault(message: str, text: str) -> SyntaxFault:
    """Line, column and plain words of a complaint of `tomllib`."""
    place = _PLACE.search(message)
    complaint = message[: place.start()] if place else message
    words = next((plain for start, plain in _PLAIN_WORDS if complaint.startswith(start)), complaint)
    if place and place.group(1):
        line, column = int(place.group(1)), int(place.group(2))
    else:
        line, column = _end(text.rstrip())
    if complaint.startswith(_AT_LINE_START):
        statement = text.split("\n")[line - 1]
        column = len(statement) - len(statement.lstrip()) + 1
        if header := _HEADER.match(statement):
            words = _WRITTEN_TWICE.format(name=header.group(1))
    elif complaint.startswith(_AT_A_SIGN):
        words = _words_of_sign((text.split("\n")[line - 1] + "\n")[column - 1 :], complaint) or words
    return line, column - 2 * complaint.startswith(_AFTER_ESCAPE), words


def _words_of_sign(rest: str, complaint: str) -> str:
    """Plain words of a sign that is the slip itself, where `rest` of a line begins with one; else none."""
    if rest[0] in _CURLY:
        return _CURLED
    return _BROKEN_BRACES if rest[0] == "\n" and complaint.startswith(_NO_KEY) else ""


def _last_of(fault: SyntaxFault, lines: list[str]) -> int:
    """The last line, from 0, of what is at fault: where broken braces close, if they do before the next table."""
    first = fault[0] - 1
    if fault[2] != _BROKEN_BRACES:
        return first
    depth = 0
    for i, line in enumerate(lines[first:], first):
        if i > first and line.startswith("["):
            break
        depth += line.count("{") - line.count("}")
        if depth <= 0:
            return i
    return first


def _too_long(text: str) -> SyntaxFault:
    """The first number that has more digits than Python reads."""
    most = sys.get_int_max_str_digits()
    at, value = first_value(text, lambda value: _digits(value) > most)
    return *_end(text[:at]), f"a number of {_digits(value)} digits; no number here is as long"


def _digits(value: str) -> int:
    """How many digits the whole number has with which a value begins; 0 where it begins with none."""
    number = _WHOLE.match(value)
    return 0 if number is None else sum(map(str.isdecimal, number[0]))


def _end(text: str) -> tuple[int, int]:
    """Line and column just after `text`."""
    return text.count("\n") + 1, len(text) - text.rfind("\n")
