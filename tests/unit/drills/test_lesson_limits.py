"""A text may be short and yet ask for more than anyone practises: it is refused at once, in one line."""

import time

import pytest

from tests.unit.drills.reading import faults

HEAD = 'title = "T"\n'
WORDS = '{bar = 1, say = "x"}'
MOST_S = 2.0
"""Nobody waits longer for an answer; each of these took from four seconds to minutes before there was a limit."""


def at(count: int) -> str:
    return f"at = [{', '.join([WORDS] * count)}]\n"


def variations(count: int, more: str = "") -> str:
    first = f'[[grid]]\nname = "g0"\nsnare = "oooo"\n{more}'
    return first + "".join(f'[[grid]]\nname = "g{i}"\nlike = "g{i - 1}"\n' for i in range(1, count))


TOO_MUCH = {
    "entries of one list": (
        "[grid]\n" + at(20_000) + 'snare = "o"\n',
        "20000 entries of at; a lesson has at most 1000",
    ),
    "entries that variations take over": (variations(100, at(500)), "50000 entries of at; a lesson has at most 1000"),
    "entries as played": (
        f'form = "{",".join(["A"] * 20)}"\n[[grid]]\nname = "A"\nsnare = "o"\ntimes = 100\n{at(1000)}',
        "at most 4000",
    ),
    "grids": (variations(1500), "1500 grids; a lesson has at most 500"),
    "hands under a cycle": (
        f'[grid]\nmeter = "32/1"\nbars = 190\n[[grid.cycle]]\nmeter = "1/32"\nkick = "-"\nsticking = "{"R" * 64}"\n',
        "cells; a lesson has at most 200000",
    ),
    "steps of a tempo": (
        'beat = "1/32"\n[grid]\nmeter = "32/1"\ntempo_bpm = 500\ntempo_to_bpm = 600\ntimes = 10\nsnare = "o | %199"\n',
        "the tempo changes",
    ),
    "prerequisites": (
        f'prerequisites = [{", ".join(f"{i!s:_>5}".join(chr(34) * 2) for i in range(20_000))}]\n[grid]\nsnare = "o"\n',
        "20000 entries; expected at most 100",
    ),
}


@pytest.mark.parametrize(("text", "words"), TOO_MUCH.values(), ids=TOO_MUCH.keys())
def test_more_than_anyone_practises_is_refused_at_once(text: str, words: str) -> None:
    start = time.process_time()
    found = faults(HEAD + text)
    assert time.process_time() - start < MOST_S
    assert len(found) == 1
    assert words in found[0].text


def test_what_is_wrong_in_a_long_chain_of_variations_is_told_once_and_soon() -> None:
    start = time.process_time()
    found = faults(HEAD + variations(500).replace("oooo", "qqqq"))
    assert time.process_time() - start < MOST_S
    assert [(f.line, f.column) for f in found] == [(4, 10), (4, 11), (4, 12), (4, 13)]


# --- the message --------------------------------------------------------------------------------------------------


def test_a_name_that_stands_in_the_form_often_is_told_once_where_it_first_stands() -> None:
    assert [(f.line, f.column) for f in faults(HEAD + 'form = "A, C, A, C"\n[[grid]]\nname = "A"\nsnare = "o"\n')] == [
        (2, 12)
    ]


@pytest.mark.parametrize(
    "value", ["a\\nb", "\\u001b[31m", "x" * 500_000, "\\u2028"], ids=["rows", "escape", "long", "line"]
)
def test_a_message_is_one_short_printable_line_whatever_the_file_says(value: str) -> None:
    (found,) = faults(f'{HEAD}[goals.faults]\nunsteady = "{value}"\n[grid]\nsnare = "o"\n')
    assert str(found).isprintable()
    assert len(str(found)) < 200


@pytest.mark.parametrize("key", ["title", "about", "author"])
def test_texts_hold_nothing_that_a_terminal_obeys(key: str) -> None:
    head = HEAD if key != "title" else ""
    (found,) = faults(f'{head}{key} = "a\\u001b[2Jb"\n[grid]\nsnare = "o"\n')
    assert found.text == rf"{key}: expected text without control characters, found \x1b"


def test_prose_may_have_rows_and_tabs() -> None:
    assert not faults(HEAD + 'about = "one\\n\\ttwo"\n[grid]\nsnare = "o"\n')


@pytest.mark.parametrize("grid", ["[grid]\n", '[grid]\nkick = "-"\n', '[grid]\n[grid.cycle]\nmeter = "5/8"\n'])
def test_what_a_line_with_a_fault_of_syntax_may_have_said_is_not_missing(grid: str) -> None:
    (found,) = faults(HEAD + grid + 'snare = "oooo\n')
    assert (found.line, found.text) == (
        2 + grid.count("\n"),
        "a text in quotes is not closed on its line; expected a closing quote",
    )


def test_a_grid_that_is_played_once_has_no_second_ending() -> None:
    (found,) = faults(HEAD + '[[grid]]\ntimes = 1\nsnare = "o"\n[[grid]]\nending = 2\nsnare = "o"\n')
    assert found.text == "grid.ending: the grid before is played once; there is no repetition 2"


def test_times_that_are_no_number_are_told_once() -> None:
    (found,) = faults(HEAD + '[[grid]]\ntimes = true\nsnare = "o"\n[[grid]]\nending = 2\nsnare = "o"\n')
    assert "expected a whole number from 1 to 100, found true" in found.text
