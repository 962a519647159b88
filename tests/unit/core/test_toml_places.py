"""Lines and columns counted by eye."""

import time

import pytest

from station.core.toml.toml_places import Places
from station.core.toml.toml_source import load

TEXT = """\
# a comment with "quotes" and [brackets]
title = "Été"
tags = [
  "one",  # first
  'two',
]
point = { x = 1, "y z" = 2.5 }
date = 2020-01-01
a.b.c = "deep"
note = '''
first
second'''

[goals]
min = 0.5

[[grid]]
snare = "o-\\to"
right_hand.hihat = "x-"

[[grid]]
[grid.left_hand]
snare = \"\"\"
o-
--\"\"\"
"""


@pytest.mark.parametrize(
    ("path", "place"),
    [
        (("title",), (2, 9)),
        (("tags",), (3, 8)),
        (("tags", 0), (4, 3)),
        (("tags", 1), (5, 3)),
        (("point",), (7, 9)),
        (("point", "x"), (7, 15)),
        (("point", "y z"), (7, 26)),
        (("date",), (8, 8)),
        (("a", "b", "c"), (9, 9)),
        (("goals",), (14, 1)),
        (("goals", "min"), (15, 7)),
        (("grid", 0), (17, 1)),
        (("grid", 0, "snare"), (18, 9)),
        (("grid", 0, "right_hand", "hihat"), (19, 20)),
        (("grid", 1), (21, 1)),
        (("grid", 1, "left_hand", "snare"), (23, 9)),
    ],
)
def test_values(path: tuple[str | int, ...], place: tuple[int, int]) -> None:
    assert Places.of(TEXT).find(path) == place


@pytest.mark.parametrize(
    ("path", "place"),
    [
        (("title",), (2, 1)),
        (("point", "y z"), (7, 18)),
        (("a", "b"), (9, 1)),
        (("grid", 0, "right_hand"), (19, 1)),
        (("grid", 1, "left_hand"), (22, 1)),
    ],
)
def test_keys(path: tuple[str | int, ...], place: tuple[int, int]) -> None:
    assert Places.of(TEXT).find(path, at_key=True) == place


@pytest.mark.parametrize(
    ("path", "char", "place"),
    [
        (("title",), 0, (2, 10)),
        (("title",), 2, (2, 12)),
        (("note",), 0, (11, 1)),
        (("note",), 6, (12, 1)),
        (("grid", 0, "snare"), 2, (18, 12)),  # the escape is one character
        (("grid", 0, "snare"), 3, (18, 14)),
        (("grid", 0, "snare"), 99, (18, 14)),  # past the end: the last one
        (("grid", 1, "left_hand", "snare"), 0, (24, 1)),
        (("grid", 1, "left_hand", "snare"), 3, (25, 1)),
    ],
)
def test_characters(path: tuple[str | int, ...], char: int, place: tuple[int, int]) -> None:
    assert Places.of(TEXT).find(path, char) == place


def test_what_is_not_there_stands_where_its_parent_does() -> None:
    assert Places.of(TEXT).find(("goals", "max")) == (14, 1)
    assert Places.of(TEXT).find(("nothing",)) == (1, 1)


def test_line_ends_of_windows() -> None:
    assert Places.of(TEXT.replace("\n", "\r\n")).find(("grid", 1)) == (21, 1)


@pytest.mark.parametrize(
    ("text", "line", "column", "words"),
    [
        ('title "x"', 1, 7, "expected = after the key"),
        ("a = 1\nb = rock\n", 2, 5, "expected a value"),
        ('a = 1 2\nb = "x"', 1, 7, "expected the end of the line"),
        ('a = "x\nb = 1', 1, 7, "not closed"),
        ("a = [1, 2\n", 1, 10, "a list is not closed"),
        ('a = """x\n\n', 1, 9, "not closed"),
        ("a = 1\n  a = 2", 2, 3, "given before"),
        ("[a]\nb = 1\n[a]\n", 3, 1, "given before"),
        ("[a]\nb = 1\n[[a]]\nb = 2", 3, 1, "given before; where there may be several, each of them is written [[a]]"),
        ("[[a.b]]\nb = 1\n [a.b]\nb = 2", 3, 2, "each of them is written [[a.b]]"),
        ("a = “x”\n", 1, 5, "curly quotes; expected straight ones"),
        ("a = {b = “x”}\n", 1, 10, "curly quotes; expected straight ones"),
        ("[a\nb = 1", 1, 3, "expected ]"),
        ('a = "\\q"', 1, 6, "escape"),
        ("= 3", 1, 1, "expected a key"),
    ],
)
def test_syntax_faults_have_their_place_and_plain_words(text: str, line: int, column: int, words: str) -> None:
    _, _, found = load(text)
    assert found[0][:2] == (line, column), found
    assert words in found[0][2]


@pytest.mark.parametrize(
    ("text", "column"),
    [
        ("a = [{b = 1,\n c = 2}]\nd = 3\n", 13),
        ("a = {\n  b = 1,\n  c = {e = 2},\n}\nd = 3\n", 6),
        ("a = {b = 1,\n\nd = 3\n", 12),  # never closed
    ],
)
def test_a_table_in_braces_over_several_rows_is_told_once(text: str, column: int) -> None:
    raw, _, found = load(text)
    assert [f[:2] for f in found] == [(1, column)], found
    assert "a table in braces stands on one line" in found[0][2]
    assert raw == {"d": 3}


def test_every_faulty_line_is_named() -> None:
    raw, _, found = load('a = 1\nb = \nc = "x\nd 4\ne = 5\n')
    assert [f[0] for f in found] == [2, 3, 4]
    assert raw == {"a": 1, "e": 5}


def test_deep_nesting_is_a_fault() -> None:
    _, _, found = load("a = " + "[" * 100_000)
    assert "too deeply" in found[0][2]


def test_a_list_of_tables_stands_where_its_first_does() -> None:
    places = Places.of("a = 1\n\n[[gird]]\nb = 2\n")
    assert places.find(("gird",), at_key=True)[0] == 3


@pytest.mark.parametrize(
    ("path", "written"),
    [
        (("title",), '"Été"'),
        (("tags",), "[\n  \"one\",  # first\n  'two',\n]"),
        (("point",), '{ x = 1, "y z" = 2.5 }'),
        (("point", "x"), "1"),
        (("date",), "2020-01-01"),
        (("goals", "min"), "0.5"),
        (("note",), "'''\nfirst\nsecond'''"),
    ],
)
def test_a_value_ends_where_its_text_does(path: tuple[str | int, ...], written: str) -> None:
    places = Places.of(TEXT)
    assert places.text[places.values[path] : places.ends[path]] == written


def test_headers_stand_in_the_order_of_the_text() -> None:
    places = Places.of(TEXT)
    headers = [places.text[at:].split("\n")[0] for at in places.headers]
    assert headers == ["[goals]", "[[grid]]", "[[grid]]", "[grid.left_hand]"]


def test_what_is_true_of_every_line_that_follows_is_told_once() -> None:
    _, _, found = load('a = ["x"\nb = 2\n\nc = 3\nd = 4\n')
    assert [fault[:2] for fault in found] == [(2, 1)]


LISTS = """\
a = [ 1,2.5 ,
  -3e2,  2020-01-01 10:00:00 ,
  true
  , ]
b = [[], [ ], [7], [8, 9]]
c = [1, # one
  2]
d = [1, "x", 3]
"""


@pytest.mark.parametrize(
    ("path", "place", "written"),
    [
        (("a", 0), (1, 7), "1"),
        (("a", 1), (1, 9), "2.5"),
        (("a", 2), (2, 3), "-3e2"),
        (("a", 3), (2, 10), "2020-01-01 10:00:00"),
        (("a", 4), (3, 3), "true"),
        (("b", 1), (5, 10), "[ ]"),
        (("b", 2, 0), (5, 16), "7"),
        (("b", 3, 1), (5, 24), "9"),
        (("c", 1), (7, 3), "2"),
        (("d", 0), (8, 6), "1"),
        (("d", 2), (8, 14), "3"),
    ],
)
def test_entries_of_lists(path: tuple[str | int, ...], place: tuple[int, int], written: str) -> None:
    places = Places.of(LISTS)
    assert places.find(path) == place
    assert places.text[places.values[path] : places.ends[path]] == written


def test_no_entry_of_a_list_is_made_up() -> None:
    assert len(Places.of(LISTS).values) == 4 + 5 + 4 + 3 + 2 + 3


def test_a_number_of_too_many_digits_within_a_list_has_its_place() -> None:
    _, _, found = load(f"a = [1, 2,\n  {'9' * 5000}]\n")
    assert found[0][:2] == (2, 3)


@pytest.mark.parametrize("entry", ["1.25, ", "1,", "1 \n,", "1" + 20 * " " + ","])
def test_a_list_as_long_as_a_file_may_be_is_placed_in_time(entry: str) -> None:
    """Half a second of its own on a slow machine; four times that are let pass."""
    count = 900_000 // len(entry)
    begin_s = time.process_time()
    places = Places.of(f"a = [{entry * count}]\n")
    assert time.process_time() - begin_s < 2.0
    assert len(places.values) == count + 1
