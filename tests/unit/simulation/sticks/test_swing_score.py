"""From scores and stickings to strokes, against what is written."""

import numpy as np
import pytest

from station.core.pieces import Articulation, Limb, Piece
from station.core.units import PPQ
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.simulation.sticks.swing_score import NOVICE, PROFESSIONAL, PlayerSpec, spec_from_score, spec_from_sticking
from station.simulation.sticks.swing_spec import StrokeKind, speed_for, speed_for_velocity, velocity_for_speed

R, L = Limb.RIGHT_HAND, Limb.LEFT_HAND


def _score(velocities: list[int], limb: Limb = Limb.UNKNOWN) -> Score:
    notes = [Note(i * PPQ, Piece.SNARE, velocity=v, limb=limb) for i, v in enumerate(velocities)]
    return Score.from_notes(notes, TempoMap())


def test_paradiddle_hands_and_times() -> None:
    strokes = spec_from_sticking("RLRR LRLL", every_s=0.125, times=2)
    assert [s.limb for s in strokes] == [R, L, R, R, L, R, L, L] * 2
    assert [s.at_s for s in strokes] == pytest.approx([3 + 0.125 * i for i in range(16)])


def test_flam_grace_comes_early_and_soft() -> None:
    grace, main = spec_from_sticking("lR", every_s=0.5)
    assert (grace.limb, main.limb) == (L, R)
    assert 0.015 <= main.at_s - grace.at_s <= 0.040
    assert 0.25 <= velocity_for_speed(grace.speed_m_s) / velocity_for_speed(main.speed_m_s) <= 0.5


def test_drag_has_two_graces_of_one_hand() -> None:
    first, second, main = spec_from_sticking("llR", every_s=0.5)
    assert (first.limb, second.limb, main.limb) == (L, L, R)
    assert 0.040 <= second.at_s - first.at_s <= 0.070
    assert main.at_s - second.at_s == pytest.approx(second.at_s - first.at_s)


def test_unisons_rests_and_accents() -> None:
    strokes = spec_from_sticking("B - R>", every_s=0.5)
    assert [(s.limb, s.at_s) for s in strokes] == [(R, 3.0), (L, 3.0), (R, 4.0)]
    assert strokes[2].speed_m_s > strokes[0].speed_m_s


def test_heights_of_marching_practice() -> None:
    # p 3 in, f 9 in, fff 15 in
    for velocity, inches in ((49, 3), (96, 9), (127, 15)):
        assert speed_for_velocity(velocity) == pytest.approx(speed_for(inches * 0.0254))


def test_velocity_and_speed_are_each_others_inverse() -> None:
    for velocity in (5, 20, 60, 100, 127):
        assert velocity_for_speed(speed_for_velocity(velocity)) == pytest.approx(velocity)


def test_full_down_tap_up() -> None:
    # loud loud soft soft loud, one hand: full, down, tap, up, full (Moeller's and Stone's four strokes)
    strokes = spec_from_score(_score([112, 112, 40, 40, 112], R))
    assert [s.kind for s in strokes] == [
        StrokeKind.FULL,
        StrokeKind.DOWN,
        StrokeKind.TAP,
        StrokeKind.UP,
        StrokeKind.FULL,
    ]


def test_hands_alternate_where_none_is_written_and_feet_are_left_out() -> None:
    kick = Note(PPQ // 2, Piece.KICK)
    notes = [Note(i * PPQ, Piece.SNARE) for i in range(4)]
    strokes = spec_from_score(Score.from_notes([*notes, kick], TempoMap()))
    assert [s.limb for s in strokes] == [R, L, R, L]


def test_exact_player_plays_what_is_written() -> None:
    score = _score([80] * 8)
    assert [s.at_s for s in spec_from_score(score, start_s=5.0)] == pytest.approx((5.0 + score.onset_s).tolist())


def test_player_is_as_unsteady_as_asked() -> None:
    """Motor noise alone: SD of the asynchrony as given."""
    score = _score([80] * 400)
    played = spec_from_score(score, player=PlayerSpec(clock_share=0, motor_s=0.006, force_share=0), seed=3)
    off = np.array([s.at_s for s in played]) - 3.0 - score.onset_s
    assert off.std() == pytest.approx(0.006, rel=4 / np.sqrt(800))
    assert abs(off.mean()) < 4 * 0.006 / 20


def test_a_click_is_leant_on() -> None:
    """Errors of the clock are taken back: over 400 beats a professional never strays a sixteenth (125 ms)."""
    played = spec_from_score(_score([80] * 400), player=PROFESSIONAL, seed=5)
    off = np.array([s.at_s for s in played]) - 3.0 - 0.5 * np.arange(400)
    assert 0.008 < off.std() < 0.03  # 2–3 % of 500 ms and 4–8 ms of the hands
    assert np.abs(off).max() < 0.125


def test_novice_takes_the_wrong_hand_now_and_then() -> None:
    score = _score([80] * 1000, R)
    wrong = np.mean([s.limb is L for s in spec_from_score(score, player=NOVICE, seed=1)])
    assert wrong == pytest.approx(0.05, abs=4 * np.sqrt(0.05 * 0.95 / 1000))


def test_buzz_lasts_as_written_and_air_is_air() -> None:
    note = Note(0, Piece.SNARE, articulation=Articulation.BUZZ, duration_ticks=PPQ)
    score = Score.from_notes([note], TempoMap())
    (buzz,) = spec_from_score(score)
    assert buzz.kind is StrokeKind.BUZZ
    assert buzz.lasts_s == pytest.approx(0.5)
    (air,) = spec_from_score(score, in_air=True)
    assert air.kind is StrokeKind.AIR
