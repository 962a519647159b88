"""How often a loop was played, in recordings that hold more and less than was written; counted by hand."""

from dataclasses import replace

import numpy as np
import pytest

from station.core.events import Hit
from station.core.pieces import Piece, Zone
from station.core.units import NS_PER_MS, NS_PER_S, PPQ
from station.drills.library import find_lesson
from station.music.performance import Performance
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.scoring.following.passes import times_played
from tests.fakes.played import played
from tests.fakes.scores import rock_beat


def looped(times: int) -> list[Hit]:
    score = rock_beat(2).repeated(times)
    return list(played(score, score.onset_s, np.arange(len(score))))


@pytest.mark.parametrize("times", [1, 4, 7])
def test_as_often_as_it_was_played(times: int) -> None:
    assert times_played(rock_beat(2), Performance.from_hits(looped(times))) == times


def test_a_foot_that_keeps_time_is_no_pass() -> None:
    feet = [Hit(k * NS_PER_S // 2, Piece.HIHAT_PEDAL, Zone.BOW, 60) for k in range(4 * 8)]
    assert times_played(rock_beat(2), Performance.from_hits([*looped(4), *feet])) == 4


def test_ghosts_and_a_pad_that_triggers_twice_are_no_pass() -> None:
    hits = looped(4)
    snares = [hit for hit in hits if hit.piece is Piece.SNARE]
    more = [Hit(hit.at_ns + k * 30 * NS_PER_MS, hit.piece, hit.zone, 30) for hit in snares for k in (1, 2, 3, 4)]
    assert times_played(rock_beat(2), Performance.from_hits([*hits, *more])) == 4


def test_a_ride_for_the_hat_and_a_wrong_pad_altogether() -> None:
    hits = [replace(hit, piece=Piece.RIDE) if hit.piece is Piece.HIHAT else hit for hit in looped(4)]
    assert times_played(rock_beat(2), Performance.from_hits(hits)) == 4
    toms = [replace(hit, piece=Piece.TOM_1) for hit in looped(3)]
    assert times_played(rock_beat(2), Performance.from_hits(toms)) == 3


def test_bounces_are_no_strokes() -> None:
    score = find_lesson("multiple-bounce-roll").score
    presses = played(score, score.onset_s, np.arange(len(score)))
    bounces = [Hit(h.at_ns + k * 30 * NS_PER_MS, h.piece, h.zone, h.velocity // 2) for h in presses for k in (1, 2, 3)]
    assert times_played(score, Performance.from_hits([*presses, *bounces])) == 1


def test_silence_and_an_empty_score() -> None:
    assert times_played(rock_beat(2), Performance.from_hits([])) == 1
    assert times_played(Score.from_notes([], rock_beat(1).tempo_map), Performance.from_hits(looped(1))) == 1


@pytest.mark.parametrize("seed", [37, 49])
def test_hits_that_have_nothing_to_do_with_the_lesson_come_to_an_end(seed: int) -> None:
    """These once led the clock round three places at one hit for ever."""
    gaps_s = np.random.default_rng(seed).exponential(0.25, 120)
    hits = [Hit(round(at_s * NS_PER_S), Piece.SNARE, Zone.BOW, 80) for at_s in np.cumsum(gaps_s).tolist()]
    quarters = Score.from_notes([Note(k * PPQ, Piece.SNARE) for k in range(4)], TempoMap.constant(80))
    assert (
        1
        <= times_played(quarters, Performance.from_hits(hits))
        <= 2.2 * gaps_s.sum() / quarters.length_ns * NS_PER_S + 2
    )
