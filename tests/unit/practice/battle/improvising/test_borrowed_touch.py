"""A phrase borrows a human phrase's touch, stroke by stroke; figures of what ships are near to published ones."""

import numpy as np
import pytest

from station.practice.battle.improvising import borrowed_touch as borrowing
from station.practice.battle.improvising.borrowed_touch import BorrowedTouch, borrowed_touch
from station.practice.battle.improvising.human_phrases import HumanPhrases, human_phrases
from station.practice.battle.improvising.human_playing import human_playing
from station.practice.battle.improvising.played_beats import Beats, Instrument

_HAT, _KICK, _SNARE, _TOM = Instrument.CLOSED_HIHAT, Instrument.KICK, Instrument.SNARE, Instrument.MID_TOM


def _rock(bars: int = 4) -> Beats:
    """Eighths on the hi-hat, kick on one and three, snare on two and four."""
    found = Beats.silent(4 * bars, 4)
    found.struck[:, [0, 2], _HAT] = True
    found.struck[::2, 0, _KICK] = True
    found.struck[1::2, 0, _SNARE] = True
    return found


def _played() -> Beats:
    """The rock groove, the beat `b` of it 2 b ms late, offbeats at 40, hats on the beat at 70 + b, kicks 90, snares
    110."""
    found = _rock()
    beat = np.arange(16)
    found.late_ms[:] = 2.0 * beat[:, None, None] * found.struck
    found.velocity[:, 0, _HAT] = 70 + beat
    found.velocity[:, 2, _HAT] = 40
    found.velocity[::2, 0, _KICK] = 90
    found.velocity[1::2, 0, _SNARE] = 110
    return found


def _lent(beats: Beats, monkeypatch: pytest.MonkeyPatch) -> tuple[BorrowedTouch, np.ndarray, np.ndarray]:
    """The touch that `_played` lends, and its velocities and lateness (n, 8, 9)."""
    phrases = HumanPhrases.of([(100.0, _played())])
    monkeypatch.setattr(borrowing, "human_phrases", lambda: phrases)
    touch = borrowed_touch(beats, 100.0, np.random.default_rng(1))
    velocity, late = np.zeros(beats.struck.shape), np.zeros(beats.struck.shape)
    velocity[beats.struck], late[beats.struck] = touch.velocity, touch.late_ms + touch.lean_ms
    return touch, velocity, late


def test_the_same_notes_get_the_humans_own_touch(monkeypatch: pytest.MonkeyPatch) -> None:
    touch, velocity, late = _lent(_rock(), monkeypatch)
    assert np.array_equal(velocity, _played().velocity)
    assert np.allclose(late, _played().late_ms)
    assert touch.lean_ms == 15.0  # three strokes a beat, 0, 2 … 30 ms: the middle lies between 14 and 16


def test_a_stroke_without_a_fellow_has_the_clock_of_its_moment(monkeypatch: pytest.MonkeyPatch) -> None:
    beats = _rock()
    beats.struck[9, 1, _HAT] = True  # a sixteenth after beat 9, where the human plays nothing
    _, velocity, late = _lent(beats, monkeypatch)
    assert late[9, 1, _HAT] == pytest.approx(18.0, abs=1.0)  # its moment's, as one of its kind plays it
    assert velocity[9, 1, _HAT] in {*range(70, 86), 40}  # as one of the human's hats


def test_an_instrument_that_the_human_left_out_is_as_loud_as_usual_beside_its_lender(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    beats = _rock()
    beats.struck[3, 0, _SNARE], beats.struck[3, 0, _TOM] = False, True
    _, velocity, late = _lent(beats, monkeypatch)
    assert late[3, 0, _TOM] == pytest.approx(6.0)
    assert 1 <= velocity[3, 0, _TOM] <= 127


def test_longer_phrases_go_round(monkeypatch: pytest.MonkeyPatch) -> None:
    _, velocity, late = _lent(_rock(8), monkeypatch)
    assert np.array_equal(velocity[:16], velocity[16:])
    assert np.allclose(late[:16], late[16:])


def test_the_lender_is_who_plays_the_like(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of seven phrases that could lend, the six on the same notes come before one on toms."""
    toms = Beats.silent(16, 4)
    toms.struck[:, :2, _TOM] = True
    toms.velocity[:, :2, _TOM] = 5
    phrases = HumanPhrases.of([(100.0, toms), *((100.0, _played()) for _ in range(6))])
    monkeypatch.setattr(borrowing, "human_phrases", lambda: phrases)
    for seed in range(12):
        touch = borrowed_touch(_rock(), 100.0, np.random.default_rng(seed))
        assert touch.velocity.min() == 40.0


def test_what_ships_is_as_wide_as_humans_are_said_to_be() -> None:
    """HUMANS, Timing: 26–28 ms over whole takes, so within four bars between 12 and 28; Velocity: all of MIDI."""
    phrases = human_phrases()
    spreads = [part.std() for part in np.split(phrases.late_ms.astype(float), phrases.first[1:-1])]
    assert 12 < np.median(spreads) < 28
    assert phrases.velocity.min() >= 1
    assert phrases.velocity.max() == 127
    assert phrases.at.max() < 24 * 4 * 5  # four bars of at most five beats


def test_backbeats_are_louder_than_what_lies_between() -> None:
    backbeat, early = 1, 3
    assert human_playing().velocity[_SNARE, backbeat] > human_playing().velocity[_SNARE, early] + 30
