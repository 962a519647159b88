"""The form of all that a lesson can say: each key of the format has its field, whatever the text says."""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from station.core.errors import BadInput
from station.drills.editing.words.word_fields import FieldKind, WordField, WordList, WordTable, all_fields, words_form
from station.drills.editing.words.word_values import shown_value, typed_value
from station.drills.library import lesson_names
from station.drills.reading.lesson_file import parse_lesson
from station.drills.writing.lesson_schema import lesson_schema
from tests.shipped_lesson import shipped_lesson
from tests.unit.drills.editing.toml_leaves import toml_leaves

REFERENCE = Path(__file__).parents[4] / "docs" / "lesson-format.md"
TEXT = """
title = "Rock"
tempo_bpm = 90
tags = ["rock", "groove"]

[goals]
max_sd_ms = 20.5
faults.late = "mute"
right_hand.min_accuracy = 0.9

[[goals.bars]]
bars = [1, 2]
min_accuracy = 0.95

[grid]
meter = ["4/4", "3/4"]
hihat = "| x-x-x-x- | x-x-x- |"
left_hand.snare = "| --o---o- | --o--- |"
at = [{bar = 1, say = "Ghosts low"}]
"""


def fields_of(text: str) -> dict[tuple[str | int, ...], WordField]:
    return {field.path: field for field in all_fields(words_form(text, parse_lesson(text, "t.toml", "t").faults))}


def keys_of(schema: dict[str, Any], top: dict[str, Any]) -> Iterator[tuple[str, ...]]:
    """Every way through the published schema to something that is no table."""
    if "$ref" in schema:
        schema = top["$defs"][schema["$ref"].rpartition("/")[2]]
    if "anyOf" in schema and ("properties" in str(schema) or "$ref" in str(schema)):
        for each in schema["anyOf"]:
            yield from keys_of(each, top)
    elif "properties" in schema:
        for key, each in schema["properties"].items():
            yield from ((key, *rest) for rest in keys_of(each, top))
    elif "properties" in str(schema.get("items", {})) or "$ref" in schema.get("items", {}):
        yield from keys_of(schema["items"], top)
    elif "propertyNames" in schema:
        yield from ((name,) for name in schema["propertyNames"]["enum"])
    else:
        yield ()


def test_each_key_of_the_published_schema_has_a_field_with_a_sentence() -> None:
    schema = lesson_schema()
    fields = list(all_fields(words_form("")))
    with_field = {tuple(key for key in field.path if isinstance(key, str)) for field in fields}
    assert set(keys_of(schema, schema)) == with_field
    assert len(with_field) > 500
    assert not [field.path for field in fields if not field.says]


def test_each_key_of_the_reference_page_has_a_field() -> None:
    page = REFERENCE.read_text(encoding="utf-8")
    named = set(re.findall(r"^\| `(\w+)` \|", page, re.MULTILINE))
    parts = {key for field in all_fields(words_form("")) for key in field.path}
    assert len(named) > 50
    assert named <= parts


def test_what_the_text_says_is_filled_in_and_the_rest_is_empty() -> None:
    fields = fields_of(TEXT)
    assert fields["title",].value == "Rock"
    assert fields["tempo_bpm",].value == 90
    assert fields["author",].value is None
    assert fields["goals", "max_sd_ms"].value == 20.5
    assert fields["goals", "faults", "late"].value == "mute"
    assert fields["goals", "right_hand", "min_accuracy"].value == 0.9
    assert fields["goals", "bars", 0, "bars"].value == [1, 2]
    assert fields["grid", 0, "meter"].value == ["4/4", "3/4"]
    assert fields["grid", 0, "left_hand", "snare"].value == "| --o---o- | --o--- |"
    assert fields["grid", 0, "at", 0, "say"].value == "Ghosts low"


def test_every_value_of_the_shipped_lessons_stands_in_a_field() -> None:
    for name in lesson_names()[::15]:
        text = shipped_lesson(name).text
        fields = {field.path: field.value for field in all_fields(words_form(text)) if field.is_said}
        assert fields == toml_leaves(text), name


@pytest.mark.parametrize(
    ("slip", "path", "words"),
    [
        (("tempo_bpm = 90", "tempo_bpm = 9"), ("tempo_bpm",), "10 to 1000"),
        (("max_sd_ms = 20.5", "max_sd_ms = 0"), ("goals", "max_sd_ms"), "1 to 1000"),
        (("0.95", "1.95"), ("goals", "bars", 0, "min_accuracy"), "0 to 1"),
        (("x-x-x-x-", "x-x-q-x-"), ("grid", 0, "hihat"), "no letter"),
        (("bar = 1,", "bar = 7,"), ("grid", 0, "at", 0, "bar"), "7"),
        (("right_hand.min", "right_foot.min"), ("goals", "right_foot", "min_accuracy"), "plays nothing"),
    ],
)
def test_a_fault_stands_beside_its_field(slip: tuple[str, str], path: tuple[str | int, ...], words: str) -> None:
    fields = fields_of(TEXT.replace(*slip))
    assert [field.path for field in fields.values() if field.fault] == [path]
    assert words in fields[path].fault


def test_what_is_missing_is_told_at_the_table() -> None:
    text = 'title = "T"\n[grid]\nname = "A"\n'
    form = words_form(text, parse_lesson(text, "t.toml", "t").faults)
    grids = next(part for part in form.parts if isinstance(part, WordList) and part.path == ("grid",))
    assert "no line to play" in grids.entries[0].fault


def test_lines_of_pieces_that_do_not_play_are_offered_and_not_shown() -> None:
    form = words_form(TEXT)
    grids = next(part for part in form.parts if part.path == ("grid",))
    assert isinstance(grids, WordList)
    shown = [part.path[-1] for part in grids.entries[0].shown]
    assert "hihat" in shown
    assert "ride" not in shown
    assert "ride" in [part.path[-1] for part in grids.entries[0].offered]


@pytest.mark.parametrize(
    ("path", "typed", "value"),
    [
        (("title",), " Rock 2 ", "Rock 2"),
        (("tempo_bpm",), "92.5", 92.5),
        (("tempo_bpm",), "92", 92),
        (("level",), "3", 3),
        (("tags",), "rock, fill ,", ["rock", "fill"]),
        (("grid", 0, "meter"), "6/8", "6/8"),
        (("grid", 0, "meter"), "4/4, 3/4", ["4/4", "3/4"]),
        (("loop",), "1, 4", [1, 4]),
        (("grid", 0, "ending"), "1, 2", [1, 2]),
        (("grid", 0, "ending"), "2", 2),
        (("goals", "faults", "late"), "mute", "mute"),
        (("goals", "faults", "late"), "12", 12),
        (("author",), "  ", None),
    ],
)
def test_what_is_typed_becomes_what_toml_says(path: tuple[str | int, ...], typed: str, value: object) -> None:
    found = typed_value(fields_of(TEXT)[path], typed)
    assert (found, type(found)) == (value, type(value))


@pytest.mark.parametrize(
    ("path", "typed"),
    [
        (("tempo_bpm",), "fast"),
        (("level",), "2.5"),
        (("loop",), "1-4"),
        (("tempo_bpm",), "nan"),
        (("goals", "min_score"), "inf"),
    ],
)
def test_what_is_no_such_value_is_refused_in_words(path: tuple[str | int, ...], typed: str) -> None:
    with pytest.raises(BadInput, match=f"expected .*number.*, found {typed}"):
        typed_value(fields_of(TEXT)[path], typed)


def test_what_is_shown_and_typed_again_is_the_same() -> None:
    for field in fields_of(TEXT).values():
        if field.is_said:
            assert typed_value(field, shown_value(field)) == field.value


def test_a_text_that_is_no_toml_has_an_empty_form() -> None:
    form = words_form("title = ")
    assert isinstance(form, WordTable)
    assert not [field for field in all_fields(form) if field.is_said]


def test_kinds() -> None:
    fields = fields_of(TEXT)
    assert fields["about",].kind is FieldKind.TEXT
    assert fields["grid", 0, "hihat"].kind is FieldKind.CELLS
    assert fields["goals", "level"].choices == ("beginner", "elementary", "intermediate", "advanced", "studio")
    assert (fields["tempo_bpm",].low, fields["tempo_bpm",].high) == (10, 1000)


def test_a_number_of_thousands_of_digits_is_refused_in_a_short_line() -> None:
    with pytest.raises(BadInput) as refused:
        typed_value(fields_of(TEXT)["level",], "9" * 5000)
    assert len(str(refused.value)) < 200
