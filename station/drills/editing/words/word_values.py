"""What stands in a field of the words form as one reads and types it, and back as TOML has it."""

from collections.abc import Callable, Mapping
from math import isfinite
from types import MappingProxyType

from station.core.errors import BadInput
from station.drills.editing.words.word_fields import FieldKind, WordField

_YES, _NO = "yes", "no"
_MOST_SHOWN = 40
"""Letters of what was typed that a message repeats (our choice)."""


def shown_value(field: WordField) -> str:
    """The field's value as one reads it; empty where the text says nothing."""
    return _shown(field.value)


def _shown(value: object) -> str:
    if value is None:
        return ""
    if isinstance(value, bool):
        return _YES if value else _NO
    if isinstance(value, list):
        return ", ".join(map(_shown, value))
    return f"{value:g}" if isinstance(value, float) else str(value)


def typed_value(field: WordField, typed: str) -> object:
    """What was typed as the value of the field, None for nothing; raises `BadInput` where it is no such value.

    Whether it is a good value the reader of lessons says.
    """
    typed = typed if field.kind in (FieldKind.TEXT, FieldKind.CELLS) else typed.strip()
    if not typed.strip():
        return None
    try:
        return _READ[field.kind](typed)
    except ValueError:
        raise BadInput(str(field.path[-1]), "", f"expected {field.kind.value}, found {_short(typed)}") from None


def _short(typed: str) -> str:
    """What was typed as a message shows it: never long."""
    return typed if len(typed) <= _MOST_SHOWN else f"{typed[:_MOST_SHOWN]}…"


def _number(typed: str) -> int | float:
    number = float(typed)
    if not isfinite(number):
        raise ValueError(typed)
    return int(number) if number == int(number) else number


def _number_or_word(typed: str) -> object:
    return typed if typed.isalpha() else _number(typed)


def _list(read: Callable[[str], object]) -> Callable[[str], object]:
    def read_list(typed: str) -> object:
        return [read(part.strip()) for part in typed.split(",") if part.strip()]

    return read_list


def _one_or_list(read: Callable[[str], object]) -> Callable[[str], object]:
    def read_either(typed: str) -> object:
        return _list(read)(typed) if "," in typed else read(typed)

    return read_either


def _truth(typed: str) -> bool:
    return (_NO, _YES).index(typed.lower()) == 1


_READ: Mapping[FieldKind, Callable[[str], object]] = MappingProxyType(
    {
        FieldKind.LINE: str,
        FieldKind.TEXT: str,
        FieldKind.CELLS: str,
        FieldKind.CHOICE: str,
        FieldKind.WHOLE: int,
        FieldKind.NUMBER: _number,
        FieldKind.WORDS: _list(str),
        FieldKind.LINE_OR_WORDS: _one_or_list(str),
        FieldKind.WHOLE_OR_WHOLES: _one_or_list(int),
        FieldKind.WHOLES: _list(int),
        FieldKind.NUMBERS: _list(_number),
        FieldKind.NUMBER_OR_WORD: _number_or_word,
        FieldKind.TRUTH: _truth,
    }
)
