"""What the strip below the picture says, and where its ruler's lines lie; expected values are counted by hand."""

import pytest

from station.app.room_state import RoomState
from station.core.units import NS_PER_S, PPQ
from station.gui.panels.player_controls import time_words
from station.gui.panels.transport_bar import elided, found
from station.gui.widgets.ruler_scale import RulerScale
from station.music.tempo import TempoMap
from station.practice.demonstration.song_player import Song


@pytest.mark.parametrize(
    ("kit", "sound", "said"),
    [
        ("TD-17", "Speakers", ("TD-17", "Speakers")),
        ("", "silent", ("no kit: the keys play (F1)", "silent")),
        ("", "", ("no kit: the keys play (F1)",)),
    ],
)
def test_without_a_kit_the_window_says_what_plays_instead(kit: str, sound: str, said: tuple[str, ...]) -> None:
    assert found(RoomState(kit=kit, sound=sound)) == said


def ruler(bars: int, width: float) -> RulerScale:
    """At 120 beats a minute: two seconds a bar."""
    return RulerScale(Song(TempoMap.constant(120.0), bars * 4 * PPQ), 100.0, width)


def test_bars_and_beats_lie_in_proportion_on_the_ruler() -> None:
    four = ruler(4, 800.0)
    assert [(line.x, line.number) for line in four.lines()][:6] == [
        (100.0, 1),
        (150.0, None),
        (200.0, None),
        (250.0, None),
        (300.0, 2),
        (350.0, None),
    ]
    assert (four.x_of(3 * NS_PER_S), four.at_of(400.0)) == (400.0, 3 * NS_PER_S)
    assert [four.bar_of(x) for x in (-50.0, 100.0, 299.0, 301.0, 899.0, 2000.0)] == [0, 0, 0, 1, 3, 3]


def test_a_long_song_s_ruler_leaves_out_beats_and_numbers() -> None:
    """A hundred bars on 1000 pixels, 10 each: a number every fourth bar, 40 pixels."""
    lines = ruler(100, 1000.0).lines()
    assert len(lines) == 100
    assert [line.number for line in lines][:9] == [1, 0, 0, 0, 5, 0, 0, 0, 9]


@pytest.mark.parametrize(
    ("seconds", "said"), [(0.0, "0:00.0"), (59.96, "0:59.9"), (64.35, "1:04.3"), (600.0, "10:00.0")]
)
def test_the_counter_counts_minutes_and_tenths(seconds: float, said: str) -> None:
    assert time_words(seconds) == said


def test_text_that_is_too_long_ends_in_dots() -> None:
    assert elided("drums", 5, len) == "drums"
    assert elided("loud speakers", 9, len) == "loud spe…"
    assert elided("a b", 2, len) == "a…"
