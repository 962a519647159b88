"""The head's cofactors, worked by hand from the thesis' words (§ 4.2.1, figure 4.13)."""

from collections.abc import Sequence

import numpy as np
import pytest

from station.core.pieces import Piece
from station.core.units import PPQ
from station.motion.body.beats import LEAD_IN_BEATS, SILENT_BOB, Beats, bob_cofactors, restarts
from station.music.score import Note, Score
from station.music.tempo import MeterChange, TempoChange, TempoMap

BEATS = np.array([0.0, 1.0, 2.0, 3.0])


def cofactor(onsets: Sequence[tuple[float, float, Piece]], beat: int = 1) -> float:
    times, velocities, pieces = (np.array(column) for column in zip(*sorted(onsets), strict=True))
    bob = bob_cofactors(BEATS, times, velocities.astype(float), pieces.astype(np.uint8))
    return float(bob[beat])


def test_one_stroke_on_the_beat_counts_its_velocity_and_ten_per_cent() -> None:
    assert cofactor([(1.0, 127, Piece.KICK)]) == pytest.approx(1.1)


def test_two_strokes_count_their_mean_and_twenty_per_cent() -> None:
    assert cofactor([(1.01, 127, Piece.KICK), (0.99, 63.5, Piece.CRASH_1)]) == pytest.approx(0.75 * 1.2)


def test_hats_and_ride_do_not_count_for_the_velocity() -> None:
    alone = cofactor([(1.0, 127, Piece.KICK)])
    assert cofactor([(1.0, 127, Piece.KICK), (1.0, 20, Piece.HIHAT), (1.0, 20, Piece.RIDE)]) == pytest.approx(alone)


def test_a_stroke_outside_the_strike_range_is_not_on_the_beat() -> None:
    """Nor does it fill both sides: the other side's rest keeps the density cofactor at 1."""
    assert cofactor([(1.03, 127, Piece.KICK)]) == pytest.approx(SILENT_BOB)


def test_density_is_the_weighed_sum_of_the_rests_of_the_freer_side() -> None:
    """Onsets at 1.25 and 0.75 divide both sides at half: Σ wᵢ/(1 + 1.5 i)/w = .225/.475 + .25/(2.5·.475)."""
    strokes = [(1.0, 127, Piece.KICK), (1.25, 80, Piece.HIHAT), (0.75, 80, Piece.HIHAT)]
    near = 0.225 / 0.475 + 0.25 / 2.5 / 0.475
    assert cofactor(strokes) == pytest.approx(1.1 * near)


def test_the_freer_side_decides() -> None:
    crowded = [(1.0, 127, Piece.KICK), (1.1, 80, Piece.HIHAT), (1.2, 80, Piece.HIHAT), (1.3, 80, Piece.HIHAT)]
    assert cofactor(crowded) == pytest.approx(1.1)  # nothing before the beat


def test_rests_near_the_beat_weigh_more_than_those_far_from_it() -> None:
    late = [(1.0, 127, Piece.KICK), (1.45, 80, Piece.HIHAT), (0.55, 80, Piece.HIHAT)]
    early = [(1.0, 127, Piece.KICK), (1.05, 80, Piece.HIHAT), (0.95, 80, Piece.HIHAT)]
    assert cofactor(late) > cofactor(early)


def test_beats_follow_tempo_and_meter() -> None:
    """Two bars of 3/4 at 120 bpm, then at 60: beats half a second and then a second apart."""
    tempo_map = TempoMap.build([TempoChange(0, 500_000), TempoChange(6 * PPQ, 1_000_000)], [MeterChange(0, 3, 4)])
    score = Score.from_notes([Note(0, Piece.KICK), Note(8 * PPQ, Piece.KICK)], tempo_map)
    beats = Beats.of(score)
    inside = beats.time_s[LEAD_IN_BEATS:]
    assert inside[:9].tolist() == pytest.approx([0, 0.5, 1, 1.5, 2, 2.5, 3, 4, 5])
    assert np.diff(beats.time_s[: LEAD_IN_BEATS + 1]) == pytest.approx(0.5)  # the count-in at the first tempo
    assert beats.in_bar[: LEAD_IN_BEATS + 7].tolist() == [1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0]
    assert set(beats.of_bar.tolist()) == {3}
    assert beats.rate_bpm[[LEAD_IN_BEATS, LEAD_IN_BEATS + 6]] == pytest.approx([120, 60])


@pytest.mark.parametrize(
    ("beats", "unit", "felt_s", "felt"), [(6, 8, 0.75, 2), (12, 8, 0.75, 4), (3, 8, 0.25, 3), (7, 8, 0.25, 7)]
)
def test_compound_meters_are_felt_in_groups_of_three(beats: int, unit: int, felt_s: float, felt: int) -> None:
    """At 120 quarters a minute an eighth lasts 0.25 s."""
    tempo_map = TempoMap.build([TempoChange(0, 500_000)], [MeterChange(0, beats, unit)])
    found = Beats.of(Score.from_notes([Note(0, Piece.KICK), Note(7 * PPQ, Piece.KICK)], tempo_map))
    assert np.diff(found.time_s)[: LEAD_IN_BEATS + 2] == pytest.approx(felt_s)
    assert set(found.of_bar.tolist()) == {felt}


def test_a_meter_with_groups_is_felt_by_them() -> None:
    """7/8 as 3+2+2 at 120 quarters a minute: 0.75, 0.5 and 0.5 s."""
    tempo_map = TempoMap.build([TempoChange(0, 500_000)], [MeterChange(0, 7, 8, (3, 2, 2))])
    found = Beats.of(Score.from_notes([Note(0, Piece.KICK), Note(7 * PPQ, Piece.KICK)], tempo_map))
    assert found.time_s[LEAD_IN_BEATS : LEAD_IN_BEATS + 5] == pytest.approx([0.0, 0.75, 1.25, 1.75, 2.5])
    assert found.in_bar[LEAD_IN_BEATS : LEAD_IN_BEATS + 5].tolist() == [0, 1, 2, 0, 1]


def test_music_starts_again_after_two_silent_beats() -> None:
    beats = np.arange(10.0)
    assert np.flatnonzero(restarts(beats, np.array([1.0, 1.5, 2.0, 4.0, 7.5]))).tolist() == [1, 7]
    assert not restarts(beats, np.zeros(0)).any()
