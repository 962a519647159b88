"""Strokes as somebody can play them: limbs written, and what no two hands and two feet can do left out.

What is left out is least missed: where more than two strokes of hands fall together the timekeeper goes first, then the
softer. Limbs are those of `motion.sticking` on the usual kit; what they cannot reach in time goes as well.
"""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from functools import cache

import numpy as np

from station.core.pieces import CYMBALS, HAND_PIECES, Ornament, Piece
from station.motion.feasibility.playable import MAX_HANDS, unplayable_rows
from station.motion.kit.kit import Kit, load_kit
from station.motion.sticking.limbs import limbs_and_reasons
from station.music.grace_strokes import with_graces
from station.music.score import Note, Score
from station.practice.battle.ground import Ground

_ROUNDS = 6
"""Each round leaves strokes out, and other limbs may then play the rest; two rounds are usual (our choice)."""
_TIMEKEEPERS = frozenset({Piece.HIHAT, Piece.RIDE, Piece.RIDE_2})
_GRACED = (Ornament.FLAM, Ornament.DRAG)


def limbed(notes: Iterable[Note], ground: Ground, bars: int) -> Score:
    """The score of those strokes of `notes`, without grace strokes, that can be played together, with both.

    `notes` in any order, none outside the `bars`; of two on one piece and tick the louder counts.
    """
    kept = _two_hands(_once_a_piece([n for n in notes if 0 <= n.tick < bars * ground.bar_ticks]))
    return playable(_score(kept, ground, bars))


def playable(score: Score) -> Score:
    """The score with limbs, without the strokes that these cannot play; those that are written stay as they are."""
    written = score.notes["limb"]
    for _ in range(_ROUNDS):
        limbs, _ = limbs_and_reasons(score, usual_kit())
        score = score.with_limbs(limbs)
        out = _with_their_mains(score, unplayable_rows(score).tolist())
        if not out:
            return score
        kept = np.setdiff1d(np.arange(len(score)), sorted(out))
        written = written[kept]
        rows = score.notes[kept].copy()
        rows["limb"] = written
        score = Score.from_array(rows, score.tempo_map, score.end_tick)
    return score


@cache
def usual_kit() -> Kit:
    """The kit on which phrases are thought out: the usual one."""
    return load_kit()


def _score(notes: Sequence[Note], ground: Ground, bars: int) -> Score:
    whole = [stroke for note in notes for stroke in with_graces(note)]
    return Score.from_notes(whole, ground.tempo_map, bars * ground.bar_ticks)


def _once_a_piece(notes: Sequence[Note]) -> list[Note]:
    """Of strokes on one piece and tick the loudest."""
    loudest: dict[tuple[int, Piece], Note] = {}
    for note in notes:
        at = note.tick, note.piece
        if at not in loudest or note.velocity > loudest[at].velocity:
            loudest[at] = note
    return list(loudest.values())


def _two_hands(notes: Sequence[Note]) -> list[Note]:
    """As many strokes of hands at each tick as there are hands; a flam or drag needs both."""
    moments: dict[int, list[Note]] = {}
    for note in notes:
        if note.piece in HAND_PIECES:
            moments.setdefault(note.tick, []).append(note)
    kept = [note for note in notes if note.piece not in HAND_PIECES]
    for some in moments.values():
        some.sort(key=_missed, reverse=True)
        kept += [_alone(some[0])] if len(some) == 1 else [_plain(note) for note in some[:MAX_HANDS]]
    return kept


def _missed(note: Note) -> tuple[bool, int]:
    """How much a stroke would be missed."""
    return note.piece not in _TIMEKEEPERS, note.velocity


def _alone(note: Note) -> Note:
    """A stroke that has both hands; a cymbal has no grace strokes."""
    return _plain(note) if note.piece in CYMBALS | {Piece.HIHAT} else note


def _plain(note: Note) -> Note:
    return replace(note, ornament=Ornament.NONE) if note.ornament in _GRACED else note


def _with_their_mains(score: Score, out: Sequence[int]) -> set[int]:
    """Rows to leave out, and with a main stroke its grace strokes, and with a grace stroke the others of its main."""
    rows = set(out)
    notes = score.notes
    for row in out:
        if notes["ornament"][row] in _GRACED:
            same = (notes["tick"] == notes["tick"][row]) & (notes["piece"] == notes["piece"][row])
            rows |= set(np.flatnonzero(same & (score.is_grace | ~score.is_grace[row])).tolist())
    return rows
