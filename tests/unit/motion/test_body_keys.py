import numpy as np
import pytest

from station.core.pieces import Piece
from station.core.units import PPQ
from station.motion.body.body_keys import limited, mean_bearing
from station.motion.drummer import Drummer
from station.motion.kinematics.figure import Joint
from station.motion.kinematics.frame import ANGLES, JOINTS
from station.motion.kinematics.pose import ANGLE_NAMES
from station.motion.style.style import Style
from station.music.score import Note, Score
from station.music.tempo import MeterChange, TempoChange, TempoMap
from tests.unit.motion.patterns import ROCK, score_of

RNG = np.random.default_rng(7)


def plain(**controls: float) -> Style:
    """The beat alone: no chance, no phrase, no fills, no glances, but for `controls`."""
    return Style(**{"variation": 0.0, "phrase": 0.0, "fill_lean": 0.0, "look_around": 0.0, **controls})  # type: ignore[arg-type] # numbers only


def angle(drummer: Drummer, name: str, at: np.ndarray) -> np.ndarray:
    return drummer.rows(at)[:, ANGLES.start + ANGLE_NAMES.index(name)]


def test_the_speed_ceiling_holds_and_gentle_turns_stay() -> None:
    times = np.sort(RNG.uniform(0, 60, 400))
    wild = RNG.uniform(-1, 1, 400)
    turned = limited(times, wild, np.full(400, 0.8))
    assert (np.abs(np.diff(turned)) <= 0.8 * np.diff(times) + 1e-9).all()
    gentle = 0.3 * np.sin(times)
    assert limited(times, gentle, np.full(400, 0.8)) == pytest.approx(gentle)


def test_the_ceiling_looks_ahead() -> None:
    times = np.array([0.0, 1.0, 2.0, 3.0])
    turned = limited(times, np.array([0.0, 0.0, 1.0, 1.0]), np.full(4, 0.5))
    assert turned[1] > 0.1  # it has begun to turn a second before
    assert turned.tolist() == pytest.approx([0.0, 0.25, 0.75, 1.0])


def test_both_hands_at_once_face_between_them() -> None:
    strikes = np.repeat(np.arange(0, 6, 0.5), 2)
    facing = mean_bearing(np.array([2.0, 3.25]), strikes, np.tile([0.4, -0.2], 12))
    assert facing == pytest.approx([0.1, 0.1])


def test_in_a_long_rest_the_torso_turns_back() -> None:
    facing = mean_bearing(np.array([0.0, 5.0, 10.0]), np.array([0.0, 10.0]), np.array([0.5, 0.5]))
    assert facing[1] == pytest.approx(0.0)
    assert min(facing[0], facing[2]) > 0.3


def test_alternating_pieces_are_faced_in_the_middle() -> None:
    strikes = np.arange(0, 10, 0.25)
    bearing = np.where(np.arange(len(strikes)) % 2 == 0, 0.5, -0.5)
    assert np.abs(mean_bearing(np.arange(2.0, 8.0, 0.5), strikes, bearing)).max() < 0.12


def test_a_higher_frequency_falls_later_onto_the_beat() -> None:
    """Where half of the fall is done: in its middle when round, 150 ms before the beat at 100 bpm."""
    score = score_of([(4 * i, Piece.SNARE) for i in range(16)])
    at = 4.8 + np.arange(-0.5, 0.001, 0.001)
    left = []
    for frequency in (0.0, 25.0, 50.0, 75.0, 100.0):
        lean = angle(Drummer(score, style=plain(frequency_back=frequency)), "torso_lean", at)
        top = int(np.argmin(lean))
        left.append(4.8 - float(np.interp(0.5 * (lean[top] + lean[-1]), lean[top:], at[top:])))
    assert left[2] == pytest.approx(0.15, abs=0.005)
    assert (np.diff(left) < -0.02).all()
    assert left[-1] < 0.1


def test_the_back_sways_forward_on_the_beat_and_up_between() -> None:
    drummer = Drummer(score_of([(4 * i, p) for i in range(32) for p in (1,)], tempo_bpm=100), style=plain())  # type: ignore[misc]
    beats = 0.6 * np.arange(4, 20)
    on, between = angle(drummer, "torso_lean", beats), angle(drummer, "torso_lean", beats + 0.3)
    assert (on - between).min() > np.radians(2.0)


def test_above_130_bpm_it_sways_in_half_time() -> None:
    drummer = Drummer(score_of(ROCK * 1, tempo_bpm=150), style=plain())
    lean = angle(drummer, "torso_lean", 0.4 * np.arange(4))
    assert lean[0] > lean[1] + np.radians(1.5)
    assert lean[2] > lean[1] + np.radians(1.5)


@pytest.mark.parametrize("ceiling", [20.0, 60.0])
def test_the_torso_turns_no_faster_than_its_ceiling(ceiling: float) -> None:
    """Measured on the angles, through a tempo change, between the crash on the left and the floor tom on the right."""
    notes = [Note(4 * i * PPQ, p) for i in range(24) for p in ((Piece.FLOOR_TOM_1,) if i % 2 else (Piece.CRASH_1,))]
    tempo_map = TempoMap.build([TempoChange(0, 500_000), TempoChange(32 * PPQ, 250_000)], [MeterChange(0, 4, 4)])
    drummer = Drummer(Score.from_notes(notes, tempo_map), style=plain(amplitude_twist=100, twist_deg_s=ceiling))
    at = np.arange(-1.0, 33.0, 0.005)
    speed = np.degrees(np.abs(np.diff(angle(drummer, "torso_twist", at)))) / 0.005
    assert 0.5 * ceiling < speed.max() <= 1.001 * ceiling


def test_half_time_keeps_to_the_bar() -> None:
    """In 3/4 at 180 bpm the body goes forward on the first beat alone, in every bar."""
    tempo_map = TempoMap.build([TempoChange(0, 333_333)], [MeterChange(0, 3, 4)])
    drummer = Drummer(Score.from_notes([Note(i * PPQ, Piece.SNARE) for i in range(24)], tempo_map), style=plain())
    lean = angle(drummer, "torso_lean", np.arange(24) / 3).reshape(8, 3)
    assert (lean[1:, 0] > lean[1:, 1:].max(axis=1) + np.radians(2)).all()


def test_the_body_sways_from_side_to_side_with_the_beat() -> None:
    drummer = Drummer(score_of(ROCK), style=plain(amplitude_side=80))
    side = angle(drummer, "torso_side", 0.6 * np.arange(4))
    assert (np.abs(side) > np.radians(2)).all()
    assert (side[1:] * side[:-1] < 0).all()


def test_the_head_tilts_from_side_to_side() -> None:
    on, off = (Drummer(score_of(ROCK), style=plain(amplitude_head_side=a, amplitude_gaze=0)) for a in (80.0, 0.0))
    tilt = angle(on, "head_tilt", 0.6 * np.arange(4)) - angle(off, "head_tilt", 0.6 * np.arange(4))
    assert (np.abs(tilt) > np.radians(5)).all()
    assert (tilt[1:] * tilt[:-1] < 0).all()


def test_the_head_bobs_on_every_other_beat_where_it_is_told() -> None:
    score = score_of([(4 * i, Piece.SNARE) for i in range(16)])
    slow = Drummer(score, style=plain(bobs_per_beat=0.5, amplitude_gaze=0))
    nod = angle(slow, "head_nod", 0.6 * np.arange(16)).reshape(8, 2)
    assert (nod[:, 0] > nod[:, 1] + np.radians(3)).all()


def test_the_head_goes_back_before_the_music_starts_again() -> None:
    score = score_of([(0, Piece.SNARE), (16, Piece.SNARE), (20, Piece.SNARE)])
    drummer = Drummer(score, style=plain(amplitude_gaze=0))
    before, within = angle(drummer, "head_nod", np.array([4 * 0.6 - 0.3, 5 * 0.6 - 0.3]))
    assert before < -np.radians(3) < within


def test_the_back_is_upright_between_the_beats_and_breathing_goes_on() -> None:
    quiet, deep = (Drummer(score_of(ROCK), style=plain(breathing=b, shrug=0)) for b in (0.0, 100.0))
    at = np.arange(0.0, 8.0, 0.05)
    height = [d.rows(at)[:, JOINTS][:, 3 * Joint.RIGHT_SHOULDER + 2] for d in (quiet, deep)]
    assert 0.008 < np.ptp(height[1] - height[0]) < 0.03  # HUMANS has no number; a breath lifts by a centimetre or two


def test_bobs_on_half_beats() -> None:
    score = score_of(ROCK)
    whole, half = (Drummer(score, style=plain(bobs_per_beat=n, amplitude_gaze=0)) for n in (1, 2))
    between = 0.3 + 0.6 * np.arange(3)
    assert angle(half, "head_nod", between).mean() > angle(whole, "head_nod", between).mean() + np.radians(0.5)
