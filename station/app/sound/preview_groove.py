"""What is played to try a drum kit or a click: a bar of a groove with a fill, a bar of the click. As cues."""

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import CLOSED, OPEN, Articulation, Piece, Zone
from station.core.units import NS_PER_S
from station.engine.messages import CUE_DTYPE, Bus
from station.music.tempo import MeterChange, TempoChange, TempoMap
from station.practice.session.cues.click_pattern import ClickPattern, click_cues
from station.practice.session.cues.listening import RING_NS, Listening

_STEP_NS = round(NS_PER_S * 60 / 112 / 4)
"""A sixteenth at 112 (our choice: a bar and a fill in two beats over four seconds)."""
_HEAD, _BOW, _EDGE = Zone.HEAD, Zone.BOW, Zone.EDGE
_STROKES = (
    *((step, Piece.HIHAT, _EDGE, 84 if step % 4 == 0 else 58, CLOSED) for step in range(0, 14, 2)),
    (14, Piece.HIHAT, _EDGE, 90, OPEN),
    *((step, Piece.KICK, _HEAD, 104, None) for step in (0, 6, 8, 16, 24)),
    *((step, Piece.SNARE, _HEAD, velocity, None) for step, velocity in ((4, 108), (7, 30), (9, 34), (12, 110))),
    *((step, Piece.RIDE, _BOW, 76, None) for step in (16, 18, 20)),
    (20, Piece.SNARE, _HEAD, 108, None),
    *((22 + i, piece, _HEAD, 100, None) for i, piece in enumerate((Piece.TOM_1, Piece.FLOOR_TOM_1))),
    (24, Piece.CRASH_1, _EDGE, 106, None),
)
"""Sixteenths from the start, piece, zone, velocity and openness: what a kit has, in the order in which one asks for it
(our choice)."""


def groove() -> Listening:
    """The groove, at the demonstration's level."""
    cues = np.zeros(len(_STROKES), CUE_DTYPE)
    for row, (step, piece, zone, velocity, openness) in enumerate(_STROKES):
        opened = np.nan if openness is None else openness
        cues[row] = (step * _STEP_NS, Bus.DEMONSTRATION, piece, zone, Articulation.NORMAL, velocity, opened)
    return _listening(cues[np.argsort(cues["at_ns"], kind="stable")])


def click_bar(pattern: ClickPattern, meter: MeterChange, quarters_a_minute: float, bars: int = 1) -> Listening:
    """So many bars of a pattern, and the first beat of the next; a gap is left out."""
    tempo_map = TempoMap.build(
        [TempoChange.from_bpm(0, quarters_a_minute)], [MeterChange(0, meter.beats, meter.unit, meter.groups)]
    )
    return _listening(click_cues(tempo_map, tempo_map.bar_start(bars) + 1, pattern))


def _listening(cues: NDArray[np.void]) -> Listening:
    return Listening(cues, int(cues["at_ns"].max(initial=0)) + RING_NS)
