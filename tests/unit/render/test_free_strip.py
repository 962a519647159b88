"""The free strip: where bars and strokes lie, in seconds, and how large a stroke's head is."""

import numpy as np
import pytest

from station.core.events import Hit
from station.core.pieces import Piece, Zone
from station.core.units import NS_PER_S
from station.music.performance import Performance
from station.render.notation.screen.free_strip import strip_shapes
from station.render.snapshot import Strip
from station.render.text.atlas import Atlas

ATLAS = Atlas()


def struck(*strokes: tuple[float, Piece, int]) -> Performance:
    return Performance.from_hits(
        Hit(round(at_s * NS_PER_S), piece, Zone.HEAD, velocity) for at_s, piece, velocity in strokes
    )


def test_beats_begin_with_the_take_and_every_fourth_is_a_bar() -> None:
    """At 120 a beat lasts half a second; bar lines are the wider ones."""
    shapes = strip_shapes(Strip(struck(), 0.5), (-3.0, 4.2), ATLAS)
    assert shapes["time_s"][:, 0].tolist() == [0.5 * beat for beat in range(9)]
    widest = shapes["half"][:, 0].max()
    assert np.flatnonzero(shapes["half"][:, 0] == widest).tolist() == [0, 4, 8]


def test_without_a_click_there_are_strokes_alone_and_only_those_in_sight() -> None:
    played = struck((1.0, Piece.SNARE, 90), (2.0, Piece.KICK, 90), (9.0, Piece.SNARE, 90))
    shapes = strip_shapes(Strip(played), (0.0, 4.0), ATLAS)
    assert shapes["time_s"][:, 0].tolist() == [1.0, 2.0]
    snare, kick = shapes["centre"][:, 1]
    assert (snare, kick) == (-0.5, 1.5), "C5 stands half a space above the middle line, F4 three halves below"


def test_a_louder_stroke_is_larger_and_cymbals_are_crosses() -> None:
    played = struck((1.0, Piece.SNARE, 20), (2.0, Piece.SNARE, 120), (3.0, Piece.RIDE, 90))
    soft, loud, ride = strip_shapes(Strip(played), (0.0, 4.0), ATLAS)
    assert loud["half"][0] > 1.4 * soft["half"][0]
    assert ride["uv"].tolist() == pytest.approx(ATLAS.sign("head_cross").uv)
