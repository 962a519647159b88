"""Scores that the tests share, written by hand: places in sixteenths unless a division is given."""

from collections.abc import Iterable

from station.core.pieces import CYMBALS, Limb, Piece, Zone
from station.core.units import PPQ
from station.music.score import Note, Score
from station.music.tempo import TempoMap

BACKBEAT = ((4, Piece.SNARE), (12, Piece.SNARE))
EIGHTH_HATS = tuple((i, Piece.HIHAT) for i in range(0, 16, 2))
ROCK = (*EIGHTH_HATS, *BACKBEAT, (0, Piece.KICK), (8, Piece.KICK), (10, Piece.KICK))


def zone_of(piece: Piece) -> Zone:
    if piece in (Piece.CRASH_1, Piece.CRASH_2):
        return Zone.EDGE
    return Zone.BOW if piece in CYMBALS or piece is Piece.HIHAT else Zone.HEAD


def score_of(
    items: Iterable[tuple[int, Piece]], tempo_bpm: float = 100, division: int = 4, velocity: int = 80
) -> Score:
    notes = [Note(i * PPQ // division, p, zone_of(p), velocity) for i, p in items]
    return Score.from_notes(notes, TempoMap.constant(tempo_bpm))


def hand_letters(score: Score, limbs: Iterable[int], piece: Piece) -> str:
    """The hands that play `piece`, in order: "RLRL"."""
    letters = {Limb.RIGHT_HAND: "R", Limb.LEFT_HAND: "L"}
    return "".join(letters[Limb(m)] for n, m in zip(score, limbs, strict=True) if n.piece is piece)
