"""Turns made by hand: strokes at stated times of a ground."""

from collections.abc import Iterable

import numpy as np

from station.core.events import Hit
from station.core.pieces import Piece, Zone
from station.core.units import NS_PER_MS
from station.music.performance import Performance
from station.practice.battle.ground import Ground
from station.practice.battle.phrase import Turn

Stroke = tuple[float, Piece, int]
"""When, in beats of the ground; what; how loud."""


def turn_of(
    strokes: Iterable[Stroke], ground: Ground, bars: int = 1, noise_ms: float = 0.0, lean_ms: float = 0
) -> Turn:
    """The strokes as a turn, each off by Gaussian noise (seed 1) and all by a lean."""
    rng = np.random.default_rng(1)
    beat_ns = 60e9 / ground.beats_a_minute
    hits = [
        Hit(round(beat * beat_ns + (rng.normal(0, noise_ms) + lean_ms) * NS_PER_MS), piece, Zone.HEAD, velocity)
        for beat, piece, velocity in strokes
    ]
    return Turn(ground, bars, Performance.from_hits(hits))


def every(step: float, beats: float, piece: Piece = Piece.HIHAT, start: float = 0.0) -> list[Stroke]:
    """Strokes of one piece a step apart for so many beats."""
    return [(start + i * step, piece, 80) for i in range(round(beats / step))]
