"""Expected limbs are those of a right-handed player reading the chart."""

from station.core.pieces import Limb, Piece
from station.core.units import PPQ
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.simulation.student_limbs import limbs_of
from tests.fakes import scores

R, L, RF, LF = Limb.RIGHT_HAND, Limb.LEFT_HAND, Limb.RIGHT_FOOT, Limb.LEFT_FOOT


def test_feet_hat_hand_and_backbeat() -> None:
    score = scores.rock_beat(1)
    expected = {Piece.KICK: {RF}, Piece.HIHAT: {R}, Piece.SNARE: {L}}
    limbs = limbs_of(score)
    for piece, wanted in expected.items():
        assert set(limbs[score.notes["piece"] == piece].tolist()) == wanted


def test_the_other_foot_has_the_pedal() -> None:
    score = scores.swing_ride(1)
    assert set(limbs_of(score)[score.notes["piece"] == Piece.HIHAT_PEDAL].tolist()) == {LF}


def test_written_sticking_rules() -> None:
    score = scores.double_strokes(1)
    assert limbs_of(score).tolist() == score.notes["limb"].tolist()


def test_drums_alone_alternate_from_the_right() -> None:
    notes = [Note(i * PPQ // 4, Piece.TOM_1) for i in range(4)]
    assert limbs_of(Score.from_notes(notes, TempoMap.constant(100))).tolist() == [R, L, R, L]


def test_two_drums_at_once_take_both_hands() -> None:
    score = Score.from_notes([Note(0, Piece.SNARE), Note(0, Piece.FLOOR_TOM_1)], TempoMap.constant(100))
    assert sorted(limbs_of(score).tolist()) == [R, L]
