"""Lines whose bars all get other texts at once: what repeats goes on to repeat, however many bars there are."""

import pytest

from station.drills.editing.line_words import with_all_bars
from station.drills.grid.grid import bar_words


@pytest.mark.parametrize(
    ("line", "texts", "expected"),
    [
        ("a|%3|b|%", "aaaabb", "a|%3|b|%"),
        ("a|%3|b|%", "ccccbb", "c|%3|b|%"),  # a written bar takes its repeats along
        ("a|%3|b|%", "aacabb", "a|% | c | a|b|%"),  # the bar behind is written out
        ("a | % | %4", "acaaaa", "a | c | a | %3"),
        ("| a | %\n| b | % |", "abba", "| a | b\n| b | a |"),
    ],
)
def test_all_bars_get_their_texts(line: str, texts: str, expected: str) -> None:
    changed = with_all_bars(line, list(texts))
    assert changed.replace(" ", "") == expected.replace(" ", "")


def test_a_long_line_is_read_once() -> None:
    line = " | ".join("a" for _ in range(512))
    bar_words.cache_clear()
    assert with_all_bars(line, ["b"] * 512).count("b") == 512
    assert bar_words.cache_info().misses == 1
