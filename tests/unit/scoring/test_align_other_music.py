"""Alignment without a click on music of every kind. The truth is how the hits were made."""

import numpy as np
import pytest

from station.bench.rigs.scoring_music import KINDS, music
from station.bench.rigs.scoring_work import WorkPlayer, f1, play
from station.music.judgement import Label
from station.music.score import Score
from station.scoring.align import align


def f1_of(score: Score, player: WorkPlayer, seed: int) -> float:
    taken = play(score, player, seed)
    result = align(score, taken.performance, clocked=False)
    return f1(np.where(result.hit_label == Label.MATCH, result.note_of_hit, -1), taken)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", [0, 1])
def test_a_player_who_sways(kind: str, seed: int) -> None:
    """3 % of drift, 15 ms of noise, 3 % left out, 3 % added: ten times the oracle's loss is allowed."""
    assert f1_of(music(kind, 400, seed), WorkPlayer(), seed) > 0.98


TOO_MUCH = ("ballad", "thirty_seconds")
"""Within one wait of a ballad the tempo changes by 2 %, and 32nds wander by half their distance: nobody is sure."""


@pytest.mark.parametrize("kind", [kind for kind in KINDS if kind not in TOO_MUCH])
def test_a_player_who_sways_by_an_eighth(kind: str) -> None:
    assert f1_of(music(kind, 1000), WorkPlayer(drift=0.12), 3) > 0.98


@pytest.mark.parametrize("tempo", [0.6, 1.4])
def test_bars_that_are_all_alike_at_another_tempo(tempo: float) -> None:
    assert f1_of(music("alike", 400), WorkPlayer(tempo=tempo, start_s=3.0), 1) > 0.98
