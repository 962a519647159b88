"""A pad's touch is learnt from five ghost strokes and five accents: hits in, the pad's curve and threshold out."""

from dataclasses import replace
from types import MappingProxyType

from station.core.events import Hit
from station.core.labels import piece_name
from station.core.pieces import Piece
from station.devices.mapping.device_map import DeviceMap
from station.devices.mapping.velocity_curve import STROKES, fitted, threshold_below
from station.devices.wizard.answers import ONE_STROKE_NS


class VelocityLearning:
    """The strokes on `piece` so far; velocities as the pad sent them."""

    def __init__(self, piece: Piece) -> None:
        self.piece = piece
        self.ghosts: list[int] = []
        self.accents: list[int] = []
        self._last_ns: int | None = None

    @property
    def is_over(self) -> bool:
        """Whether both are there."""
        return len(self.accents) == STROKES

    @property
    def asks(self) -> str:
        """What to play now, and how much of it is there."""
        if len(self.ghosts) < STROKES:
            return f"{piece_name(self.piece)}: play five ghost strokes, {len(self.ghosts)} of {STROKES}"
        return f"{piece_name(self.piece)}: now five accents, {len(self.accents)} of {STROKES}"

    def feed(self, hit: Hit) -> None:
        """A hit, counted or too soft; what follows at once belongs to the stroke before."""
        if hit.piece is not self.piece or self.is_over:
            return
        is_same = self._last_ns is not None and hit.at_ns - self._last_ns <= ONE_STROKE_NS
        if is_same:
            last = self.accents or self.ghosts
            last[-1] = max(last[-1], hit.velocity)
            return
        self._last_ns = hit.at_ns
        (self.ghosts if len(self.ghosts) < STROKES else self.accents).append(hit.velocity)

    def learnt(self, kit: DeviceMap) -> DeviceMap:
        """The kit whose pad counts these as ghosts and accents; raises `BadInput` where they cannot be told apart."""
        pad = kit.pad(self.piece)
        threshold = threshold_below(pad.threshold, self.ghosts)
        pad = replace(pad, curve=fitted(self.ghosts, self.accents), threshold=threshold)
        return replace(kit, pads=MappingProxyType({**kit.pads, self.piece: pad}))

    def in_words(self) -> str:
        """What was played."""
        ghosts, accents = sorted(self.ghosts)[STROKES // 2], sorted(self.accents)[STROKES // 2]
        return f"{piece_name(self.piece)}: a ghost of {ghosts} and an accent of {accents} now count as lessons write"
