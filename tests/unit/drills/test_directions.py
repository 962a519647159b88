"""What a teacher's cues come to, by hand."""

from station.core.named_view import NamedView
from station.drills.directions import NO_DIRECTION, Direction, direction_at
from station.drills.lesson import BarCue

CUES = (
    BarCue(1, say="Ghosts low"),
    BarCue(2, camera="feet"),
    BarCue(4, say="Now the fill", style="big"),
    BarCue(5, say="Land"),
)


def test_words_stand_for_two_bars_or_until_others_follow() -> None:
    assert [direction_at(CUES, bar).say for bar in range(8)] == [
        "",
        "Ghosts low",
        "Ghosts low",
        "",
        "Now the fill",
        "Land",
        "Land",
        "",
    ]


def test_views_and_styles_hold_until_another_cue() -> None:
    assert direction_at(CUES, 1).view is None
    assert direction_at(CUES, 7) == Direction("", NamedView.FEET, "big")


def test_a_lesson_without_cues_says_nothing() -> None:
    assert direction_at((), 3) == NO_DIRECTION
