"""Live judgement without a click: drift, swing and recordings of people, against truths that are known.

The truth of the workload is its generator's (`bench.scoring_work`: which note each stroke was played for).
"""

import numpy as np
import pytest

from station.bench.rigs.scoring_work import WorkPlayer, f1, grooves, play
from station.core.pieces import Piece
from station.core.units import NS_PER_S, PPQ
from station.music.judgement import Label
from station.music.performance import Performance
from station.music.score import Note, Score
from station.scoring.following.follower import Follower
from tests.fakes.scores import swing_ride


def live_pairs(score: Score, performance: Performance, clocked: bool = False) -> list[int]:
    """The note of each hit by the last word on it, −1 for none."""
    follower = Follower(score, clocked=clocked)
    note_of_hit = [-1] * len(performance)
    for hit in performance:
        for verdict in follower.hit(hit, hit.at_ns):
            if verdict.hit_index is not None:
                note = verdict.note_index if verdict.label is Label.MATCH else None
                note_of_hit[verdict.hit_index] = -1 if note is None else note
    return note_of_hit


@pytest.mark.parametrize("drift", [0.0, 0.03, 0.05, 0.08, 0.12])
def test_a_drifting_tempo_is_followed(drift: float) -> None:
    said = []
    for seed in range(3):
        score = grooves(1_000, seed)
        played = play(score, WorkPlayer(drift=drift), seed)
        said.append(f1(np.array(live_pairs(score, played.performance)), played))
    assert float(np.mean(said)) >= 0.995


@pytest.mark.parametrize("tempo", [0.8, 0.9, 1.1, 1.2])
def test_another_tempo_that_drifts_is_followed_from_the_first_bars_on(tempo: float) -> None:
    score = grooves(1_000, 4)
    played = play(score, WorkPlayer(tempo=tempo, drift=0.03), 4)
    assert f1(np.array(live_pairs(score, played.performance)), played) >= 0.99


@pytest.mark.parametrize("per_bar", [0.02, -0.02])
def test_an_accelerando_is_followed(per_bar: float) -> None:
    """2 % a bar for 16 bars: from 120 to 165, or to 87."""
    score = grooves(1, 9).repeated(2)
    bar_s = 2.0
    tempo = 1 + per_bar * np.arange(17)
    starts = np.concatenate(([0.0], np.cumsum(bar_s / tempo)))
    bar = np.minimum((score.onset_s / bar_s).astype(int), 16)
    at_s = starts[bar] + (score.onset_s - bar * bar_s) / tempo[bar]
    at_s = at_s + np.random.default_rng(9).normal(0, 0.01, len(at_s))
    hits = np.zeros(len(score), Performance.from_hits([]).hits.dtype)
    hits["at_ns"], hits["piece"], hits["velocity"] = np.rint(at_s * NS_PER_S), score.notes["piece"], 80
    order = np.argsort(hits["at_ns"], kind="stable")
    said = live_pairs(score, Performance.from_array(hits))
    assert np.mean(np.array(said) == order) >= 0.99


def with_kick(score: Score) -> Score:
    """The score with a kick on every first beat, that tells the bar's halves apart."""
    kicks = [Note(bar * 4 * PPQ, Piece.KICK) for bar in range(score.bar_count)]
    return Score.from_notes([*score, *kicks], score.tempo_map, score.end_tick)


@pytest.mark.parametrize("ratio", [1.0, 1.5, 2.0, 3.0])
def test_whatever_the_swing_the_beat_is_kept(ratio: float) -> None:
    """Written in triplets (2:1), played straight to dotted, 8 % slower than counted in and without a click.

    Offbeats may come 83 ms beside their notes at 120; on the beats nothing may change.
    """
    written, played = with_kick(swing_ride(16)), with_kick(swing_ride(16, round(ratio / (1 + ratio) * PPQ)))
    rng = np.random.default_rng(3)
    hits = np.zeros(len(played), Performance.from_hits([]).hits.dtype)
    hits["at_ns"] = np.rint((played.onset_s / 0.92 + rng.normal(0, 0.008, len(played))) * NS_PER_S)
    hits["piece"], hits["velocity"] = played.notes["piece"], 80
    order = np.argsort(hits["at_ns"], kind="stable")
    said = np.array(live_pairs(written, Performance.from_array(hits)))
    on_beat = (written.notes["tick"] % PPQ == 0)[order]
    assert np.mean(said[on_beat] == order[on_beat]) >= 0.98
