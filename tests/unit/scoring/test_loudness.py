"""Loudness: levels by hand, own level, classes."""

from collections.abc import Sequence

import numpy as np
import pytest

from station.core.events import Hit
from station.core.pieces import Dynamic, Piece, Zone
from station.core.units import PPQ
from station.music.performance import Performance
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.scoring.align import align
from station.scoring.analysis.loudness import Loudness, dynamic_credit, dynamics, judged_notes, level_db

ACCENT, NORMAL, GHOST = (110, Dynamic.ACCENT), (80, Dynamic.NORMAL), (32, Dynamic.GHOST)


def snares(*strokes: tuple[int, Dynamic]) -> Score:
    notes = [Note(i * PPQ, Piece.SNARE, velocity=v, dynamic=d) for i, (v, d) in enumerate(strokes)]
    return Score.from_notes(notes, TempoMap.constant(120))


def loudness(score: Score, velocities: Sequence[float]) -> Loudness:
    hits = [
        Hit(at_ns, Piece.SNARE, Zone.HEAD, int(velocity), velocity_fraction=velocity % 1)
        for at_ns, velocity in zip(score.onset_ns.tolist(), velocities, strict=True)
    ]
    performance = Performance.from_hits(hits)
    return dynamics(score, performance, align(score, performance, clocked=True))


@pytest.mark.parametrize(
    ("velocity", "db"), [(112, -2.2), (96, -4.9), (80, -8.0), (64, -11.9), (48, -16.9), (32, -23.9)]
)
def test_levels_are_those_of_the_table(velocity: int, db: float) -> None:
    """HUMANS, Velocity and ears."""
    assert level_db(np.array([velocity]))[0] == pytest.approx(db, abs=0.06)


def test_errors_by_hand() -> None:
    result = loudness(snares(NORMAL, NORMAL, NORMAL), [90, 80, 73])
    assert result.mean_velocity_error == pytest.approx(1.0)
    assert result.sd_velocity_error == pytest.approx((((10 - 1) ** 2 + 1 + (-7 - 1) ** 2) / 2) ** 0.5)


def test_a_velocity_counts_as_finely_as_it_was_sent() -> None:
    """The accent at 110.5 is 40·log10(110.5/110) = 0.0788 dB over the others' level."""
    result = loudness(snares(*[NORMAL] * 5, ACCENT), [80.0] * 5 + [110.5])
    assert result.mean_velocity_error == pytest.approx(0.5 / 6)
    assert result.off_db[5] == pytest.approx(0.0788, abs=1e-4)


def test_only_marked_notes_and_those_beside_them_are_judged() -> None:
    score = snares(NORMAL, NORMAL, NORMAL, ACCENT, NORMAL, NORMAL, NORMAL)
    assert judged_notes(score).tolist() == [False, True, True, True, True, True, False]
    assert not judged_notes(snares(NORMAL, NORMAL)).any()


def test_playing_all_softer_is_the_players_own_level() -> None:
    """Velocities times 0.7: 6.2 dB down everywhere, no error of dynamics."""
    score = snares(*([ACCENT, NORMAL, GHOST, NORMAL] * 4))
    result = loudness(score, [round(0.7 * int(v)) for v in score.notes["velocity"]])
    assert np.nanmax(np.abs(result.off_db)) < 0.5
    assert np.diag(result.confusion).tolist() == [4, 8, 4]
    assert result.confusion.sum() == 16


def test_the_own_level_is_that_of_the_unmarked_strokes() -> None:
    """Twelve accents at 80 among eight unmarked strokes at 80: the accents alone are off, by 40·log10(80/110)."""
    score = snares(*([ACCENT, NORMAL, ACCENT, NORMAL, ACCENT] * 4))
    off = loudness(score, [80] * 20).off_db
    accents = score.notes["dynamic"] == Dynamic.ACCENT
    assert off[~accents] == pytest.approx(np.zeros(8))
    assert off[accents] == pytest.approx(np.full(12, 40 * np.log10(80 / 110)))


def test_accents_played_as_normal_strokes_are_confused() -> None:
    score = snares(*([ACCENT, NORMAL, NORMAL, NORMAL] * 4))
    result = loudness(score, [80] * 16)
    assert result.confusion[Dynamic.ACCENT].tolist() == [0, 4, 0]
    assert result.confusion[Dynamic.NORMAL].tolist() == [0, 11, 0]  # the last is three beats from an accent


def test_credit_by_hand() -> None:
    """Free to 2 dB, nothing left at 12: half at 7; not judged is full."""
    assert dynamic_credit(np.array([0.0, 2.0, -7.0, 12.0, 40.0, np.nan])).tolist() == [1, 1, 0.5, 0, 0, 1]


def test_nothing_played() -> None:
    score, silence = snares(ACCENT, NORMAL), Performance.from_hits([])
    result = dynamics(score, silence, align(score, silence, clocked=True))
    assert (result.mean_velocity_error, result.sd_velocity_error, int(result.confusion.sum())) == (None, None, 0)
