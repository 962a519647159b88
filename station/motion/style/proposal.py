"""A style proposed from the score: its tempo, how dense it is, and how loud and how varied.

The music's own signs, nothing else: a fast or dense score leaves little room for large movement, a loud one asks for
it, wide dynamics ask for the whole arm, swung soft rides for the traditional grip and a calm face, loudness for a grim
one. Each rule is our choice; the user's
hand on the controls comes after it.
"""

from dataclasses import dataclass, replace

import numpy as np

from station.core.pieces import Piece
from station.motion.style.style import NATURAL, Style
from station.music.score import Score

PROPOSED = "proposed"
"""The name of every proposed style, and what commands call for one."""


@dataclass(frozen=True, slots=True)
class Character:
    """What a score is like: beats a minute, strokes a second, mean velocity and its spread, share of ride strokes."""

    tempo_bpm: float
    strokes_s: float
    velocity: float
    spread: float
    ride: float


_ORDINARY = Character(tempo_bpm=105.0, strokes_s=8.0, velocity=72.0, spread=27.0, ride=0.1)
"""What human grooves are like on the whole: means of rock, funk and soul in the Groove MIDI Dataset."""
_CALM_VELOCITY, _INTENSE_VELOCITY = 70.0, 85.0
_MUCH_RIDE = 0.25


def character(score: Score) -> Character:
    """The character of `score`; an empty one is ordinary."""
    if not len(score):
        return _ORDINARY
    seconds = max(score.length_ns / 1e9, 1.0)
    velocity = score.notes["velocity"].astype(np.float64)
    beats = score.length_beats
    return Character(
        tempo_bpm=60.0 * beats / seconds,
        strokes_s=len(score) / seconds,
        velocity=float(velocity.mean()),
        spread=float(velocity.std()),
        ride=float(np.isin(score.notes["piece"], (Piece.RIDE, Piece.RIDE_2)).mean()),
    )


def propose_style(score: Score) -> Style:
    """A style for `score`, to begin with."""
    is_like = character(score)
    room = _clip(1.0 - 0.5 * np.log2(is_like.strokes_s / _ORDINARY.strokes_s))
    force = _clip(is_like.velocity / _ORDINARY.velocity)
    slow = _clip(_ORDINARY.tempo_bpm / is_like.tempo_bpm)
    calm = is_like.ride > _MUCH_RIDE and is_like.velocity < _CALM_VELOCITY
    style = replace(
        Style(name=PROPOSED),
        amplitude_gain=NATURAL * _clip(room * force),
        amplitude_back=NATURAL * _clip(slow * force),
        amplitude_neck=NATURAL * _clip(force * force * slow),
        frequency_gain=NATURAL * _clip((is_like.spread / _ORDINARY.spread) ** 0.5),
        grip_left="traditional" if calm else "american",
        heel="down" if is_like.velocity < _ORDINARY.velocity else "up",
        mood="calm" if calm else "intense" if is_like.velocity > _INTENSE_VELOCITY else "focused",
    )
    wrist = 40.0 * _clip(1.0 / room)
    return style.with_share("amplitude", "wrist", min(wrist, 70.0))


def _clip(x: float) -> float:
    return float(np.clip(x, 0.5, 1.7))
