"""The minute in which an air kit is learnt: samples of the sticks in, what to strike next and at last the kit out."""

from collections.abc import Mapping

from station.core.events import SensorSamples
from station.core.imu import Mounting
from station.core.labels import piece_name
from station.core.pieces import Limb, Piece, word
from station.sync.air.air_drums import AirDrums
from station.sync.air.air_zones import AirKit
from station.sync.air.zone_learning import STROKES, AskedZone, CloseZones, LearntAir, ZoneLearning
from station.sync.strokes.stick_orientation import StickOrientation

_PIECES = {
    Limb.RIGHT_HAND: (Piece.SNARE, Piece.HIHAT, Piece.TOM_1, Piece.FLOOR_TOM_1, Piece.RIDE),
    Limb.LEFT_HAND: (Piece.SNARE, Piece.HIHAT, Piece.TOM_1),
}
"""What each hand is asked for, the piece first at which it finds itself again; our choice: what beginners' lessons ask
for, and few enough for half a minute at two strokes a second."""


class AirLearning:
    """Feed it all samples of the sticks that are mounted so, by device."""

    def __init__(self, mountings: Mapping[str, Mounting]) -> None:
        hands = {mounting.limb for mounting in mountings.values()}
        asked = [AskedZone(limb, piece) for limb, pieces in _PIECES.items() if limb in hands for piece in pieces]
        self._strokes = STROKES * len(asked)
        self._learning = ZoneLearning(asked)
        self._drums = AirDrums(AirKit(()))
        self._drums.learning = self._learning
        self._orientations = {device: StickOrientation(mounting) for device, mounting in mountings.items()}
        for device, mounting in mountings.items():
            self._drums.mount(device, mounting)
        self._done = 0

    @property
    def is_over(self) -> bool:
        """Whether all was asked; at once where no stick's hand is known."""
        return self._learning.now is None

    @property
    def asks(self) -> str:
        """What to strike now."""
        asked, left = self._learning.now, self._learning.left
        if asked is None:
            return ""
        return f"{word(asked.limb).replace('_', ' ')}: strike where the {piece_name(asked.piece)} shall be, {left} more"

    @property
    def done(self) -> float:
        """How much of it is learnt, 0 … 1."""
        return self._done / max(1, self._strokes)

    def feed(self, event: SensorSamples) -> None:
        """What one stick measured."""
        orientation = self._orientations.get(event.device)
        if orientation is None:
            return
        for sample in event.samples:
            for motion in orientation.feed(sample):
                before = self._learning.now, self._learning.left
                self._drums.moved(event.device, motion)
                self._done += (self._learning.now, self._learning.left) != before

    def learnt(self) -> LearntAir:
        """The kit so far."""
        return self._learning.learnt()


def close_in_words(close: CloseZones) -> str:
    """Two zones that would be taken for each other, for the player to move one."""
    hand = word(close.one.limb).replace("_", " ")
    pieces = f"{piece_name(close.one.piece)} and {piece_name(close.other.piece)}"
    return f"{hand}: {pieces} lie close, {close.confused:.0%} of strokes would be mistaken; learn them further apart"
