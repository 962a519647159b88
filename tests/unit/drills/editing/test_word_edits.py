"""What is filled in goes into the text at its key, and nothing else there changes."""

import pytest

from station.drills.editing.edit_lesson import edited
from station.drills.editing.lesson_edits import SetKey
from station.drills.editing.words.word_fields import (
    NEW_ENTRIES,
    FieldKind,
    WordField,
    WordList,
    WordTable,
    words_form,
)
from station.drills.reading.lesson_file import parse_lesson
from tests.unit.drills.editing.toml_leaves import toml_leaves

ONE = """# how it began
title = "Rock"  # a name
tempo_bpm = 90

[grid]
hihat = "| x-x-x-x- | x-x-x-x- |"  # eighths
snare = "| --o---o- | --o---o- |"
"""
SEVERAL = ONE.replace("[grid]", '[[grid]]\nname = "A"') + '\n[[grid]]\nname = "B"\nsnare = "o-o-"\n'
VALUES: dict[FieldKind, object] = {
    FieldKind.LINE: "4/4",
    FieldKind.TEXT: 'Two\nlines, a "quote" and a # sign',
    FieldKind.CELLS: "| o--- | ---- |",
    FieldKind.WORDS: ["one", "two"],
    FieldKind.LINE_OR_WORDS: "A",
    FieldKind.WHOLE_OR_WHOLES: [1, 2],
    FieldKind.WHOLES: [1, 2],
    FieldKind.NUMBER_OR_WORD: "mute",
}


def value_of(field: WordField) -> object:
    """Something that the field may say."""
    if field.kind is FieldKind.CHOICE:
        return field.choices[0]
    return VALUES.get(field.kind, field.low)


def fields_to_fill(text: str) -> list[WordField]:
    """Every field of the form but entries that lists do not have yet; of the rare ones every twentieth."""
    found: list[WordField] = []

    def gather(table: WordTable) -> None:
        for part in table.parts:
            if isinstance(part, WordField):
                found.append(part)
            elif isinstance(part, WordTable):
                gather(part)
            else:
                for entry in part.entries:
                    gather(entry)

    gather(words_form(text))
    rare = [field for field in found if field.is_rare]
    return [field for field in found if not field.is_rare] + rare[::20]


@pytest.mark.parametrize("text", [ONE, SEVERAL], ids=["one grid", "several"])
def test_each_field_is_written_at_its_key_and_taken_away_again(text: str) -> None:
    before = toml_leaves(text)
    fields = fields_to_fill(text)
    assert len(fields) > 80
    for field in fields:
        filled = edited(text, SetKey(field.path, value_of(field)))
        assert toml_leaves(filled) == {**before, field.path: value_of(field)}, field.path
        assert "# how it began" in filled
        assert "# eighths" in filled
        emptied = edited(filled, SetKey(field.path, None))
        assert toml_leaves(emptied) == {path: value for path, value in before.items() if path != field.path}, field.path


def lists_of(table: WordTable) -> list[WordList]:
    found = [part for part in table.parts if isinstance(part, WordList)]
    inside = [part for part in table.parts if isinstance(part, WordTable)]
    inside += [entry for each in found for entry in each.entries]
    return found + [each for part in inside for each in lists_of(part)]


def test_a_new_entry_of_each_list_is_one_that_lessons_may_have() -> None:
    lists = [each for each in lists_of(words_form(ONE)) if each.path != ("grid",)]
    assert {each.path[-1] for each in lists} == NEW_ENTRIES.keys()
    for each in lists:
        text = edited(ONE, SetKey(each.blank.path, dict(NEW_ENTRIES[str(each.path[-1])])))
        assert parse_lesson(text, "t.toml", "t").faults == [], each.path
        again = next(other for other in lists_of(words_form(text)) if other.path == each.path)
        assert len(again.entries) == 1
        more = edited(text, SetKey(again.blank.path, dict(NEW_ENTRIES[str(each.path[-1])])))
        assert len(next(other for other in lists_of(words_form(more)) if other.path == each.path).entries) == 2
        assert toml_leaves(edited(text, SetKey(again.entries[0].path, None))) == toml_leaves(ONE)
