"""The click in words; expected patterns are written out by hand."""

import pytest

from station.core.errors import BadInput
from station.music.swing import Swing
from station.practice.session.cues.click_options import click_text, parse_click
from station.practice.session.cues.click_pattern import PLAIN, ClickBeats, ClickLevels, ClickPattern, Displacement
from station.practice.session.cues.quiet_bars import Gap


@pytest.mark.parametrize(
    ("text", "pattern"),
    [
        ("", PLAIN),
        ("on=2and4", ClickPattern(beats=ClickBeats.BACKBEAT)),
        ("on=bar, count", ClickPattern(beats=ClickBeats.BAR, counts=True)),
        ("parts=2,swing=2", ClickPattern(subdivisions=2, swing=Swing(2.0))),
        (" parts = 2 , swing = 2 ", ClickPattern(subdivisions=2, swing=Swing(2.0))),
        ("place=and", ClickPattern(displacement=Displacement.AND)),
        ("accents=1+3,levels=127/60/0", ClickPattern(accents=(0, 2), levels=ClickLevels(127, 60, 0))),
        ("accents=0", ClickPattern(accents=())),
        ("off=2+4,gap=4/1", ClickPattern(off=(1, 3), gap=Gap(4, 1))),
    ],
)
def test_words_make_a_pattern(text: str, pattern: ClickPattern) -> None:
    assert parse_click(text) == pattern
    assert parse_click(click_text(pattern)) == pattern, "what is written is read again"


def test_only_what_differs_is_written() -> None:
    assert click_text(PLAIN) == ""
    assert click_text(ClickPattern(subdivisions=2, swing=Swing(2.5), off=(1, 3))) == "parts=2,swing=2.5,off=2+4"


@pytest.mark.parametrize(
    "word",
    ["loud", "on=3", "parts=0", "parts=9", "parts=²", "swing=nan", "swing=4", "place=2", "accents=1+", "levels=1/2",
     "levels=1/2/128", "count=yes", "accents=33", "off=0", "off=x"],
)  # fmt: skip
def test_a_word_that_cannot_be_is_named(word: str) -> None:
    with pytest.raises(BadInput) as refused:
        parse_click(f"on=bar,{word}", "--click")
    assert str(refused.value).startswith("--click")
    assert word in str(refused.value)
