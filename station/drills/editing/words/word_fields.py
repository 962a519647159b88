"""A form for everything that a lesson's text can say: one field for each key of the format, with what stands there.

Made of the schema by which lessons are read (`lesson_fields`) and of what each key says (`lesson_words`): a key that
the format gains has its field. What a field is filled in with goes back as `SetKey`.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from functools import cache
from types import MappingProxyType

from station.core.expected import JsonSchema
from station.core.toml.schema import table_like
from station.core.toml.toml_faults import Fault
from station.core.toml.toml_places import KeyPath
from station.core.toml.toml_source import text_source
from station.drills.editing.words.fault_places import faults_by_key
from station.drills.grid.tab_symbols import ALIASES, LINE_PIECES
from station.drills.reading.lesson_fields import FIELDS
from station.drills.writing.lesson_schema import name_of
from station.drills.writing.lesson_words import words_of
from station.scoring.analysis.fault_table import WORDS as FAULT_WORDS

_LONG = frozenset({"about"})
"""Keys whose text may have several lines."""


class FieldKind(Enum):
    """What is filled in."""

    LINE = "a line of text"
    TEXT = "text of several lines"
    CELLS = "cells"
    WHOLE = "a whole number"
    NUMBER = "a number"
    CHOICE = "one of some words"
    WORDS = "words with commas between them"
    LINE_OR_WORDS = "a line, or several with commas between them"
    WHOLE_OR_WHOLES = "a whole number, or several with commas between them"
    WHOLES = "whole numbers with commas between them"
    NUMBER_OR_WORD = "a number or a word"
    NUMBERS = "numbers with commas between them"
    TRUTH = "yes or no"


@dataclass(frozen=True, slots=True)
class WordField:
    """The field of the key at `path`: what it says in a sentence, and the `value` that stands there, None for none.

    `low` and `high` bound numbers, `choices` are words to choose from; `fault` is what is wrong with it, empty if
    nothing. `is_rare`: one of many of its kind, shown where it says something.
    """

    path: KeyPath
    kind: FieldKind
    says: str
    value: object = None
    low: float | None = None
    high: float | None = None
    choices: tuple[str, ...] = ()
    fault: str = ""
    is_rare: bool = False

    @property
    def is_said(self) -> bool:
        """Whether the text has it."""
        return self.value is not None


@dataclass(frozen=True, slots=True)
class WordTable:
    """A table of the format: its `parts` in the format's order, whether they stand in the text or not."""

    path: KeyPath
    says: str
    parts: tuple["WordPart", ...]
    is_said: bool = False
    fault: str = ""
    is_rare: bool = False

    @property
    def shown(self) -> tuple["WordPart", ...]:
        """What a form shows: all but what is rare and not said."""
        return tuple(part for part in self.parts if part.is_said or not part.is_rare)

    @property
    def offered(self) -> tuple["WordPart", ...]:
        """What it can be asked to show; of two names of one piece the longer."""
        return tuple(p for p in self.parts if p.is_rare and not p.is_said and p.path[-1] not in ALIASES)


@dataclass(frozen=True, slots=True)
class WordList:
    """A list of tables: its `entries`, and what one more would be."""

    path: KeyPath
    says: str
    entries: tuple[WordTable, ...]
    blank: WordTable
    fault: str = ""
    is_rare: bool = False

    @property
    def is_said(self) -> bool:
        """Whether the text has it."""
        return bool(self.entries)


WordPart = WordField | WordTable | WordList


def words_form(text: str, faults: Sequence[Fault] = ()) -> WordTable:
    """The form of a lesson's text, the `faults` of it beside their fields; nothing is filled in where it is no TOML."""
    source = text_source(text, "")
    wrong = {} if source.syntax else faults_by_key(text, faults)
    return _Form(wrong).table(_schema(), (), source.raw if source.is_read else {})


@cache
def _schema() -> JsonSchema:
    return table_like(FIELDS)


@dataclass(frozen=True, slots=True)
class _Form:
    """What is made of a schema and raw values, with the `faults` of each key's path."""

    faults: Mapping[KeyPath, str]

    def table(self, schema: JsonSchema, path: KeyPath, raw: object) -> WordTable:
        values = raw if isinstance(raw, dict) else {}
        parts = tuple(self._part(key, one, path, values.get(key)) for key, one in _keys(schema))
        return WordTable(path, _says(path), parts, isinstance(raw, dict), self.faults.get(path, ""), _is_rare(path))

    def _part(self, key: str, schema: JsonSchema, above: KeyPath, value: object) -> WordPart:
        path = (*above, key)
        if (entry := _entry(schema)) is not None:
            return self._list(entry, path, value)
        if _keys(schema):
            return self.table(schema, path, value)
        return _field(schema, path, value, self.faults.get(path, ""))

    def _list(self, entry: JsonSchema, path: KeyPath, value: object) -> WordList:
        raws = value if isinstance(value, list) else [] if value is None else [value]
        entries = tuple(self.table(entry, (*path, index), raw) for index, raw in enumerate(raws))
        blank = self.table(entry, (*path, len(raws)), None)
        return WordList(path, _says(path), entries, blank, self.faults.get(path, ""))


def _keys(schema: JsonSchema) -> list[tuple[str, JsonSchema]]:
    """The keys of a table and the schema of each; none where the schema is of something else."""
    if "properties" in schema:
        return list(schema["properties"].items())
    names = schema.get("propertyNames", {}).get("enum", ())
    return [(name, schema["additionalProperties"]) for name in names]


def _entry(schema: JsonSchema) -> JsonSchema | None:
    """The schema of each table of a list of tables; None where the schema is of something else."""
    for each in schema.get("anyOf", [schema]):
        if "properties" in (items := each.get("items", {})):
            found: JsonSchema = items
            return found
    return None


def _says(path: KeyPath) -> str:
    """What a key says; of one of many words, what their table does."""
    names = tuple(name_of(key) for key in path if isinstance(key, str))
    return words_of(names) or words_of(names[:-1])


def _is_rare(path: KeyPath) -> bool:
    """Whether a key is one of many of its kind: the line of a piece, the word of a fault."""
    return bool(path) and (path[-1] in LINE_PIECES or path[-1] in FAULT_WORDS)


def _field(schema: JsonSchema, path: KeyPath, value: object, fault: str) -> WordField:
    kind, bounds = _kind(schema, path), _bounds(schema)
    choices = tuple(schema.get("enum", ()))
    return WordField(path, kind, _says(path), value, *bounds, choices, fault, _is_rare(path))


def _bounds(schema: JsonSchema) -> tuple[float | None, float | None]:
    """The least and the greatest number of the schema, or of the numbers of its lists."""
    for each in (schema, *schema.get("anyOf", ()), *schema.get("prefixItems", ()), schema.get("items", {})):
        if "minimum" in each:
            return each["minimum"], each["maximum"]
    return None, None


_KINDS = {"integer": FieldKind.WHOLE, "number": FieldKind.NUMBER, "boolean": FieldKind.TRUTH}
_LISTS = {"integer": FieldKind.WHOLES, "number": FieldKind.NUMBERS, "string": FieldKind.WORDS}
_EITHER = {"integer": FieldKind.WHOLE_OR_WHOLES, "string": FieldKind.LINE_OR_WORDS}


def _kind(schema: JsonSchema, path: KeyPath) -> FieldKind:
    if "anyOf" in schema:
        first = schema["anyOf"][0]
        return FieldKind.NUMBER_OR_WORD if "const" in first else _EITHER[first["type"]]
    if "enum" in schema:
        return FieldKind.CHOICE
    if schema["type"] == "array":
        return _LISTS[schema.get("items", schema.get("prefixItems", [{}])[0])["type"]]
    if schema["type"] == "string":
        return _text_kind(path)
    return _KINDS[schema["type"]]


def _text_kind(path: KeyPath) -> FieldKind:
    if path[-1] in _LONG:
        return FieldKind.TEXT
    is_line = path[-1] in LINE_PIECES or path[-1] in ("sticking", "loudness")
    return FieldKind.CELLS if is_line else FieldKind.LINE


def all_fields(part: WordPart) -> Iterator[WordField]:
    """Every field of a form, those of an entry that lists do not have yet among them."""
    if isinstance(part, WordField):
        yield part
        return
    inside: Sequence[WordPart] = part.parts if isinstance(part, WordTable) else (*part.entries, part.blank)
    for each in inside:
        yield from all_fields(each)


NEW_ENTRIES: Mapping[str, Mapping[str, object]] = MappingProxyType(
    {
        "at": {"bar": 1, "say": "…"},
        "bars": {"bars": [1, 1], "min_accuracy": 0.9},
        "cycle": {"meter": "3/4", "snare": "---"},
    }
)
"""What a new entry of a list begins with: the least that it must say (our choice)."""
_UNITS = {"ms": "ms", "db": "dB", "pct": "%", "bpm": "bpm"}


def label_of(path: KeyPath) -> str:
    """What a form calls a key: "Max loudness error (dB)"; of an entry of a list its number."""
    key = path[-1]
    if isinstance(key, int):
        return str(key + 1)
    *words, last = key.split("_")
    unit = f" ({_UNITS[last]})" if last in _UNITS else ""
    name = " ".join(words if unit else [*words, last])
    return f"{name[:1].upper()}{name[1:]}{unit}"
