"""The lines of the grid that some bars of a score are written with: letters, sticking and limb tables.

The reverse of `cell_strokes` and `sticking_line`. Strokes whose hands a sticking line can say are written with one; the
others go to `right_hand.…` and `left_hand.…` lines. Whatever has no letter raises `BadInput` with its bar.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from station.core.errors import BadInput
from station.core.pieces import USUAL_FEET, Articulation, Limb, Ornament, Piece, word
from station.drills.grid.grid_writer import LineText
from station.drills.grid.skeletons import GridMark
from station.drills.grid.sticking_line import BOTH, HANDS, RIGHT_FIRST, STICKING
from station.drills.grid.tab_symbols import (
    BEYOND,
    LETTER_OF,
    LINE_ORDER,
    LINE_PIECES,
    TabSymbol,
    family_of,
    key_of_piece,
)
from station.music.grace_strokes import Graces
from station.music.score import Note, Score

_HAND_LETTER = {limb: letter for letter, limb in HANDS.items()}


@dataclass(frozen=True, slots=True)
class WrittenStroke:
    """One letter to be: the note that it stands on, and the second stroke of a diddle; or one beyond the player."""

    note: Note
    bar: int
    start: int  # tick of the bar
    second_tick: int | None = None
    is_beyond: bool = False

    @property
    def letter(self) -> str:
        """The letter that plays it; raises `BadInput` if none does."""
        note = self.note
        if self.is_beyond:
            return BEYOND
        is_diddle = self.second_tick is not None
        ornament = Ornament.DIDDLE if is_diddle else note.ornament
        meaning = TabSymbol(note.zone, note.articulation, note.dynamic, note.openness, ornament)
        found = LETTER_OF[family_of(note.piece)].get(meaning)
        if found is None:
            what = f"{word(note.piece)}: {word(note.zone)}, {word(note.articulation)}, {word(note.dynamic)}"
            raise BadInput("score", f"bar {self.bar + 1}", f"no letter of the grid plays this stroke ({what})")
        return found

    @property
    def mark(self) -> GridMark:
        """The letter with its ticks from the start of the bar."""
        note, at = self.note, self.note.tick - self.start
        lasts = note.duration_ticks or note.choke_ticks
        is_buzz = note.articulation is Articulation.BUZZ
        return GridMark(
            self.letter,
            at,
            second=None if self.second_tick is None else self.second_tick - self.start,
            until=at + lasts if lasts else None,
            holds=is_buzz,
            late_ms=_tidy_ms(note.late_ms),
        )


def strokes_by_bar(score: Score, beyond: NDArray[np.void]) -> dict[int, list[WrittenStroke]]:
    """The letters to be written for a score, and for what is `beyond` the player in it, by bar from 0."""
    by_bar: dict[int, list[WrittenStroke]] = {}
    more = Score.from_array(beyond, score.tempo_map, score.end_tick)
    bars = zip(more, more.bar.tolist(), strict=True)
    marks = [WrittenStroke(note, bar, score.tempo_map.bar_start(bar), is_beyond=True) for note, bar in bars]
    for stroke in (*_strokes(score), *marks):
        by_bar.setdefault(stroke.bar, []).append(stroke)
    return by_bar


def lines_of(by_bar: Mapping[int, Sequence[WrittenStroke]], first_bar: int, last_bar: int) -> list[LineText]:
    """The lines for bars `first_bar` to `last_bar`, top to bottom; in a line bars count from 0 at its start."""
    by_tick: dict[int, list[WrittenStroke]] = {}
    for bar in range(first_bar, last_bar + 1):
        for stroke in by_bar.get(bar, ()):
            by_tick.setdefault(stroke.note.tick, []).append(stroke)
    lines: dict[str, LineText] = {}
    sticking = LineText(STICKING, {}, [])
    for together in by_tick.values():
        hands = [s for s in together if not (s.is_beyond or _is_foot(s.note.limb) or s.note.piece in USUAL_FEET)]
        said = _sticking_letter(hands)
        bar = together[0].bar - first_bar
        if said:
            sticking.marks.setdefault(bar, []).append(GridMark(said, together[0].mark.at))
        for stroke in together:
            name = _line_name(stroke.note, said_below=bool(said) and stroke in hands)
            line = lines.setdefault(name, LineText(name, {}, []))
            line.marks.setdefault(bar, []).append(stroke.mark)
    if sticking.marks:
        lines[STICKING] = sticking
    return sorted(lines.values(), key=lambda line: line_height(line.name))


def graces_of(score: Score) -> Graces:
    """The grace strokes of flams and drags as the first of each has them; the usual ones where there are none."""
    usual = Graces()
    if not score.is_grace.any():
        return usual
    flams = [n.lead_ms for n in score if n.ornament is Ornament.FLAM and n.lead_ms]
    drags = [n.lead_ms for n in score if n.ornament is Ornament.DRAG and n.lead_ms]
    spaced = Graces(
        _tidy_ms(flams[0]) if flams else usual.flam_ms, _tidy_ms(max(drags[:2]) / 2) if drags else usual.drag_ms
    )
    mains = {(n.tick, n.piece): n.velocity for n in score if not n.lead_ms}
    pairs = [(n.velocity, mains[n.tick, n.piece]) for n in score if n.lead_ms and (n.tick, n.piece) in mains]
    loudest = max(pairs, key=lambda pair: pair[1], default=(0, 1))
    shares = [spaced.share, *(round(loudest[0] / loudest[1], d) for d in (1, 2, 3)), *_shares_of(pairs)]
    alike = (replace(spaced, share=share) for share in shares)
    return next(
        (g for g in alike if all(soft == g.velocity(main) for soft, main in pairs)), replace(spaced, share=shares[3])
    )


def _shares_of(pairs: Sequence[tuple[int, int]]) -> list[float]:
    """Where the shares lie that give each (grace stroke, note) its velocities: their middle, by 2 and by 3 decimals."""
    least = max(((soft - 0.5) / main for soft, main in pairs), default=0.0)
    most = min(((soft + 0.5) / main for soft, main in pairs), default=1.0)
    return [round((least + most) / 2, decimals) for decimals in (2, 3)]


def _tidy_ms(lead_ms: float) -> float:
    """The time with the fewest decimals that scores, which keep it in 32 bits, hold alike."""
    return next((t for d in range(7) if np.float32(t := round(lead_ms, d)) == np.float32(lead_ms)), lead_ms)


def _strokes(score: Score) -> Iterable[WrittenStroke]:
    """The main strokes of a score, those of diddles paired; grace strokes follow from the letter."""
    bars, starts = score.bar, [score.tempo_map.bar_start(b) for b in range(score.bar_count)]
    half: dict[Piece, WrittenStroke] = {}
    graces = graces_of(score)
    for i, note in enumerate(score):
        bar = int(bars[i])
        if note.lead_ms > 0:
            if not np.isin(note.lead_ms, np.array(graces.leads_ms(note.ornament), np.float32)):
                raise BadInput("score", f"bar {bar + 1}", f"a grace stroke {note.lead_ms:g} ms before its note")
            continue
        stroke = WrittenStroke(note, bar, starts[bar])
        is_open = note.ornament in (Ornament.DIDDLE, Ornament.ROLL) and note.articulation is not Articulation.BUZZ
        if not is_open:
            yield stroke
        elif note.piece in half:
            first = half.pop(note.piece)
            yield WrittenStroke(first.note, first.bar, first.start, note.tick)
        else:
            half[note.piece] = stroke
    for alone in half.values():
        raise BadInput("score", f"bar {alone.bar + 1}", "a diddle of one stroke")


def _is_foot(limb: Limb) -> bool:
    return limb in (Limb.RIGHT_FOOT, Limb.LEFT_FOOT)


def _sticking_letter(hands: Sequence[WrittenStroke]) -> str:
    """R, L or B where a sticking line can say who plays these strokes of one moment; else empty."""
    limbs = [s.note.limb for s in hands]
    if len(hands) == 1:
        return _HAND_LETTER.get(limbs[0], "")
    if len(hands) == 2:
        right = min(hands, key=lambda s: RIGHT_FIRST.index(s.note.piece))
        if all(s.note.limb is (Limb.RIGHT_HAND if s is right else Limb.LEFT_HAND) for s in hands):
            return BOTH
    return ""


def _line_name(note: Note, *, said_below: bool) -> str:
    """`snare`, or `left_hand.snare` where neither custom nor the sticking line says the limb."""
    name = key_of_piece(note.piece)
    if said_below or note.limb in (Limb.UNKNOWN, USUAL_FEET.get(note.piece)):
        return name
    return f"{word(note.limb)}.{name}"


def line_height(name: str) -> tuple[int, str]:
    """Where the line of this name stands on the page, the top first; the signs stand between hands and feet."""
    last = name.rpartition(".")[2]
    feet = LINE_ORDER.index(Piece.KICK)
    if last not in LINE_PIECES:
        return 2 * feet - 1, {STICKING: ""}.get(last, last)
    return 2 * LINE_ORDER.index(LINE_PIECES[last]), name
