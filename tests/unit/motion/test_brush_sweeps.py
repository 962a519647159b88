"""Brushes: between taps they stay on the snare and sweep in time, each on its own side of the head."""

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.pieces import Limb, Piece, Zone
from station.core.units import PPQ
from station.motion.audit import audit
from station.motion.drummer import Drummer
from station.motion.kinematics import frame
from station.motion.style.style import Style
from station.music.score import Note, Score
from station.music.tempo import TempoMap

Array = NDArray[np.float64]

R, L = Limb.RIGHT_HAND, Limb.LEFT_HAND
BRUSHES = Style(held="brush", variation=0.0)


def jazz(left: bool, tempo_bpm: float = 100) -> Drummer:
    """The right hand taps the swung time on the snare; the left taps 2 and 4 or only sweeps."""
    notes = []
    for bar in range(3):
        for beat in (0.0, 1.0, 5 / 3, 2.0, 3.0, 11 / 3):
            notes.append(Note(round((4 * bar + beat) * PPQ), Piece.SNARE, velocity=60, limb=R))
        if left:
            notes += [Note((4 * bar + beat) * PPQ, Piece.SNARE, velocity=70, limb=L) for beat in (1, 3)]
    return Drummer(Score.from_notes(notes, TempoMap.constant(tempo_bpm)), style=BRUSHES)


def tips(drummer: Drummer, at: Array, limb: Limb) -> tuple[Array, Array]:
    """The tip from the snare's centre (n, 3), and its height over the head (n,)."""
    snare = drummer.kit.pieces[Piece.SNARE]
    away = drummer.rows(at)[:, frame.TIP].reshape(-1, 2, 3)[:, int(limb)] - snare.centre
    return away, away @ snare.normal


def test_an_idle_left_brush_draws_one_oval_a_beat_on_the_head() -> None:
    drummer, beat = jazz(left=False), 0.6
    at = np.arange(2 * beat, 8 * beat, 0.005)
    away, over = tips(drummer, at, L)
    assert np.abs(over).max() < 0.003
    again, _ = tips(drummer, at + beat, L)
    assert again == pytest.approx(away, abs=1e-6)
    assert np.ptp(away[:, 0]) == pytest.approx(0.10, abs=0.005)
    assert np.ptp(away[:, 1]) == pytest.approx(0.08, abs=0.005)
    on_beat, _ = tips(drummer, np.arange(2.0, 8.0) * beat, L)
    assert on_beat[:, 0] == pytest.approx(np.full(6, away[:, 0].max()), abs=1e-6)
    assert np.linalg.norm(away, axis=1).max() < drummer.kit.pieces[Piece.SNARE].radius_m


def test_quick_beats_have_one_oval_for_two() -> None:
    drummer, beat = jazz(left=False, tempo_bpm=200), 0.3
    at = np.arange(2 * beat, 8 * beat, 0.005)
    one, two = (tips(drummer, at + k * beat, L)[0] for k in (1, 2))
    assert two == pytest.approx(tips(drummer, at, L)[0], abs=1e-6)
    assert np.abs(one - two).max() > 0.05


def test_between_taps_the_brush_sweeps_and_each_tap_is_on_its_spot() -> None:
    drummer, beat = jazz(left=True), 0.6
    taps = np.array([1, 3, 5, 7]) * beat
    spots, over = tips(drummer, taps, L)
    assert over == pytest.approx(np.zeros(4), abs=1e-9)
    assert np.ptp(spots, axis=0) == pytest.approx(np.zeros(3), abs=1e-9)
    away, over = tips(drummer, np.arange(taps[1], taps[2], 0.005), L)
    aside = np.linalg.norm((away - spots[0])[:, :2], axis=1) > 0.01
    assert aside.mean() > 0.3  # of the time
    assert np.abs(over[aside]).max() < 0.003
    assert over.max() > 0.03  # and it is raised for the tap


@pytest.mark.parametrize("left", [True, False])
def test_brushes_meet_neither_each_other_nor_the_kit(left: bool) -> None:
    found = audit(jazz(left))
    assert found.hands_m.value == 0.0
    assert found.kit_m.value < 0.003
    assert found.strike_m.value < 1e-6
    assert found.limit_rad.value < 0.02
    assert found.speed.value < 1.0
    at = np.arange(0.0, 7.0, 0.01)
    drummer = jazz(left)
    assert (tips(drummer, at, L)[0][:, 0] < tips(drummer, at, R)[0][:, 0]).all()


def test_one_instant_and_many_agree_and_sticks_do_not_sweep() -> None:
    drummer, at = jazz(left=True), np.linspace(-0.5, 6.0, 66)
    rows = drummer.rows(at)
    assert np.array([drummer.pose(t).tip_m.ravel() for t in at.tolist()]) == pytest.approx(rows[:, frame.TIP], abs=1e-9)
    with_sticks = Drummer(drummer.score)
    away, _ = tips(with_sticks, np.arange(1.9, 2.2, 0.01), L)
    assert np.ptp(away[:, 0]) < 0.02


def test_a_brush_that_rides_a_cymbal_does_not_sweep_in_the_air() -> None:
    notes = [Note(i * PPQ, Piece.RIDE, Zone.BOW, 80, limb=R) for i in range(8)]
    drummer = Drummer(Score.from_notes(notes, TempoMap.constant(60)), style=BRUSHES)
    x = drummer.rows(np.arange(2.15, 2.5, 0.01))[:, frame.TIP.start]
    assert np.ptp(x) < 0.03
