"""One stroke of every hand and foot on every piece, planned once, for a figure whose strokes nobody has written.

A drummer is planned who strikes each piece with each hand in turn, and each pedal. From this take come what a limb does
about a stroke: the preparation, the contact and the rebound.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from station.core.errors import BadInput
from station.core.pieces import Limb, Piece
from station.core.units import PPQ
from station.motion.drummer import Drummer
from station.motion.kinematics.pose import Pose
from station.motion.kit.kit import Kit
from station.music.score import Note, Score
from station.music.tempo import MeterChange, TempoChange, TempoMap
from station.scenes.battle.motion_chain import Body

_BPM, _EVERY_BEATS = 60.0, 1
"""A stroke every second: each hand has come to rest between two of its own (our choice)."""
_VELOCITY = 96
"""A loud stroke; softer ones are made lower."""
Made = tuple[Limb, Piece]


@dataclass(frozen=True, eq=False)
class Vocabulary:
    """`drummer` makes the stroke of each limb on each piece at the second `at_s` of their score, if they can."""

    drummer: Drummer
    at_s: Mapping[Made, float]

    @classmethod
    def of(cls, body: Body) -> "Vocabulary":
        """That of a body on its kit; a piece that a hand cannot reach is left out."""
        made = strokes_of(body.kit)
        while True:
            try:
                drummer = Drummer(_score(made), body.kit, body.figure, body.style)
            except BadInput:
                made = [stroke for stroke in made if _can(stroke, body)]
                continue
            return cls(drummer, {stroke: float(s) for stroke, s in zip(made, _times(len(made)), strict=True)})

    def pose(self, stroke: Made, after_s: float) -> Pose:
        """Everything `after_s` seconds after the stroke of a limb on a piece, before it where that is negative."""
        return self.drummer.pose(self.at_s[stroke] + after_s)

    def contact(self, stroke: Made) -> NDArray[np.float64]:
        """The row of the pose at the contact itself."""
        return self._contacts[stroke]

    @cached_property
    def _contacts(self) -> dict[Made, NDArray[np.float64]]:
        return {stroke: self.pose(stroke, 0.0).row for stroke in self.at_s}

    def limbs(self, piece: Piece) -> list[Limb]:
        """Who can strike a piece, which is one of the kit."""
        return [limb for limb, struck in self.at_s if struck is piece]


def strokes_of(kit: Kit) -> list[Made]:
    """Every limb with every piece that it may strike: hands what stands there, feet their pedals."""
    kicks, hats = kit.feet
    by_hand = [piece for piece in kit.pieces if piece is not Piece.KICK]
    found = [(hand, piece) for piece in by_hand for hand in (Limb.RIGHT_HAND, Limb.LEFT_HAND)]
    return [*found, (kicks, Piece.KICK), (hats, Piece.HIHAT_PEDAL)]


def _can(stroke: Made, body: Body) -> bool:
    try:
        Drummer(_score([stroke]), body.kit, body.figure, body.style)
    except BadInput:
        return False
    return True


def _score(made: list[Made]) -> Score:
    tempo_map = TempoMap.build([TempoChange.from_bpm(0, _BPM)], [MeterChange(0, 4, 4)])
    ticks = (np.arange(1, len(made) + 1) * _EVERY_BEATS * PPQ).tolist()
    notes = [Note(tick, piece, velocity=_VELOCITY, limb=limb) for tick, (limb, piece) in zip(ticks, made, strict=True)]
    return Score.from_notes(notes, tempo_map)


def _times(count: int) -> NDArray[np.float64]:
    return np.asarray(np.arange(1, count + 1) * _EVERY_BEATS * 60.0 / _BPM, np.float64)
