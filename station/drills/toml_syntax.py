"""TOML syntax: `tomllib` reads it, and its complaints are told in words a teacher can act on.

`tomllib` stops at the first fault. To name the others too, the faulty line is set aside and the rest read again, as
long as that line does not open a table (without it, later keys would land in the wrong one).
"""

import re
import tomllib

_PLACE = re.compile(r" \(at (?:line (\d+), column (\d+)|end of document)\)$")
MAX_SYNTAX_FAULTS = 50

_PLAIN_WORDS = (
    ("Expected '=' after a key", "expected = after the key"),
    ("Invalid value", 'expected a value: text in quotes, a number, true, false or a list such as ["a", "b"]'),
    ("Expected newline or end of document after a statement", "expected the end of the line after the value"),
    ("Illegal character '\\n'", "a text in quotes is not closed on its line; expected a closing quote"),
    ("Unclosed array", "a list is not closed; expected , or ]"),
    ("Unclosed inline table", "a table in braces is not closed; expected , or }"),
    ("Unterminated string", "a text is not closed; expected its closing quotes"),
    ("Invalid statement", "expected a key, [a table] or a # comment"),
    ("Invalid initial character for a key part", "expected a key: letters, digits, _ or -"),
    ("Cannot overwrite a value", "this key was given before"),
    ("Cannot declare", "this table was given before"),
    ("Expected ']' at the end of a table declaration", "expected ] after the table's name"),
    ("Expected ']]' at the end of an array declaration", "expected ]] after the table's name"),
    ("Unescaped '\\' in a string", 'a \\ in quotes starts an escape such as \\n or \\"; write \\\\ for itself'),
)

_AT_LINE_START = ("Cannot overwrite a value", "Cannot declare")
"""Complaints that `tomllib` places after the statement that they are about."""
_AFTER_ESCAPE = "Unescaped '\\' in a string"
"""Placed after the backslash and its letter."""

SyntaxFault = tuple[int, int, str]
"""Line and column from 1, and what was expected."""


def load(text: str) -> tuple[dict[str, object], list[SyntaxFault], str]:
    """What the text says, its syntax faults, and the text as it was read in the end (faulty lines blanked)."""
    lines = text.replace("\r\n", "\n").split("\n")
    faults: list[SyntaxFault] = []
    while len(faults) < MAX_SYNTAX_FAULTS:
        try:
            return tomllib.loads("\n".join(lines)), faults, "\n".join(lines)
        except tomllib.TOMLDecodeError as error:
            line, column, words = _told(str(error), lines)
            faults.append((line, column, words))
            if not lines[line - 1].strip() or lines[line - 1].lstrip().startswith("["):
                break
            lines[line - 1] = ""
        except RecursionError:
            return {}, [(1, 1, "lists or tables nested too deeply")], ""
    return {}, faults, ""


def _told(message: str, lines: list[str]) -> SyntaxFault:
    """Line, column and plain words of a complaint of `tomllib`."""
    place = _PLACE.search(message)
    complaint = message[: place.start()] if place else message
    words = next((plain for start, plain in _PLAIN_WORDS if complaint.startswith(start)), complaint)
    if place and place.group(1):
        line, column = int(place.group(1)), int(place.group(2))
    else:  # at the end of the document
        line = max((i for i, line in enumerate(lines, 1) if line.strip()), default=1)
        column = len(lines[line - 1]) + 1
    if complaint.startswith(_AT_LINE_START):
        column = len(lines[line - 1]) - len(lines[line - 1].lstrip()) + 1
    return line, column - 2 * complaint.startswith(_AFTER_ESCAPE), words
