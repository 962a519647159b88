"""Points by tap, by onset and by ear."""

import numpy as np
import pytest

from station.core.errors import BadInput
from station.core.pieces import Piece, Zone
from station.core.units import PPQ
from station.drills.songs.band_tempo import BandPoint
from station.drills.songs.point_setting import nudged, points_of_taps, snapped
from station.music.score import Note, Score
from station.music.sound_onsets import OnsetBand, SoundOnsets
from station.music.tempo import TempoMap

SCORE = Score.from_notes(
    [
        Note(0, Piece.KICK),
        Note(0, Piece.HIHAT, Zone.BOW),
        Note(PPQ, Piece.SNARE),
        Note(2 * PPQ, Piece.HIHAT, Zone.BOW),
    ],
    TempoMap.constant(120.0),
)
LOW, MID, HIGH = OnsetBand


def sound(*attacks: tuple[float, OnsetBand, float]) -> SoundOnsets:
    """A sound with attacks at seconds, in bands, of weights."""
    at_s, band, weight = zip(*attacks, strict=True) if attacks else ((), (), ())
    strength = np.zeros((3, 400), np.float32)
    return SoundOnsets(
        0.005, strength, np.array(at_s, float), np.array(band, np.int8), np.array(weight, np.float32), 2.0
    )


def test_a_point_goes_to_the_attack_in_the_bands_of_its_pieces() -> None:
    """A kick and a hat are written: the guitar 5 ms away is in no band of theirs alone, what starts low and high is."""
    heard = sound((0.995, MID, 1.0), (1.030, LOW, 1.0), (1.032, HIGH, 1.0))
    assert snapped(SCORE, BandPoint(0, 1.0), heard).at_s == pytest.approx(1.031, abs=0.001)


def test_of_two_alike_the_nearer_is_taken() -> None:
    heard = sound((0.975, HIGH, 1.0), (1.05, HIGH, 1.0))
    assert snapped(SCORE, BandPoint(2 * PPQ, 1.0), heard) == BandPoint(2 * PPQ, 0.975)


@pytest.mark.parametrize("attacks", [(), ((1.07, LOW, 1.0), (0.93, LOW, 1.0))], ids=["silence", "too far"])
def test_a_point_without_an_attack_stays(attacks: tuple[tuple[float, OnsetBand, float], ...]) -> None:
    assert snapped(SCORE, BandPoint(0, 1.0), sound(*attacks)) == BandPoint(0, 1.0)


def test_where_nothing_is_written_the_band_itself_is_heard() -> None:
    """On the fourth beat no drum plays: a bass note is what begins there."""
    assert snapped(SCORE, BandPoint(3 * PPQ, 1.0), sound((1.02, LOW, 1.0))).at_s == 1.02


def test_a_nudge_is_in_milliseconds() -> None:
    assert nudged(BandPoint(0, 1.0), -5.0).at_s == pytest.approx(0.995)


def test_taps_count_their_beats_over_forgotten_ones_and_bounces() -> None:
    """At 120: taps on beats 0, 1, 2, 4 (3 forgotten), 5, 6, and one that bounced 80 ms after beat 2; all 30 ms late."""
    taps = [1.03, 1.53, 2.03, 2.11, 3.03, 3.53, 4.03]
    points = points_of_taps(taps, 8 * PPQ, late_s=0.03)
    assert [p.tick // PPQ for p in points] == [8, 9, 10, 12, 13, 14]
    assert [p.at_s for p in points] == pytest.approx([1.0, 1.5, 2.0, 3.0, 3.5, 4.0])


def test_taps_follow_a_band_that_slows_to_half() -> None:
    """Sixty beats from 0.4 to 0.8 s with 25 ms of scatter: none is miscounted."""
    beats = np.cumsum(np.linspace(0.4, 0.8, 60)) + np.random.default_rng(3).normal(0.0, 0.025, 60)
    assert [p.tick // PPQ for p in points_of_taps(beats.tolist(), 0)] == list(range(60))


@pytest.mark.parametrize("taps", [[], [1.0], [2.0, 2.0]])
def test_too_few_taps_are_refused(taps: list[float]) -> None:
    with pytest.raises(BadInput, match="tell no tempo"):
        points_of_taps(taps, 0)
