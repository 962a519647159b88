"""Openness and chokes: scored where the kit tells, "cannot tell" where it does not; counted by hand."""

import numpy as np
import pytest

from station.core.pieces import Piece, Zone
from station.core.units import PPQ
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.scoring.analysis.summary import SummaryView, summarise
from station.scoring.analysis.technique.openness import Opening, chokes, hats
from tests.fakes.answers import Played, Take, take


def opening_hats(openness: tuple[float, ...] = (0.0, 0.0, 0.5, 1.0)) -> Score:
    """Eight bars of quarters on the hi-hat: shut, shut, half open, open."""
    notes = [Note(i * PPQ, Piece.HIHAT, Zone.BOW, openness=openness[i % 4]) for i in range(32)]
    return Score.from_notes(notes, TempoMap.constant(120))


def played_hats(openness: list[float]) -> Take:
    return take(opening_hats(), Played(openness=np.tile(openness, 8)))


def test_as_written_by_hand() -> None:
    played = played_hats([0.1, 0.0, 0.4, 0.9])
    found = hats(played.score, played.performance, played.alignment)
    assert found is not None
    assert (found.written, found.judged, found.right) == (32, 32, 32)
    assert found.confusion.tolist() == [[16, 0, 0], [0, 8, 0], [0, 0, 8]]
    assert found.openness[Opening.CLOSED].mean == pytest.approx(0.05)
    assert found.openness[Opening.OPEN].mean == pytest.approx(0.9)


def test_open_and_half_open_answer_for_each_other() -> None:
    played = played_hats([0.0, 0.1, 1.0, 0.5])
    found = hats(played.score, played.performance, played.alignment)
    assert found is not None
    assert (found.right, found.confusion[Opening.HALF, Opening.OPEN], found.confusion[Opening.OPEN, Opening.HALF]) == (
        32, 8, 8,
    )  # fmt: skip


def test_a_hat_left_open_is_wrong_and_costs_a_tenth_of_its_notes() -> None:
    """Every second closed stroke was half open: 8 of 32 notes lose a tenth, 100·(1 − 0.1/4)."""
    played = played_hats([0.0, 0.6, 0.5, 1.0])
    found = hats(played.score, played.performance, played.alignment)
    assert found is not None
    assert (found.judged, found.right) == (32, 24)
    assert summarise(played.score, played.performance, played.alignment).points == pytest.approx(97.5)


def test_a_kit_without_openness_cannot_tell_and_nothing_is_lost() -> None:
    played = played_hats([np.nan] * 4)
    found = hats(played.score, played.performance, played.alignment)
    assert found is not None
    assert (found.matched, found.judged, found.right, found.openness) == (32, 0, 0, {})
    assert summarise(played.score, played.performance, played.alignment).points == pytest.approx(100)


def test_a_kit_that_says_open_or_shut_cannot_tell_half_open() -> None:
    played = played_hats([0.0, 0.0, 0.0, 1.0])
    found = hats(played.score, played.performance, played.alignment)
    assert found is not None
    assert (found.matched, found.judged, found.right) == (32, 24, 24)


def choked(count: int = 6) -> Score:
    """A crash on one of each bar at 120 bpm, grabbed a beat (500 ms) later."""
    notes = [Note(4 * PPQ * k, Piece.CRASH_1, Zone.EDGE, choke_ticks=PPQ) for k in range(count)]
    return Score.from_notes(notes, TempoMap.constant(120))


def test_chokes_by_hand() -> None:
    """Grabbed 540 and 560 ms after the stroke in turn, one not at all: 5 of 6, 40 or 60 ms late: mean 48."""
    grabs = tuple((2000.0 * k + (540 if k % 2 == 0 else 560), Piece.CRASH_1) for k in range(5))
    played = take(choked(), Played(chokes=grabs))
    found = chokes(played.score, played.performance, played.alignment, None)
    assert found is not None
    assert (found.written, found.judged, found.made) == (6, 6, 5)
    assert found.ring_ms.mean == pytest.approx((3 * 40 + 2 * 60) / 5)


def test_another_crash_answers_with_its_own_grab() -> None:
    grabs = tuple((2000.0 * k + 500, Piece.CRASH_2) for k in range(6))
    played = take(choked(), Played(chokes=grabs, pieces=dict.fromkeys(range(6), Piece.CRASH_2)))
    found = chokes(played.score, played.performance, played.alignment, None)
    assert found is not None
    assert (found.judged, found.made) == (6, 6)


def test_a_kit_that_never_sent_a_choke_cannot_tell_unless_it_is_known_to() -> None:
    played = take(choked())
    unknown = chokes(played.score, played.performance, played.alignment, None)
    able = chokes(played.score, played.performance, played.alignment, True)
    assert unknown is not None
    assert able is not None
    assert (unknown.matched, unknown.judged, able.judged, able.made) == (6, 0, 6, 0)
    assert summarise(played.score, played.performance, played.alignment).points == pytest.approx(100)
    known = SummaryView(kit=SummaryView().kit.__class__(tells_chokes=True))
    assert summarise(played.score, played.performance, played.alignment, known).points == pytest.approx(90)


def test_grabs_are_found_at_another_tempo() -> None:
    """Played without a click at two thirds of the tempo: the cymbal rings 750 ms, a beat."""
    fill = [Note(k * PPQ, Piece.SNARE) for k in range(48)]
    score = Score.from_notes([*choked(12), *fill], TempoMap.constant(120))
    slow_ms = score.onset_ns / 1e6 * 0.5
    grabs = tuple((3000.0 * k + 750, Piece.CRASH_1) for k in range(12))
    played = take(score, Played(off_ms=slow_ms, chokes=grabs), clocked=False)
    found = chokes(score, played.performance, played.alignment, None)
    assert found is not None
    assert (found.judged, found.made) == (12, 12)
    assert found.ring_ms.mean == pytest.approx(0.0, abs=2.0)
