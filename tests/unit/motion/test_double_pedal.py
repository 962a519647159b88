"""The foot with two boards: who plays the second beater, the way from board to board, and that sole and board agree."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.pieces import Limb, Piece, Zone
from station.core.units import PPQ
from station.motion.drummer import Drummer
from station.motion.kinematics import frame
from station.motion.kinematics.figure import Joint, figure_of
from station.motion.kinematics.foot_path import LEAST_MOVE_S, FootPath, Visits
from station.motion.kinematics.footings import capsules, depth_in_drums
from station.motion.kinematics.maths import MANY
from station.motion.kit.kit import Kit, kit_names, load_kit
from station.motion.sticking.limbs import as_led, assign_limbs
from station.motion.style.style import Style
from station.music.score import Note, Score
from station.music.tempo import TempoMap

R, L = Limb.RIGHT_FOOT, Limb.LEFT_FOOT
BEAT_S = 0.5


def score_of(*kicks: tuple[float, Limb], hats: tuple[float, ...] = (), opened: tuple[float, ...] = ()) -> Score:
    """Kicks, chicks and half-open strokes at beats of 120 a minute."""
    notes = [Note(int(beat * PPQ), Piece.KICK, limb=limb) for beat, limb in kicks]
    notes += [Note(int(beat * PPQ), Piece.HIHAT_PEDAL, Zone.PEDAL) for beat in hats]
    notes += [Note(int(beat * PPQ), Piece.HIHAT, Zone.BOW, openness=0.5) for beat in opened]
    return Score.from_notes(notes, TempoMap.constant(120))


def sixteenths(start: float, beats: int) -> list[tuple[float, Limb]]:
    return [(start + k / 4, L if k % 2 else R) for k in range(4 * beats)]


def over_slave(rows: NDArray[np.float64], kit: Kit, joint: Joint) -> NDArray[np.float64]:
    """How far `joint` is over the slave board of `kit`, raised as the rows say, metres (n,)."""
    assert kit.slave is not None
    angle, board = rows[:, frame.SLAVE_BOARD], kit.slave
    along = np.array(board.toe_m) - np.array(board.heel_m)
    normal = np.cos(angle)[:, None] * [0, 0, 1.0] - np.sin(angle)[:, None] * along / np.linalg.norm(along)
    return np.asarray(((rows[:, frame.JOINTS].reshape(-1, 21, 3)[:, joint] - board.heel_m) * normal).sum(1))


def test_each_foot_presses_its_own_board_and_beater() -> None:
    drummer = Drummer(score_of(*sixteenths(4, 2)))
    for beat, limb in sixteenths(4, 2):
        pose = drummer.pose(beat * BEAT_S)
        mine, other = (pose.beater_rad, pose.slave_rad[1]) if limb is R else (pose.slave_rad[1], pose.beater_rad)
        assert mine == pytest.approx(0.0, abs=1e-9)
        assert other > 0.1
    assert drummer.pose(4 * BEAT_S).slave_rad[0] > 0.1, "the slave board is up while the right foot strikes"


def test_the_left_foot_is_on_the_slave_in_time_and_back_on_the_hat_for_its_chick() -> None:
    kit = load_kit()
    assert kit.slave is not None
    drummer = Drummer(score_of(*sixteenths(4, 2), hats=(0, 1, 2, 8, 9)))
    toes = {beat: drummer.pose(beat * BEAT_S).joints_m[Joint.LEFT_TOE] for beat in (2, 4.25, 5.75, 8)}
    for beat, board in (
        (2, kit.pedals[Piece.HIHAT_PEDAL]),
        (4.25, kit.slave),
        (5.75, kit.slave),
        (8, kit.pedals[Piece.HIHAT_PEDAL]),
    ):
        along = np.array(board.toe_m) - np.array(board.heel_m)
        reach = np.array(board.heel_m) + along / np.linalg.norm(along) * drummer.figure.foot_m
        assert toes[beat] == pytest.approx(reach, abs=1e-6), beat


def test_between_the_boards_it_lifts_travels_and_lands() -> None:
    drummer = Drummer(score_of(*sixteenths(4, 2), hats=(0, 1, 2)))
    rows = drummer.rows(np.arange(2 * BEAT_S, 4.25 * BEAT_S, 0.001))
    toe = rows[:, frame.JOINTS].reshape(-1, 21, 3)[:, Joint.LEFT_TOE]
    over = over_slave(rows, load_kit(), Joint.LEFT_TOE)
    between = (toe[:, 0] > -0.35) & (toe[:, 0] < -0.27)
    assert between.any()
    assert over[between].min() > 0.02, "over the boards while it goes aside"
    assert np.abs(np.diff(toe, axis=0)).max() < 0.004, "no jump: 4 m/s at most"


@pytest.mark.parametrize("heel", ["down", "up"])
def test_where_it_stands_the_sole_is_on_the_slave_board(heel: str) -> None:
    drummer = Drummer(score_of(*sixteenths(4, 4)), style=Style(heel=heel))
    rows = drummer.rows(np.arange(4.25 * BEAT_S, 8 * BEAT_S, 0.001))
    assert np.abs(over_slave(rows, drummer.kit, Joint.LEFT_TOE)).max() < 0.001
    ankle = over_slave(rows, drummer.kit, Joint.LEFT_ANKLE) - drummer.figure.ankle_height_m
    assert (np.abs(ankle).max() < 0.001) if heel == "down" else (ankle.min() > 0.015)


def test_while_the_foot_is_away_the_clutch_keeps_the_hat_as_it_was() -> None:
    drummer = Drummer(score_of(*sixteenths(8, 2), opened=(0, 4)))
    pose = drummer.pose(9 * BEAT_S)
    assert pose.hat_gap_m == pytest.approx(drummer.pose(4 * BEAT_S).hat_gap_m)
    assert pose.footboard_rad[1] == pytest.approx(load_kit().pedals[Piece.HIHAT_PEDAL].raised_rad), "the spring has it"


def test_it_stays_over_short_rests_and_comes_back_after_the_passage() -> None:
    drummer = Drummer(score_of((4, L), (7, L), (20, R)))
    x = [drummer.pose(beat * BEAT_S).joints_m[Joint.LEFT_TOE][0] for beat in (4, 5.5, 7, 12)]
    assert x[:3] == pytest.approx([x[0]] * 3, abs=0.005)
    assert x[3] < x[0] - 0.08


def test_a_kit_without_a_second_pedal_leaves_the_kicks_to_the_one_foot_and_says_what_is_too_fast() -> None:
    kit = replace(load_kit(), slave=None)
    slow = assign_limbs(score_of((0, R), (1, L)), kit)
    assert slow.limbs.tolist() == [R, R]
    assert slow.why[1] == "this kit has no second pedal"
    assert not slow.warnings
    quick = Score.from_notes(
        [Note(k * PPQ // 8, Piece.KICK, limb=L if k % 2 else R) for k in range(16)], TempoMap.constant(120)
    )
    assert "bar 1 needs 16 strokes a second of one foot" in assign_limbs(quick, kit).warnings
    assert not assign_limbs(quick, load_kit()).warnings


def test_too_short_a_way_between_the_pedals_is_named_by_its_bar() -> None:
    """A foot that taps 5 times a second needs 0.2 s up and down, so that nobody is over there in 125 ms."""
    near = score_of((4, L), hats=(4.25,))
    assert assign_limbs(near, load_kit()).warnings == (
        "bar 2 needs one foot on the hi-hat's pedal and on the double pedal within 125 ms",
    )
    assert 0.125 < LEAST_MOVE_S < 0.5
    assert not assign_limbs(score_of((4, L), hats=(5,)), load_kit()).warnings


def kicks_every(gap_s: float, count: int, *others: Note) -> Score:
    """Kicks that say no foot, from 2 s on."""
    ticks = [round((2 + k * gap_s) / BEAT_S * PPQ) for k in range(count)]
    return Score.from_notes([*(Note(tick, Piece.KICK) for tick in ticks), *others], TempoMap.constant(120))


def feet_of(score: Score, kit: Kit) -> str:
    limbs = assign_limbs(score, kit).limbs[score.notes["piece"] == Piece.KICK]
    return "".join("RL"[limb - R] for limb in limbs.tolist())


def test_free_kicks_too_quick_for_one_foot_are_played_in_turn() -> None:
    """A foot keeps up 5–6 strokes a second heel up (HUMANS); twelve a second are six of each."""
    kit = load_kit()
    assert feet_of(kicks_every(1 / 12, 8), kit) == "RLRLRLRL"
    assert feet_of(kicks_every(1 / 12, 8), kit.mirrored) == "LRLRLRLR"
    assert not assign_limbs(kicks_every(1 / 15, 16), kit).warnings
    assert feet_of(kicks_every(1 / 12, 8), replace(kit, slave=None)) == "RRRRRRRR"


def test_what_one_foot_can_play_it_plays() -> None:
    kit = load_kit()
    assert feet_of(kicks_every(1 / 4, 8), kit) == "RRRRRRRR"
    assert feet_of(kicks_every(1 / 12, 3), kit) == "RRR"


def test_a_foot_that_is_busy_with_the_hat_stays_there() -> None:
    chick = Note(round(2.3 / BEAT_S * PPQ), Piece.HIHAT_PEDAL, Zone.PEDAL)
    early = Note(round(1.0 / BEAT_S * PPQ), Piece.HIHAT_PEDAL, Zone.PEDAL)
    assert feet_of(kicks_every(1 / 12, 8, chick), load_kit()) == "RRRRRRRR"
    assert feet_of(kicks_every(1 / 12, 8, early), load_kit()) == "RLRLRLRL"


@pytest.mark.parametrize("seed", range(40))
def test_whatever_is_asked_the_foot_is_there_or_it_is_named(seed: int) -> None:
    """Between random strokes on both boards it never jumps, and no move begins before another has ended."""
    random = np.random.default_rng(seed)
    count = int(random.integers(1, 40))
    eighths = np.sort(random.integers(0, 40, count)) / 8
    visits = Visits(
        np.arange(count), eighths if seed % 2 else np.cumsum(random.exponential(0.3, count)), random.random(count) < 0.4
    )
    path = FootPath.of(visits)
    if path is None:
        assert set(np.flatnonzero(visits.slave)) <= set(visits.too_soon)
        return
    start, end, _ = visits.moves.T
    assert (end - start).min() > 0.1
    assert (start[1:] >= end[:-1]).all()
    side = path.at(MANY, path.phase.many(visits.time_s)[0]).side
    elsewhere = np.flatnonzero(np.abs(side - visits.slave) > 1e-9)
    assert set(elsewhere) <= set(visits.too_soon)


def test_a_left_handed_kit_is_the_mirror() -> None:
    score, left = score_of(*sixteenths(4, 2)), load_kit("left_handed")
    one, other = Drummer(score).pose(4.6), Drummer(as_led(score, left), left).pose(4.6)
    assert other.joints_m[Joint.RIGHT_HIP : Joint.RIGHT_TOE + 1] * [-1, 1, 1] == pytest.approx(
        one.joints_m[Joint.LEFT_HIP : Joint.LEFT_TOE + 1]
    )
    assert other.slave_rad == pytest.approx(one.slave_rad)


@pytest.mark.parametrize("name", kit_names())
@pytest.mark.parametrize("stature_m", [1.62, 1.76, 1.90])
def test_legs_keep_clear_of_the_drums(name: str, stature_m: float) -> None:
    kit = load_kit(name)
    score = as_led(score_of(*sixteenths(2, 1), hats=(0, 1, 4)), kit)
    for heel in ("down", "up"):
        drummer = Drummer(score, kit, figure_of(stature_m), Style(heel=heel, amplitude_heel=60.0))
        joints = drummer.rows(np.arange(-0.5, 5 * BEAT_S, 0.01))[:, frame.JOINTS].reshape(-1, 21, 3)
        for hip in (Joint.RIGHT_HIP, Joint.LEFT_HIP):
            points, radii = capsules(drummer.figure, *(joints[:, hip + k] for k in range(3)))
            assert depth_in_drums(kit, points, radii).max() <= 0.001
