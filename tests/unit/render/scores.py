"""Small scores that tests of the notation share."""

from station.core.pieces import Limb, Piece, Zone
from station.core.units import PPQ
from station.music.score import Note, Score
from station.music.tempo import TempoMap

BAR = 4 * PPQ


def score_of(*notes: Note, tempo_bpm: float = 120.0) -> Score:
    return Score.from_notes(notes, TempoMap.constant(tempo_bpm))


def rock(bars: int = 1) -> Score:
    """Eighths on the hi-hat, backbeat on the snare, kick on one and three."""
    notes: list[Note] = []
    for bar in range(bars):
        start = bar * BAR
        hats = [Note(start + k * PPQ // 2, Piece.HIHAT, Zone.BOW, limb=Limb.RIGHT_HAND) for k in range(8)]
        snares = [Note(start + k * PPQ, Piece.SNARE, limb=Limb.LEFT_HAND) for k in (1, 3)]
        kicks = [Note(start + k * PPQ, Piece.KICK, limb=Limb.RIGHT_FOOT) for k in (0, 2)]
        notes += [*hats, *snares, *kicks]
    return score_of(*notes)
