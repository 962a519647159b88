"""A student in a form of its own, stroke by stroke. Bounds are four standard errors, as in test_virtual_student."""

import math
from dataclasses import replace

import numpy as np
import pytest

from station.core.pieces import Piece
from station.music.judgement import Label
from station.simulation.student_form import form_of, sd_in, usual_wait_ms
from station.simulation.student_spec import parse_spec
from station.simulation.virtual_student import VirtualStudent
from tests.fakes import scores


def test_the_spread_may_change_within_a_score() -> None:
    score, spec = scores.even_snare(6000, 300), parse_spec("seed=1")
    sd_ms = np.repeat([5.0, 25.0], 3000)
    bias_ms = np.repeat([10.0, -10.0], 3000)
    played = VirtualStudent(spec).play(score, replace(form_of(spec, score), sd_ms=sd_ms, bias_ms=bias_ms))
    for half, sd, bias in zip(np.split(played.asynchrony_ms(), 2), (5.0, 25.0), (10.0, -10.0), strict=True):
        assert abs(half.std() - sd) < 4 * sd * math.sqrt(1.29 / 6000)
        assert abs(half.mean() - bias) < 4 * sd * math.sqrt(2.58 / 3000)


def test_only_the_rows_that_may_be_missed_are() -> None:
    score, spec = scores.rock_beat(10), parse_spec("seed=1")
    snare = score.notes["piece"] == Piece.SNARE
    played = VirtualStudent(spec).play(score, replace(form_of(spec, score), miss=np.where(snare, 1.0, 0.0)))
    assert ((played.truth.note_label == Label.MISS) == snare).all()


def test_swapped_cables_make_right_strokes_wrong() -> None:
    score, spec = scores.beat_and_fill(2), parse_spec("seed=1")
    wires = {Piece.TOM_1: Piece.TOM_2, Piece.TOM_2: Piece.TOM_1}
    played = VirtualStudent(spec).play(score, replace(form_of(spec, score), wires=wires))
    swapped = np.isin(score.notes["piece"], list(wires))
    assert swapped.sum() == 8  # two strokes on either tom, twice
    assert ((played.truth.note_label == Label.WRONG_PIECE) == swapped).all()
    reported = played.performance.hits["piece"][played.truth.hit_of_note[swapped]]
    assert [wires[Piece(p)] for p in score.notes["piece"][swapped]] == reported.tolist()


@pytest.mark.parametrize(("interval_ms", "sd_ms"), [(100, 5.0), (400, 18.0), (2000, 60.0)])
def test_a_named_players_spread_has_a_floor_and_a_ceiling(interval_ms: int, sd_ms: float) -> None:
    """4.5 % of 400 ms is 18; of 100 ms less than motor noise allows; of 2000 ms is counted out."""
    score = scores.even_snare(10, interval_ms)
    assert usual_wait_ms(score) == pytest.approx(interval_ms)
    assert sd_in(score, parse_spec("intermediate")) == pytest.approx(sd_ms)
