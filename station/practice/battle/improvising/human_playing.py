"""What drummers play in general, as `tools.human_playing` measured it: how loud, how dense, how much adorned."""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from station.practice.battle.improvising.played_beats import Instrument
from station.practice.battle.improvising.stroke_place import StrokePlace

HUMAN_PLAYING = Path(__file__).parents[1] / "data" / "human_playing.json"
"""Measured on the Groove MIDI Dataset (Gillick et al. 2019, CC BY 4.0)."""


@dataclass(frozen=True, eq=False)
class HumanPlaying:
    """The middle `velocity` (9, 6) by `Instrument` and `StrokePlace`; how many `strokes_a_beat` drummers play.

    `ornaments` are shares of the snare's strokes, by the words of `Ornament`.
    """

    velocity: NDArray[np.float64]
    ornaments: Mapping[str, float]
    strokes_a_beat: float


@cache
def human_playing() -> HumanPlaying:
    """The table that ships."""
    document = json.loads(HUMAN_PLAYING.read_text(encoding="utf-8"))
    velocity = document["velocity"]
    return HumanPlaying(
        velocity=np.array([[velocity[i.name.lower()][p.name.lower()] for p in StrokePlace] for i in Instrument], float),
        ornaments=document["ornaments"],
        strokes_a_beat=document["strokes_a_beat"],
    )
