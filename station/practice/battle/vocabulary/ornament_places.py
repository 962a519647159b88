"""Flams, drags, diddles and buzzes where hands have time for them."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType

from numpy.random import Generator

from station.core.pieces import DRUMS, HAND_PIECES, Articulation, Ornament, Piece
from station.music.score import Note

ROOM_BEFORE_S: Mapping[Ornament, float] = MappingProxyType({Ornament.FLAM: 0.09, Ornament.DRAG: 0.18})
"""So long before a flam or a drag no hand strikes: grace strokes come 30 or 110 ms early, and a hand needs 60 (HUMANS,
Timing: a rebound comes after 50–90 ms)."""
DIDDLE_S = 0.045
"""A hand's rebound comes 50–90 ms after its stroke (HUMANS, Timing); what follows it needs as long."""
BUZZ_S = (0.18, 0.6)
"""How long a stroke must have for itself to be a buzz, and the longest that a stick buzzes (our choice)."""
_LOUD = 96
"""From this velocity on a stroke is flammed rather than dragged (our choice: between normal and accent)."""


@dataclass(frozen=True, slots=True)
class Touch:
    """Shares of the dressed strokes that are graced, doubled, buzzed; what a tick lasts, and a beat's ticks."""

    graced: float
    doubled: float
    buzzed: float
    tick_s: float
    beat_ticks: int


def ornamented(notes: Sequence[Note], chosen: Collection[int], touch: Touch, rng: Generator) -> list[Note]:
    """`notes`, in order of time, those at the indices `chosen` with an ornament as far as there is room.

    Only drums under a hand that strikes alone are dressed. A diddle is two strokes; flams and drags come as words,
    without their grace strokes.
    """
    hands = [note.tick for note in notes if note.piece in HAND_PIECES]
    found: list[Note] = []
    for at, note in enumerate(notes):
        can = at in chosen and note.piece in DRUMS and hands.count(note.tick) == 1
        found += _dressed(note, hands, touch, rng) if can else [note]
    return found


def _dressed(note: Note, hands: Sequence[int], touch: Touch, rng: Generator) -> list[Note]:
    before_s = min((note.tick - t for t in hands if t < note.tick), default=note.tick) * touch.tick_s
    after_s = min((t - note.tick for t in hands if t > note.tick), default=touch.beat_ticks) * touch.tick_s
    kind = rng.choice(3, p=_shares(touch))
    if kind == 0:
        graced = Ornament.FLAM if note.velocity >= _LOUD or rng.random() < 0.5 else Ornament.DRAG
        return [replace(note, ornament=graced)] if before_s >= ROOM_BEFORE_S[graced] else [note]
    if kind == 1:
        half = int(min(after_s / touch.tick_s / 2, touch.beat_ticks / 8))
        pair = replace(note, ornament=Ornament.DIDDLE)
        return [pair, replace(pair, tick=note.tick + half)] if half * touch.tick_s >= DIDDLE_S else [note]
    if note.piece is not Piece.SNARE or after_s < BUZZ_S[0]:
        return [note]
    ticks = int(min(after_s, BUZZ_S[1]) / touch.tick_s * 0.8)  # the stick leaves before the next stroke
    return [replace(note, ornament=Ornament.ROLL, articulation=Articulation.BUZZ, duration_ticks=ticks)]


def _shares(touch: Touch) -> tuple[float, float, float]:
    whole = touch.graced + touch.doubled + touch.buzzed
    return touch.graced / whole, touch.doubled / whole, touch.buzzed / whole
