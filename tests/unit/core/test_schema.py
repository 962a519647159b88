"""Readers of values, tables and lists, and where their faults are told; places counted by eye."""

from typing import NamedTuple

import pytest

from station.core.errors import BadInput
from station.core.toml.schema import (
    Field,
    Reader,
    choice,
    key_of,
    list_of,
    needed,
    number,
    optional,
    point,
    read,
    reading,
    record,
    said,
    shown,
    table_of,
    text,
    whole,
)
from station.core.toml.toml_faults import MOST_FAULTS, wrong
from station.core.toml.toml_source import source_of, text_source


class Drum(NamedTuple):
    size: int
    kind: str
    gain: float


def _drum(size: int, kind: str, gain: float) -> Drum:
    if kind == "kick" and size < 16:
        raise wrong("a kick is larger", "size")
    return Drum(size, kind, gain)


KINDS = {"kick": "kick", "snare": "snare"}
DRUM = record(
    _drum,
    {
        "size": needed(whole(6, 28), "size = 14"),
        "kind": Field(choice(KINDS, "kind"), "snare"),
        "gain_db": Field(number(-60, 6), 0.0, called="gain"),
    },
)
KIT: Reader[dict[str, Drum]] = table_of(key_of({"left": "L", "right": "R"}, "side"), DRUM)


def told(written: str, reader: Reader[object] = KIT) -> list[str]:
    return [f"{fault.line}:{fault.column} {fault.text}" for fault in reading(text_source(written, "t"), reader)[1]]


def test_what_is_not_said_has_its_default_and_a_value_may_be_called_otherwise() -> None:
    kit = read(text_source("[left]\nsize = 14\n[right]\nsize = 22.0\nkind = 'kick'\ngain_db = -3", "t"), KIT)
    assert kit == {"L": Drum(14, "snare", 0.0), "R": Drum(22, "kick", -3.0)}


def test_all_faults_are_told_in_the_order_of_the_file_and_what_is_missing_last() -> None:
    written = '[right]\nkind = "kik"\nsize = 99\nsise = 3\n[left]\ngain_db = "loud"\n[lift]\nsize = 14\n'
    assert told(written) == [
        '2:8 right.kind: expected kick or snare, found "kik"; did you mean kick?',
        "3:8 right.size: expected a whole number from 6 to 28, found 99",
        "4:1 no such key: sise; did you mean size?",
        '6:11 left.gain_db: expected a number from -60 to 6, found "loud"',
        "7:1 no such side: lift; did you mean left?",
        "5:1 left.size is missing; expected size = 14",
    ]


def test_values_are_compared_with_each_other_only_where_each_is_sound() -> None:
    assert told('[left]\nsize = 14\nkind = "kick"') == ["2:8 left.size: a kick is larger"]
    assert told('[left]\nsize = 5\nkind = "kick"') == ["2:8 left.size: expected a whole number from 6 to 28, found 5"]


def test_nothing_is_missing_where_a_line_could_not_be_read() -> None:
    assert told("[left]\nsize = 14 inch\n") == ["2:11 expected the end of the line after the value"]


def test_entries_of_a_list_are_told_one_by_one() -> None:
    reader = record(lambda a: a, {"a": needed(list_of(whole(1, 3), "a list of numbers"))})
    assert told("a = [1, 4, 2,\n  0]", reader) == [
        "1:9 a: expected a whole number from 1 to 3, found 4",
        "2:3 a: expected a whole number from 1 to 3, found 0",
    ]
    assert told("a = 3", reader) == ["1:5 a: expected a list of numbers, found 3"]
    assert told("a = [0, 1]", record(lambda a: a, {"a": needed(point(3.0))})) == [
        "1:5 a: expected [right, forward, up] in metres, found 2 entries"
    ]


def test_only_what_is_said_counts() -> None:
    reader = said({"a": optional(text), "b": Field(text, "x", called="c")})
    assert read(text_source("b = 'y'", "t"), reader) == {"c": "y"}


def test_one_line_says_how_many_faults_there_are_and_what_lists_them_all() -> None:
    written = b"[left]\nsize = 1\nkind = 2\n"
    with pytest.raises(BadInput) as of_file:
        read(source_of(written, "my kits/k.toml"), KIT)
    assert str(of_file.value) == (
        "my kits/k.toml: line 2, column 8: left.size: expected a whole number from 6 to 28, found 1 "
        '(and 1 more: `station lesson check "my kits/k.toml"` lists them)'
    )
    with pytest.raises(BadInput, match=r"found 1 \(and 1 more\)$"):
        read(text_source(written.decode(), "a text"), KIT)


def test_of_a_flood_of_faults_the_first_are_told() -> None:
    assert len(told("".join(f"k{i} = 1\n" for i in range(2 * MOST_FAULTS)))) == MOST_FAULTS


@pytest.mark.parametrize(
    ("value", "words"),
    [
        (True, "true"),
        ("a\nb", '"a\\nb"'),
        (float("nan"), "nan"),
        ({}, "a table"),
        ([1], "a list"),
        ("x" * 100, '"' + "x" * 19 + "…" + "x" * 19 + '"'),
        (10**60, "1" + "0" * 19 + "…" + "0" * 20),
    ],
)
def test_a_value_is_shown_as_a_file_has_it_and_never_long(value: object, words: str) -> None:
    assert shown(value) == words


def test_a_number_of_thousands_of_digits_is_shown_short_in_any_base() -> None:
    for digits in ("0x" + "f" * 6000, "0o" + "7" * 6000, "0b" + "1" * 20000):
        assert len(shown(int(digits, 0))) < 100
