"""Mallets, brushes and bare hands by anatomy: what reaches the drum, where it is held, what the hand stays over.

A hand is 0.108 of the stature from the wrist to the fingertips (Winter; Drillis and Contini); the others' lengths are
those of what is held.
"""

from dataclasses import replace
from math import radians

import numpy as np
import pytest

from station.core.pieces import Limb, Piece, Zone
from station.core.units import PPQ
from station.motion.audit import audit
from station.motion.drummer import Drummer
from station.motion.kinematics import frame
from station.motion.kinematics.figure import Joint, figure_of
from station.motion.kit.kit import load_kit
from station.motion.style.style import Style
from station.music.score import Note, Score
from station.music.tempo import TempoMap

HELD = ("brush", "mallet", "hand")
STICK_M = {"brush": 0.84 * 0.406, "mallet": 0.96 * 0.406}
"""A 5A stick is 406 mm; of a brush and a mallet the shares that are documented with them."""
HANDS = (Joint.RIGHT_HAND, Joint.LEFT_HAND)
WRISTS = (Joint.RIGHT_WRIST, Joint.LEFT_WRIST)


def drummer(held: str, stature_m: float = 1.759) -> Drummer:
    """Round the drums hand to hand, right on the right ones, in eighths at 100 bpm."""
    notes = [
        Note(i * PPQ // 2, piece, Zone.HEAD, 60 + 8 * i, limb=Limb.LEFT_HAND if i % 2 else Limb.RIGHT_HAND)
        for i, piece in enumerate((Piece.SNARE, Piece.SNARE, Piece.TOM_2, Piece.TOM_1, Piece.FLOOR_TOM_1, Piece.SNARE))
    ]
    score = Score.from_notes(notes, TempoMap.constant(100))
    return Drummer(score, load_kit(), figure_of(stature_m=stature_m), replace(Style(), held=held))


def at_strikes(played: Drummer) -> list[tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, Piece]]:
    """Tip, butt, hand and wrist of the hand that strikes, and the piece, at every strike."""
    found = []
    for k, time_s in enumerate(played.score.onset_s.tolist()):
        row, side = played.rows(np.array([time_s]))[0], int(played.assignment.limbs[k])
        joints = row[frame.JOINTS].reshape(-1, 3)
        tip, butt = (row[part].reshape(2, 3)[side] for part in (frame.TIP, frame.BUTT))
        found.append((tip, butt, joints[HANDS[side]], joints[WRISTS[side]], Piece(played.score.notes["piece"][k])))
    return found


@pytest.mark.parametrize("stature_m", [1.6, 1.759, 1.95])
@pytest.mark.parametrize("held", HELD)
def test_its_end_is_on_the_head_inside_the_rim_and_the_hand_over_it(held: str, stature_m: float) -> None:
    played = drummer(held, stature_m)
    for tip, _, hand, wrist, piece in at_strikes(played):
        drum = played.kit.pieces[played.kit.stand_in(piece)]
        away = tip - drum.centre
        assert abs(away @ drum.normal) <= 0.001, piece
        assert np.linalg.norm(away) < drum.radius_m, piece
        assert (hand - drum.centre) @ drum.normal > 0.0, piece
        assert (wrist - drum.centre) @ drum.normal > 0.0, piece


@pytest.mark.parametrize("held", ["brush", "mallet"])
def test_it_is_held_near_its_butt_at_its_own_length(held: str) -> None:
    for tip, butt, hand, _, _ in at_strikes(drummer(held)):
        assert np.linalg.norm(tip - butt) == pytest.approx(STICK_M[held], abs=1e-4)
        along = (hand - butt) @ (tip - butt) / STICK_M[held] ** 2
        assert 0.2 < along < 0.4
        assert np.linalg.norm(hand - (butt + along * (tip - butt))) < 1e-6


@pytest.mark.parametrize("stature_m", [1.6, 1.759, 1.95])
def test_a_bare_hand_is_as_long_as_a_hand(stature_m: float) -> None:
    for tip, _, _, wrist, _ in at_strikes(drummer("hand", stature_m)):
        reach = float(np.linalg.norm(tip - wrist))
        assert 0.95 * 0.108 * stature_m < reach <= 0.108 * stature_m + 1e-6  # fingers bend a little against the palm


@pytest.mark.parametrize("held", HELD)
def test_nothing_passes_through_and_no_joint_is_bent_too_far(held: str) -> None:
    found = audit(drummer(held))
    assert found.kit_m.value <= 0.003, found.kit_m
    assert found.hands_m.value <= 0.003, found.hands_m
    assert found.limit_rad.value <= radians(1.5), found.limit_rad
    assert found.speed.value <= 1.0, found.speed
    assert found.strike_m.value <= 0.001, found.strike_m
