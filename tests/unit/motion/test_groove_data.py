"""Limbs on recordings of the Groove MIDI Dataset, against the thesis' own algorithm and every other choice of hands.

What is counted here, and the fewest impossible places that any choice leaves, are worked out by code of their own.
"""

from pathlib import Path

import numpy as np
import pytest

from station.core.pieces import Limb, Piece
from station.motion.kit.kit import load_kit
from station.motion.sticking.limbs import METHODS, assign_limbs
from station.motion.strokes.targets import strike_points
from station.music.formats.smf.standard_midi import read_midi, score_from_midi
from station.music.score import Score
from tests.real_data import DATA, real_files

KIT = load_kit("four_piece")
AT_ONCE_S = (0.005, 0.01, 0.025, 0.05)
"""An outsider may call any of these "at once"."""
RECENT_S = 0.6
MARGIN_M, FAR_M = 0.03, 0.60


def hand_rows(score: Score) -> np.ndarray:
    """The strokes that hands make, in order of time."""
    order = np.argsort(score.onset_ns, kind="stable")
    return order[~np.isin(score.notes["piece"][order], (Piece.KICK, Piece.HIHAT_PEDAL))]


def pieces_of(score: Score, rows: np.ndarray) -> list[int]:
    return [int(KIT.stand_in(Piece(p))) for p in score.notes["piece"][rows]]


def impossible(times: list[float], pieces: list[int], hands: list[int], at_once_s: float) -> int:
    """Strokes whose hand struck another piece a moment before."""
    last: dict[int, int] = {}
    count = 0
    for i, hand in enumerate(hands):
        before = last.get(hand)
        count += before is not None and times[i] - times[before] < at_once_s and pieces[before] != pieces[i]
        last[hand] = i
    return count


def fewest_impossible(times: list[float], pieces: list[int], at_once_s: float) -> int:
    """The least that any assignment leaves: over all hands, by what each struck last within the moment."""
    least: dict[tuple[int, int], int] = {(-1, -1): 0}
    for i, now in enumerate(times):
        after: dict[tuple[int, int], int] = {}
        for lasts, count in least.items():
            for hand in (0, 1):
                own, other = lasts[hand], lasts[1 - hand]
                bad = own >= 0 and now - times[own] < at_once_s and pieces[own] != pieces[i]
                other = other if other >= 0 and now - times[other] < at_once_s else -1
                state = (i, other) if hand == 0 else (other, i)
                after[state] = min(after.get(state, len(times)), count + bad)
        least = after
    return min(least.values())


def crossings_and_travel(score: Score, limbs: np.ndarray) -> np.ndarray:
    """Crossings that are not home posture, those of arms, and metres between the spots that a hand strikes in turn."""
    points, rows = strike_points(score, KIT, limbs), hand_rows(score)
    crossings, far, travel = 0, 0, 0.0
    last: dict[int, tuple[float, int, np.ndarray]] = {}
    for i, piece in zip(rows.tolist(), pieces_of(score, rows), strict=True):
        limb, at, point = int(limbs[i]), float(score.onset_s[i]), points[i]
        if limb in last:
            travel += float(np.linalg.norm(point - last[limb][2]))
        other = last.get(1 - limb)
        if other is not None and at - other[0] < RECENT_S:
            over = (other[2][0] - point[0]) * (1 if limb == Limb.RIGHT_HAND else -1)
            right, left = (piece, other[1]) if limb == Limb.RIGHT_HAND else (other[1], piece)
            crossings += over > MARGIN_M and (right, left) != (Piece.HIHAT, Piece.SNARE)
            far += over > FAR_M
        last[limb] = (at, piece, point)
    return np.array([crossings, far, travel])


@pytest.mark.parametrize("path", real_files("gmd/**/*.mid")[::2])
def test_no_hand_is_in_two_places_where_another_way_exists(path: Path) -> None:
    score = score_from_midi(read_midi(path))
    rows = hand_rows(score)
    times, pieces = score.onset_s[rows].tolist(), pieces_of(score, rows)
    ours = assign_limbs(score, KIT)
    smed = assign_limbs(score, KIT, "smed")
    for at_once_s in AT_ONCE_S:
        found = impossible(times, pieces, ours.limbs[rows].tolist(), at_once_s)
        assert found == fewest_impossible(times, pieces, at_once_s)
        assert found <= impossible(times, pieces, smed.limbs[rows].tolist(), at_once_s)
    feet = np.isin(score.notes["piece"], (Piece.KICK, Piece.HIHAT_PEDAL))
    assert (np.isin(ours.limbs, (Limb.RIGHT_FOOT, Limb.LEFT_FOOT)) == feet).all()
    assert all(ours.why)


def test_ours_crosses_and_travels_less_than_smed() -> None:
    """Over every third file, where `smed` has one crossing of arms; `benchmarks/gmd_limbs.py` counts over all."""
    totals = {method: np.zeros(3) for method in METHODS}
    for path in sorted((DATA / "gmd").rglob("*.mid"))[::3]:
        score = score_from_midi(read_midi(path))
        for method in METHODS:
            totals[method] += crossings_and_travel(score, assign_limbs(score, KIT, method).limbs)
    assert (totals["station"] <= totals["smed"]).all()
    assert totals["station"][0] < totals["smed"][0]
