"""What styles do beyond the natural drummer leaves wrists within their limits and sticks out of the kit."""

from math import radians

import numpy as np
import pytest

from station.core.pieces import Piece, Zone
from station.core.units import PPQ
from station.drills.library import find_lesson
from station.motion.audit import audit
from station.motion.drummer import Drummer
from station.motion.kit.kit import load_kit
from station.motion.sticking.limbs import as_led
from station.motion.style.style_file import load_style
from station.music.score import Note, Score
from station.music.tempo import TempoMap


@pytest.mark.parametrize(
    ("lesson", "kit", "style"),
    [("double-kick-1", "left_handed", "dramatic"), ("quintuplet-1", "seven_piece", "jazz")],
    ids=["shoulders that shrug", "a way lowered by the style"],
)
def test_a_lesson_is_possible_in_a_style(lesson: str, kit: str, style: str) -> None:
    played = load_kit(kit)
    found = audit(Drummer(as_led(find_lesson(lesson).score, played), played, style=load_style(style)))
    assert found.limit_rad.value <= radians(1), found.limit_rad
    assert found.kit_m.value <= 0.003, found.kit_m
    assert found.hands_m.value <= 0.003, found.hands_m


@pytest.mark.parametrize("kit", ["left_handed", "four_piece", "seven_piece"])
def test_wrists_bear_high_strokes_on_their_ways(kit: str) -> None:
    """From every tom to the ride and back, in sixths of a second: raised high the wrist bends further sideways."""
    played = load_kit(kit)
    toms = [p for p in (Piece.TOM_1, Piece.TOM_2, Piece.FLOOR_TOM_1) if p in played.pieces]
    notes = [
        Note(i * PPQ, *((Piece.RIDE, Zone.BOW) if i % 2 else (toms[i // 2 % len(toms)], Zone.HEAD)), 110)
        for i in range(16)
    ]
    found = audit(Drummer(Score.from_notes(notes, TempoMap.constant(180)), played, style=load_style("dramatic")))
    assert found.limit_rad.value <= radians(1), (np.degrees(found.limit_rad.value), found.limit_rad)
    assert found.kit_m.value <= 0.003, found.kit_m
