"""What one player can play of the music, and what is beyond two hands and two feet.

Asked moment by moment first (three hands, one limb in two places, an open hi-hat that the foot shuts), then of the
speed of each limb, for the music once and again from its end. What is left out is beyond the player and stays in the
lesson as such; an ornament's grace strokes, for which a hand is missing, go without a trace but a count.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import groupby

from station.core.pieces import HALF_OPEN, Articulation, Limb, Ornament, Piece
from station.drills.grid.tab_symbols import BEYOND_SYMBOLS, FOOT_OF, family_of
from station.drills.transcription.strokes.two_feet import with_both_feet
from station.motion.feasibility.playable import MAX_HANDS, unplayable_rows
from station.music.grace_strokes import Graces, with_graces
from station.music.score import Note, Score
from station.music.tempo import TempoMap

_SET_FIRST = (Piece.PERCUSSION, Piece.CLAP, Piece.TAMBOURINE, Piece.COWBELL)
"""What is left out before anything of the drum set."""


@dataclass(frozen=True, slots=True)
class Reach:
    """Main strokes that the player can make, and those `beyond`, each in order.

    `merged` counts strokes that fell into one cell with a louder one of their piece, `plain` has those of `asked` that
    lost their grace strokes.
    """

    asked: tuple[Note, ...]
    beyond: tuple[Note, ...]
    merged: int
    plain: tuple[Note, ...]

    @property
    def marks(self) -> frozenset[tuple[int, Piece]]:
        """Tick and piece of what is beyond the player."""
        return frozenset((n.tick, n.piece) for n in self.beyond)


_Asked = dict[int, Note]
"""Strokes by their place in the music; their ornament and limb may have changed."""


def within_reach(notes: Sequence[Note], graces: Graces, tempo_map: TempoMap, end_tick: int) -> Reach:
    """The main strokes `notes` parted into what one player can make and what is beyond them."""
    single = with_both_feet(_single(notes), tempo_map)
    asked = _at_once(single)
    for times in (1, 2):
        asked = _possible(asked, graces, Score.from_notes((), tempo_map, end_tick), times)
    cells = {(n.tick, n.piece) for n in asked.values()}
    beyond: dict[tuple[int, Piece], Note] = {}
    for i, note in enumerate(single):
        if i not in asked and (note.tick, note.piece) not in cells:
            beyond.setdefault((note.tick, note.piece), _mark(note))
    kept = [n for _, n in sorted(asked.items())]
    return Reach(
        tuple(kept),
        tuple(beyond.values()),
        merged=len(notes) - len(kept) - len(beyond),
        plain=tuple(n for i, n in sorted(asked.items()) if _is_graced(single[i]) and not _is_graced(n)),
    )


def _mark(note: Note) -> Note:
    """The stroke as the lesson keeps it: when and on what, and no more."""
    symbol = BEYOND_SYMBOLS[family_of(note.piece)]
    return Note(
        note.tick,
        note.piece,
        symbol.zone,
        articulation=symbol.articulation,
        limb=FOOT_OF.get(note.piece, Limb.UNKNOWN),
        openness=symbol.openness,
        swing_ticks=note.swing_ticks,
    )


def _is_graced(note: Note) -> bool:
    return bool(Graces().leads_ms(note.ornament))


def _alone(note: Note) -> Note:
    """The note without grace strokes, for which no hand is left."""
    return replace(note, ornament=Ornament.NONE) if _is_graced(note) else note


def _single(notes: Sequence[Note]) -> list[Note]:
    """Of strokes on one piece at one moment, the loudest; both where two hands are named."""
    kept: dict[tuple[int, Piece, Limb], Note] = {}
    limbs: dict[tuple[int, Piece], list[Limb]] = {}
    for note in sorted(notes, key=lambda n: -n.velocity):
        twins = limbs.setdefault((note.tick, note.piece), [])
        if all(Limb.UNKNOWN not in (twin, note.limb) and twin is not note.limb for twin in twins):
            twins.append(note.limb)
            kept[(note.tick, note.piece, note.limb)] = note
    return sorted(kept.values(), key=lambda n: (n.tick, n.piece))


# --- one moment -------------------------------------------------------------------------------------------------------


def _at_once(notes: Sequence[Note]) -> _Asked:
    """What two hands and two feet can strike at once; the sticking goes where it asks for one hand twice."""
    asked: _Asked = {}
    for _, group in groupby(enumerate(notes), key=lambda pair: pair[1].tick):
        together = list(group)
        feet = [(i, n) for i, n in together if n.piece in FOOT_OF]
        hands = sorted(((i, n) for i, n in together if n.piece not in FOOT_OF), key=lambda p: _importance(p[1]))
        hands = hands[:MAX_HANDS]
        if len(hands) == MAX_HANDS:
            hands = [(i, _alone(n)) for i, n in hands]
            if hands[0][1].limb is hands[1][1].limb:
                hands = [(i, replace(n, limb=Limb.UNKNOWN)) for i, n in hands]
        if any(n.piece is Piece.HIHAT and (n.openness or 0) >= HALF_OPEN for _, n in hands):
            feet = [(i, n) for i, n in feet if n.articulation is not Articulation.CHICK]
        by_limb = {n.limb: (i, n) for i, n in reversed(feet)}
        asked |= dict([*hands, *by_limb.values()])
    return dict(sorted(asked.items()))


def _importance(note: Note) -> tuple[int, int]:
    return _SET_FIRST.index(note.piece) + 1 if note.piece in _SET_FIRST else 0, -note.velocity


# --- one after the other ----------------------------------------------------------------------------------------------


def _possible(asked: _Asked, graces: Graces, empty: Score, times: int) -> _Asked:
    """The strokes that can be made so many times on end; ornaments lose grace strokes that come too soon."""
    rows = [(i, row) for i, note in asked.items() for row in with_graces(note, graces)]
    rows.sort(key=lambda pair: (pair[1].tick, -pair[1].lead_ms, pair[1].piece))
    score = Score.from_notes([row for _, row in rows], empty.tempo_map, empty.end_tick).repeated(times)
    kept = dict(asked)
    for index, row in (rows[i % len(rows)] for i in unplayable_rows(score).tolist()):
        if not row.lead_ms:
            kept.pop(index, None)
        elif index in kept:
            kept[index] = _alone(kept[index])
    return kept
