"""A control renews what it touches and shares the rest: the expected poses are those of keys made from nothing."""

from dataclasses import fields, replace
from typing import Any

import numpy as np
import pytest

from station.core.pieces import Piece, word
from station.motion.drummer import Drummer
from station.motion.keyframes import READS
from station.motion.style.style import NUMBERS, WORDS, Style, range_of
from tests.unit.motion.patterns import ROCK, score_of

SCORE = score_of([*ROCK, *((i + 16, p) for i, p in ROCK), (80, Piece.SNARE), (84, Piece.CRASH_1), (84, Piece.KICK)])
"""Two bars, a rest of seven seconds in which one may look around and spin a stick, and two strokes after it."""
START = Style(flourish=100.0, look_around=100.0, seed=3)
DRUMMER = Drummer(SCORE, style=START)
TIMES = np.random.default_rng(5).uniform(-2.0, 16.0, 200)


def other(control: str) -> float:
    """A value of a control that is a number, away from that of `START`."""
    low, high = range_of(control)
    return low + 0.37 * (high - low)


def started(**changes: Any) -> Style:  # noqa: ANN401 - any control
    return replace(START, **changes)


CHANGED = [
    *(started(**{control: other(control)}) for control in NUMBERS),
    *(started(automation={control: ((1.0, range_of(control)[0]), (4.0, other(control)))}) for control in NUMBERS),
    *(started(**{control: words[-1]}) for control, words in WORDS.items() if control != "held"),
    started(held="brush"),
    started(seed=4),
    started(pieces={Piece.SNARE: 90.0}),
    started(automation={"snare": ((1.0, 20.0), (3.0, 90.0))}),
]


@pytest.mark.parametrize("control", ["amplitude_gain", "frequency_gain", "whip"])
@pytest.mark.parametrize("value", [0.0, 100.0])
def test_the_ends_of_a_slider_leave_every_key_in_order(control: str, value: float) -> None:
    keys = DRUMMER.with_style(started(**{control: value})).keys
    assert keys is not None
    for hand in keys.hands:
        assert (np.diff(hand.strokes.knots_s) >= 0).all()
        assert np.isfinite(hand.strokes.cubics).all()


def name_of(style: Style) -> str:
    return next(f.name for f in fields(Style) if getattr(style, f.name) != getattr(START, f.name))


@pytest.mark.parametrize("style", CHANGED, ids=[f"{i}-{name_of(s)}" for i, s in enumerate(CHANGED)])
def test_a_change_and_the_change_back_give_the_poses_of_keys_made_anew(style: Style) -> None:
    there = DRUMMER.with_style(style)
    anew = Drummer(SCORE, style=style, plan=DRUMMER.plan, parts=there.parts)
    assert np.array_equal(there.rows(TIMES), anew.rows(TIMES))
    assert np.array_equal(there.with_style(START).rows(TIMES), DRUMMER.rows(TIMES))


def test_every_number_and_word_is_tried() -> None:
    assert {name_of(style) for style in CHANGED} == {f.name for f in fields(Style)} - {"name"}


def test_stages_name_controls_that_there_are() -> None:
    controls = {control for controls in READS.values() for control in controls}
    assert controls <= {f.name for f in fields(Style)} | {word(piece) for piece in Piece}


def test_what_a_slider_does_not_touch_is_shared() -> None:
    before, after = (d.keys for d in (DRUMMER, DRUMMER.with_style(started(amplitude_gain=70.0))))
    assert before is not None
    assert after is not None
    assert after.hands[0].strokes is not before.hands[0].strokes
    for part in ("body", "head", "gaze", "blinks"):
        assert getattr(after, part) is getattr(before, part)
