"""Every piece and zone of every kit can be struck by people of every stature, and nothing is in their way."""

import pytest

from station.core.pieces import Limb, Piece
from station.core.units import PPQ
from station.motion.audit import audit
from station.motion.drummer import Drummer
from station.motion.kinematics.figure import figure_of
from station.motion.kit.kit import Kit, kit_names, load_kit
from station.music.score import Note, Score
from station.music.tempo import TempoMap

_ASIDE_M = 0.3
"""What is farther to a side is that side's hand's, but for the hi-hat, which both play."""


def every_zone(kit: Kit) -> Score:
    """Two strokes a second: each zone with either hand that is for it."""
    notes: list[Note] = []
    for limb, sign in ((Limb.RIGHT_HAND, 1.0), (Limb.LEFT_HAND, -1.0)):
        for piece in kit.pieces.values():
            far = sign * piece.centre_m[0] < -_ASIDE_M and piece.kind != "hihat"
            if far or (piece.kind == "kick"):
                continue
            notes += [
                Note((1 + len(notes) + k) * PPQ, piece.piece, z, 100, limb=limb) for k, z in enumerate(piece.spots)
            ]
    return Score.from_notes(notes, TempoMap.constant(120.0))


@pytest.mark.parametrize("stature_m", [1.62, 1.90])
@pytest.mark.parametrize("name", [name for name in kit_names() if not load_kit(name).left_handed])
def test_every_zone_is_struck_where_it_is_and_nothing_is_in_the_way(name: str, stature_m: float) -> None:
    kit = load_kit(name)
    found = audit(Drummer(every_zone(kit), kit, figure_of(stature_m)))
    assert found.strike_m.value < 0.001, found.strike_m
    assert found.kit_m.value < 0.003, found.kit_m
    assert found.hands_m.value < 0.001, found.hands_m


def test_the_large_kit_has_all_that_a_full_kit_has() -> None:
    large = load_kit("large").pieces
    assert {Piece.CRASH_2, Piece.CHINA, Piece.SPLASH, Piece.COWBELL, Piece.FLOOR_TOM_2} <= set(large)


def test_the_electronic_kits_are_pads_throughout() -> None:
    for name in ("electronic", "left_handed_electronic"):
        assert all(piece.electronic for piece in load_kit(name).pieces.values())
    assert not any(piece.electronic for piece in load_kit().pieces.values())
