"""What holds for any score: strokes on their drums, limbs optimal on small scores, time spent in proportion."""

from collections.abc import Sequence
from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from station.core.pieces import Articulation, Limb, Piece, Zone
from station.core.units import PPQ
from station.motion.drummer import Drummer
from station.motion.kinematics import frame
from station.motion.kinematics.collisions import collisions
from station.motion.kit.kit import load_kit
from station.motion.sticking import hand_costs as price
from station.motion.sticking.hand_notes import HandNotes, Hands
from station.motion.sticking.limbs import assign_limbs
from station.motion.strokes.targets import Strike, target_of
from station.motion.style.style import Style
from station.music.score import Note, Score
from station.music.tempo import TempoMap

PIECES = (Piece.SNARE, Piece.HIHAT, Piece.RIDE, Piece.CRASH_1, Piece.TOM_1, Piece.FLOOR_TOM_1, Piece.KICK)
ZONES = {Piece.HIHAT: Zone.BOW, Piece.RIDE: Zone.BOW, Piece.CRASH_1: Zone.EDGE}
KIT = load_kit("four_piece")


STEPS = (PPQ // 8, PPQ // 4, PPQ // 3, PPQ // 2, PPQ, 3 * PPQ)
TEMPOS = (60, 100, 140, 200)


@st.composite
def scores(draw: st.DrawFn, most: int = 16, steps: tuple[int, ...] = STEPS, tempos: tuple[int, ...] = TEMPOS) -> Score:
    notes = []
    tick = 0
    for _ in range(draw(st.integers(1, most))):
        piece = draw(st.sampled_from(PIECES))
        articulation = Articulation.NORMAL
        if piece is Piece.SNARE:
            articulation = draw(st.sampled_from((Articulation.NORMAL, Articulation.RIM_SHOT, Articulation.CROSS_STICK)))
        zone = ZONES.get(piece, Zone.RIM if articulation is Articulation.CROSS_STICK else Zone.HEAD)
        notes.append(Note(tick, piece, zone, draw(st.integers(1, 127)), articulation))
        tick += draw(st.sampled_from(steps))
    return Score.from_notes(notes, TempoMap.constant(draw(st.sampled_from(tempos))))


@given(scores())
@settings(max_examples=15)
def test_every_tip_stroke_is_on_its_drum_and_no_stick_in_one(score: Score) -> None:
    drummer = Drummer(score, KIT, style=Style(variation=0.0))  # which scatters the places too
    limbs = drummer.assignment.limbs
    rows = drummer.rows(score.onset_s)
    for i, note in enumerate(score):
        limb = Limb(limbs[i])
        if not limb.is_hand:
            continue
        target = target_of(KIT, Strike(note.piece, note.zone, note.articulation, limb))
        if target.shoulder or note.articulation is Articulation.CROSS_STICK:
            continue
        tip = rows[i, frame.TIP].reshape(2, 3)[int(limb)]
        assert np.linalg.norm(tip - target.point_m) < 1e-6
    at = np.arange(-1.0, float(score.onset_s[-1]) + 1.0, 1 / 240)
    for piece, found in collisions(drummer.rows(at), KIT, drummer.figure.stature_m).pieces.items():
        assert found.max() <= 0.003, piece


def cost_of(notes: HandNotes, hands: Sequence[int]) -> float:
    """What it costs that `hands`, one a note in order of time, play `notes`, each note by its prices."""
    last, doubled, cost = [-1, -1], [False, False], 0.0
    for i, hand in enumerate(hands):
        own = last[hand]
        cost += sum(price.alone(notes, i, hand)) + sum(price.beside(notes, i, hand, last[1 - hand]))
        cost += sum(price.after_own(notes, i, hand, own, doubled[hand]))
        last[hand], doubled[hand] = i, price.is_double(notes, i, own)
    return cost


@given(scores(most=9), st.sampled_from(list(Hands)))
@settings(max_examples=30)
def test_hands_are_the_cheapest_there_are_on_small_scores(score: Score, hands: Hands) -> None:
    """Against every assignment of hands to the notes, by the same prices."""
    rows = np.flatnonzero(score.notes["piece"] != Piece.KICK)
    if not len(rows):
        return
    notes = HandNotes.of(score, KIT, rows, hands)
    chosen = assign_limbs(score, KIT, hands=hands).limbs[rows][notes.order]
    best = min(cost_of(notes, each) for each in product((0, 1), repeat=len(rows)))
    assert cost_of(notes, chosen.tolist()) == pytest.approx(best)


@given(scores(steps=(PPQ, 3 * PPQ), tempos=(60, 100)))
@settings(max_examples=12)
def test_nothing_jumps_where_a_human_has_the_time(score: Score) -> None:
    """No joint moves faster than the hand of the measured full stroke does twice over (HUMANS: 3.2 m/s)."""
    drummer = Drummer(score, KIT)
    at = np.arange(-1.0, float(score.onset_s[-1]) + 1.0, 1 / 480)
    joints = drummer.rows(at)[:, frame.JOINTS].reshape(-1, 21, 3)
    speed = np.linalg.norm(np.diff(joints, axis=0), axis=2).max() * 480
    assert speed < 6.4
