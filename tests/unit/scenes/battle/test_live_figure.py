"""A figure that answers strokes nobody wrote: a tip is on the piece at once, its hands alternate, nothing is torn."""

import itertools
from functools import lru_cache

import numpy as np
import pytest

from station.core.pieces import Limb, Piece
from station.motion.kinematics import frame
from station.motion.kinematics.figure import Joint
from station.scenes.battle.live_figure import ATTACK_S, LiveFigure
from station.scenes.battle.motion_chain import Body
from station.scenes.battle.vocabulary import Vocabulary
from tests.unit.scenes.battle.battles_on_stage import phrase, speeds

TIPS = {Limb.RIGHT_HAND: 0, Limb.LEFT_HAND: 1}


@lru_cache(maxsize=1)
def vocabulary() -> Vocabulary:
    return Vocabulary.of(Body())


def off_m(figure: LiveFigure, piece: Piece, limb: Limb, at_s: float) -> tuple[float, float]:
    """How high a tip is over the piece, and how far from its middle along it."""
    on = figure.kit.pieces[piece]
    way = figure.pose(at_s).tip_m[TIPS[limb]] - on.centre
    high = float(way @ on.normal)
    return high, float(np.linalg.norm(way - high * on.normal))


@pytest.mark.parametrize("piece", [Piece.SNARE, Piece.HIHAT, Piece.TOM_1, Piece.FLOOR_TOM_1, Piece.CRASH_1, Piece.RIDE])
@pytest.mark.parametrize("limb", list(TIPS))
def test_a_tip_is_on_the_piece_within_two_pictures_and_rebounds(piece: Piece, limb: Limb) -> None:
    figure = LiveFigure(vocabulary())
    figure.strike(2.0, piece, 100, limb)
    high, beside = off_m(figure, piece, limb, 2.0 + ATTACK_S)
    assert abs(high) < 1e-6
    assert beside <= figure.kit.pieces[piece].radius_m + 1e-6
    assert off_m(figure, piece, limb, 2.0 + ATTACK_S + 0.1)[0] > 0.04


def test_a_stroke_that_is_known_falls_when_it_sounds_and_was_prepared() -> None:
    figure = LiveFigure(vocabulary())
    figure.strike(2.0, Piece.FLOOR_TOM_1, 100, Limb.RIGHT_HAND, is_known=True)
    times = np.arange(0.5, 3.0, 1 / 240)
    tips = np.array([figure.pose(at_s).tip_m[0] for at_s in times])
    assert abs(off_m(figure, Piece.FLOOR_TOM_1, Limb.RIGHT_HAND, 2.0)[0]) < 1e-6
    assert off_m(figure, Piece.FLOOR_TOM_1, Limb.RIGHT_HAND, 1.88)[0] > 0.05
    assert speeds(tips, 240)[0].max() < 12.0, "no faster than a loud stroke (HUMANS: tips at 5 to 12 m/s)"


def test_what_is_expected_is_waited_for_above_the_piece() -> None:
    """In a phrase that is repeated: the hand that has the first stroke is over the hi-hat before anything is heard."""
    figure = LiveFigure(vocabulary())
    figure.expect(phrase(1).score, 5.0)
    high, beside = off_m(figure, Piece.HIHAT, Limb.RIGHT_HAND, 4.99)
    assert 0.02 < high < 0.5
    assert beside < 2 * figure.kit.pieces[Piece.HIHAT].radius_m


def struck(pieces: list[Piece], gap_s: float) -> list[Limb]:
    """Who makes strokes so far apart of which no limb is known."""
    figure = LiveFigure(vocabulary())
    for k, piece in enumerate(pieces):
        figure.strike(1.0 + k * gap_s, piece, 90)
    made = sorted((stroke.at_s, limb) for limb, row in figure._strokes.items() for stroke in row)
    return [limb for _, limb in made]


def test_hands_are_those_that_drummers_use() -> None:
    right, left = Limb.RIGHT_HAND, Limb.LEFT_HAND
    assert struck([Piece.HIHAT] * 4, 0.3) == [right] * 4, "one hand keeps time"
    beat = [Piece.HIHAT, Piece.HIHAT, Piece.SNARE, Piece.HIHAT]
    assert struck(beat, 0.25) == [right, right, left, right]
    rolled = struck([Piece.SNARE] * 8, 0.09)
    assert all(one is not other for one, other in itertools.pairwise(rolled)), "quick singles alternate"
    assert set(struck([Piece.CRASH_1, Piece.SNARE], 0.0)) == {right, left}, "two at once are two hands"
    assert struck([Piece.KICK, Piece.HIHAT_PEDAL], 0.2) == [Limb.RIGHT_FOOT, Limb.LEFT_FOOT]


def test_nothing_is_torn_and_trunk_and_thighs_are_free_of_hands() -> None:
    """Round the kit in eighths: arms keep their lengths, wrists stay out of the trunk's middle and above the thighs."""
    figure, lengths = LiveFigure(vocabulary()), []
    pieces = [Piece.HIHAT, Piece.SNARE, Piece.TOM_1, Piece.FLOOR_TOM_1, Piece.CRASH_1, Piece.RIDE, Piece.SNARE]
    for k, piece in enumerate(pieces):
        figure.strike(1.0 + 0.2 * k, piece, 110)
    for at_s in np.arange(0.8, 4.5, 1 / 120):
        joints = figure.pose(float(at_s)).row[frame.JOINTS].reshape(21, 3)
        lengths.append(np.linalg.norm(joints[Joint.RIGHT_SHOULDER] - joints[Joint.RIGHT_ELBOW]))
        spine = joints[Joint.NECK] - joints[Joint.PELVIS]
        for wrist in (Joint.RIGHT_WRIST, Joint.LEFT_WRIST):
            way = joints[wrist] - joints[Joint.PELVIS]
            share = np.clip(way @ spine / (spine @ spine), 0, 1)
            assert np.linalg.norm(way - share * spine) > 0.14, "the trunk is some 12 cm deep from its middle"
    assert np.ptp(lengths) < 0.01, "an arm that is quite stretched may be pulled by less than one sees"


def test_what_is_forgotten_moves_nothing() -> None:
    figure, fresh = LiveFigure(vocabulary()), LiveFigure(vocabulary())
    figure.strike(2.0, Piece.SNARE, 100)
    figure.forget_from(1.5)
    assert np.array_equal(figure.pose(2.1).row, fresh.pose(2.1).row)
