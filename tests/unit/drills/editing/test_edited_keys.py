"""Keys of all tables of the format set and taken away; the expected texts are written by hand."""

import pytest

from station.core.errors import BadInput
from station.drills.editing.edit_lesson import edited
from station.drills.editing.lesson_edits import SetKey

LESSON = """\
title = "T" # t
tempo_bpm = 90

# the goals
[goals]
level = "beginner" # l

# One character is one cell
[grid]
snare = "o-o-"
"""


def after(text: str, *edits: tuple[tuple[str | int, ...], object]) -> str:
    for path, value in edits:
        text = edited(text, SetKey(path, value), "my.toml")
    return text


@pytest.mark.parametrize(
    ("path", "value", "old", "new"),
    [
        (("title",), "New", '"T"', '"New"'),
        (("loop",), [1, 1], "90\n", "90\nloop = [1, 1]\n"),
        (("about",), "two\nrows", "90\n", '90\nabout = """\ntwo\nrows"""\n'),
        (("goals", "min_accuracy"), 0.9, "# l\n", "# l\nmin_accuracy = 0.9\n"),
        (("goals", "right_hand", "max_sd_ms"), 20, "# l\n", "# l\nright_hand = {max_sd_ms = 20}\n"),
        (("goals", "bars", 0), {"bars": [1, 1]}, "# l\n", "# l\nbars = [{bars = [1, 1]}]\n"),
        (("dynamics", "snare", "ghost"), 20, "\n# the goals", "\n[dynamics]\nsnare = {ghost = 20}\n\n# the goals"),
        (("hints", "early"), 'Say "and"', "\n# the goals", '\n[hints]\nearly = "Say \\"and\\""\n\n# the goals'),
        (("landing",), {"crash": "X"}, "\n# the goals", '\n[landing]\ncrash = "X"\n\n# the goals'),
        (("grid", 0, "times"), 3, '"o-o-"\n', '"o-o-"\ntimes = 3\n'),
        (("grid", 0, "graces", "flam_ms"), 20, '"o-o-"\n', '"o-o-"\ngraces = {flam_ms = 20}\n'),
        (("grid", 0, "at", 0, "bar"), 1, '"o-o-"\n', '"o-o-"\nat = [{bar = 1}]\n'),
        (("title",), None, 'title = "T" # t\n', ""),
        (("tempo_bpm",), None, "tempo_bpm = 90\n", ""),
        (("goals", "level"), None, '[goals]\nlevel = "beginner" # l\n\n', ""),
        (("goals",), None, '[goals]\nlevel = "beginner" # l\n\n', ""),
        (("nothing", "there"), None, "", ""),
    ],
)
def test_a_key_is_written_where_such_keys_stand(path: tuple[str | int, ...], value: object, old: str, new: str) -> None:
    assert after(LESSON, (path, value)) == LESSON.replace(old, new, 1)


def test_the_tables_of_a_list_are_counted() -> None:
    text = LESSON.replace("[grid]", "[[goals.bars]]\nbars = [1, 1]\nmin_accuracy = 0.5 # half\n\n[grid]")
    longer = after(text, (("goals", "bars", 1), {"bars": [1, 1], "max_sd_ms": 30}))
    assert "# half\n\n[[goals.bars]]\nbars = [1, 1]\nmax_sd_ms = 30\n" in longer
    assert "half" not in after(longer, (("goals", "bars", 0), None))
    assert after(longer, (("goals", "bars", 1), None)) == text.replace("# half\n\n[grid]", "# half\n\n[grid]")


def test_entries_of_at_stand_in_rows_where_the_others_do() -> None:
    text = LESSON + 'at = [\n  {bar = 1, say = "x"}, # c\n  {bar = 1, camera = "top"},\n]\n'
    added = after(text, (("grid", 0, "at", 2), {"bar": 1, "style": "jazz"}))
    assert added == text.replace('"top"},\n', '"top"},\n  {bar = 1, style = "jazz"},\n')
    assert after(added, (("grid", 0, "at", 0, "say"), "y")).count("# c") == 1
    assert after(LESSON, (("grid", 0, "at", 0), {"bar": 1}), (("grid", 0, "at", 0), None)) == LESSON


@pytest.mark.parametrize(
    "path",
    [(), ("title", "x"), ("grid", 1, "times"), ("grid", 0, "snare", 4), ("goals", 0), ("tags", 3), ("grid", "x", "y")],
)
def test_a_path_through_what_is_no_table_is_refused(path: tuple[str | int, ...]) -> None:
    with pytest.raises(BadInput, match=r"my\.toml"):
        after(LESSON, (path, 3))


@pytest.mark.parametrize("value", [{1: 2}, [None], {"a": {4, 5}}, b"bytes", object(), [10**5000]])
def test_a_value_that_toml_cannot_say_is_refused(value: object) -> None:
    with pytest.raises(BadInput, match=r"my\.toml: goals\.level: TOML has no word for"):
        after(LESSON, (("goals", "level"), value))
