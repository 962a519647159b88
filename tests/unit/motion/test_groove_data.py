"""Limbs on every file of the Groove MIDI Dataset that is here, against the thesis' own algorithm."""

from functools import cache
from pathlib import Path

import numpy as np
import pytest

from station.core.pieces import Limb, Piece
from station.motion.contacts import strike_points
from station.motion.kit import load_kit
from station.motion.limbs import METHODS, assign_limbs
from station.music.formats.smf import read_midi, score_from_midi
from station.music.score import Score

DATA = Path("../shared/data/gmd")
KIT = load_kit("four_piece")
TOGETHER_S = 0.025
RECENT_S = 0.6
MARGIN_M = 0.08

needs_data = pytest.mark.skipif(not DATA.exists(), reason="../shared/data/gmd is not here")


@cache
def scores() -> tuple[tuple[str, Score], ...]:
    return tuple((path.name, score_from_midi(read_midi(path))) for path in sorted(DATA.rglob("*.mid")))


def counts(score: Score, limbs: np.ndarray) -> tuple[int, int, float]:
    """Hands asked for two places at once, crossings that are not home posture, and metres between spots."""
    points = strike_points(score, KIT, limbs)
    impossible, crossings, travel = 0, 0, 0.0
    last: dict[int, tuple[float, Piece, np.ndarray]] = {}
    for i in np.argsort(score.onset_ns, kind="stable").tolist():
        limb, at, point = int(limbs[i]), float(score.onset_s[i]), points[i]
        if limb not in (Limb.RIGHT_HAND, Limb.LEFT_HAND):
            continue
        piece = KIT.stand_in(Piece(score.notes["piece"][i]))
        if limb in last:
            impossible += at - last[limb][0] < TOGETHER_S and last[limb][1] is not piece
            travel += float(np.linalg.norm(point - last[limb][2]))
        other = last.get(1 - limb)
        if other is not None and at - other[0] < RECENT_S:
            over = (other[2][0] - point[0]) * (1 if limb == Limb.RIGHT_HAND else -1)
            right, left = (piece, other[1]) if limb == Limb.RIGHT_HAND else (other[1], piece)
            crossings += over > MARGIN_M and (right, left) != (Piece.HIHAT, Piece.SNARE)
        last[limb] = (at, piece, point)
    return impossible, crossings, travel


@needs_data
def test_ours_is_never_less_possible_than_smed_and_crosses_and_travels_less() -> None:
    totals = {method: np.zeros(3) for method in METHODS}
    for name, score in scores():
        each = {method: counts(score, assign_limbs(score, KIT, method).limbs) for method in METHODS}
        assert each["station"][0] <= each["smed"][0], name
        for method in METHODS:
            totals[method] += each[method]
    assert totals["station"][1] < totals["smed"][1]
    assert totals["station"][2] < totals["smed"][2]


@needs_data
def test_every_note_has_a_limb_that_can_play_it_and_a_reason() -> None:
    for name, score in scores():
        assignment = assign_limbs(score, KIT)
        feet = np.isin(score.notes["piece"], (Piece.KICK, Piece.HIHAT_PEDAL))
        assert (np.isin(assignment.limbs, (Limb.RIGHT_FOOT, Limb.LEFT_FOOT)) == feet).all(), name
        assert all(assignment.why), name
