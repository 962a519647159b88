"""The rows above and below a staff: what stands next to the notes, then sticking, bar numbers and words, loudness.

Each row lies beyond everything that a chord of the score stacks on its stem, so that nothing in it can meet a note's
signs. The hands' letters stand above, at their stems' ends, the feet's below: none can be read as the other's.
Units are staff spaces, y down, 0 on the staff's middle line.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby, pairwise
from operator import attrgetter

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Articulation, Dynamic, Limb, Ornament, Piece
from station.core.units import PPQ
from station.music.score import Score
from station.render.notation.rests import rest_edge
from station.render.notation.staff import FOOT_PIECES, height, step_of
from station.render.notation.staff_strokes import StaffStroke, staff_strokes
from station.render.notation.whole_score import whole_score
from station.render.text.sign_outlines import BEAM, BEAM_STEP, sign_box

_UP_BEAM_Y, _DOWN_BEAM_Y = -5.5, 5.0
"""Stems of a voice reach at least here, so that beams stand level along the line: 3 spaces beyond the hi-hat's head, 3½
beyond the kick's."""
_FLAGGED = 3.75
"""And so far beyond a head with flags, which are three and a quarter long: Gould's stems of 3½ spaces clear round
heads, but not the corners of crosses."""
_OVER_DOT, _OVER_BUZZ, _OVER_SLASH = 0.25, 1.4, 0.8
"""And as much farther where a dot stands half a space above the head, or a buzz or the first slash on the stem, and for
each slash more."""
_UNDER_BUZZ = 0.95
"""And under beams with a buzz on a stem, which is so high."""
_BARE_STAFF = 2.75
"""Where a voice without strokes has its edge: the staff's, and a head beside it."""
_BEAMED, _UNDER_BEAM = 2.0, 1.0
"""And with beams, whose innermost lies so far from the head's middle: clear of brackets, too."""
OPEN_FROM, WIDE_FROM = 0.25, 0.75
"""Openness from which a hat is written half open and open (our choice)."""
STACK_GAP = 0.3
"""Between two signs on top of each other (Gould, "Behind Bars": at least a quarter of a space)."""
TUPLET_SCALE = 0.75
"""Of the font's figures for tuplets, which are set for orchestral parts: a little taller than a space (our choice)."""
TUPLET_HEIGHT = sign_box("tuplet_0").height * TUPLET_SCALE + 2 * STACK_GAP
"""What a tuplet's number and bracket take."""
_LETTERS, _WORDS, _LOUDNESS = 1.6, 1.9, 2.9
"""What rows of letters, of words and of loudness take, with the gap before them."""
_SWING_WORDS = 2.6
"""And a row of words with the mark of a swing, whose triplet has a bracket above it."""
LETTER_LINE = 1.3
"""From one letter to that of the other hand over it."""
_UNDER_WORD = 0.7
"""What the letter f has below its baseline."""
_WEAKEST_FEET = {Piece.KICK: Limb.LEFT_FOOT, Piece.HIHAT_PEDAL: Limb.RIGHT_FOOT}
"""Whose letters say something: the foot that a piece is not played with as a rule."""
_HIHAT, _SPLASH, _ACCENT = int(Piece.HIHAT), int(Articulation.SPLASH), int(Dynamic.ACCENT)
_HATS = (_HIHAT, int(Piece.HIHAT_PEDAL))
_PLAIN_GRID = PPQ // 8
_PLAIN_BEAMS, _FINEST = 2, 5
"""Rests of sixteenths lie within any stem; 128ths have five beams, and nothing finer is written."""


@dataclass(frozen=True, slots=True)
class StaffRows:
    """Baselines of the rows of one score's staff, and how far up and down it reaches with them."""

    top: float
    words: float
    hands: float
    feet: float
    loudness: float
    bottom: float

    @property
    def reach(self) -> tuple[float, float]:
        """From the top to the bottom."""
        return self.top, self.bottom


def closing_hats(score: Score) -> NDArray[np.bool_]:
    """Which strokes are the first closed ones after an open hi-hat, shape (n,); where the foot closes it, none is."""
    notes = score.notes
    is_chick = (notes["piece"] == Piece.HIHAT_PEDAL) & (notes["articulation"] != Articulation.SPLASH)
    hats = np.flatnonzero((notes["piece"] == Piece.HIHAT) | is_chick)
    is_open = (notes["openness"][hats] >= OPEN_FROM) & ~is_chick[hats]
    closing = np.zeros(len(score), np.bool_)
    closing[hats[1:]] = is_open[:-1] & ~is_open[1:] & ~is_chick[hats[1:]]
    return closing


def stacked_signs(mains: Sequence[StaffStroke]) -> list[str]:
    """The signs that stand beyond the stem's end of one chord's main strokes, from there outward."""
    found = [_hat_sign(stroke) for stroke in mains if stroke.piece in _HATS]
    found += ["choke"] * any(stroke.choke_ticks > 0 for stroke in mains)
    found += ["accent"] * any(stroke.dynamic == _ACCENT for stroke in mains)
    return [name for name in found if name]


def _hat_sign(stroke: StaffStroke) -> str:
    if stroke.piece == _HIHAT and stroke.openness >= OPEN_FROM:
        return "hat_open" if stroke.openness >= WIDE_FROM else "hat_half"
    if stroke.piece == _HIHAT and stroke.is_closing:
        return "hat_closed"
    return "hat_open" if stroke.piece != _HIHAT and stroke.articulation == _SPLASH else ""


def stack_height(names: list[str]) -> float:
    """How far such signs reach beyond the stem's end."""
    return sum(sign_box(name).height + STACK_GAP for name in names)


def shown_limbs(score: Score, limbs: NDArray[np.int8]) -> NDArray[np.int8]:
    """The limbs whose letters are written: all hands', and the feet's on pieces that both feet play."""
    shown = limbs.copy()
    for piece, foot in _WEAKEST_FEET.items():
        rows = score.notes["piece"] == piece
        if not (limbs[rows] == foot).any():
            shown[rows] = Limb.UNKNOWN
    return shown


def stem_end(
    heights: Sequence[float],
    is_up: bool,
    beams: int = 1,
    flag_room: float | None = None,
    rests: Sequence[float] = (),
    has_buzz: bool = False,
) -> float:
    """Where the stems of one group of chords end, flags and beams within, whose heads stand at `heights`.

    `beams`: the most that a note of it has; `flag_room`: what is free below its flags (`flag_room`), None where
    none bears any; `rests`: the edges, towards the stems' ends, of rests between its notes;
    `has_buzz`: a buzz is on one of its stems.
    """
    beam = BEAM_STEP * max(beams - 1, 0) + BEAM
    flagged = 0.0 if flag_room is None else _FLAGGED + flag_overhang(beams) + flag_room
    beyond = max(_BEAMED, beam + _UNDER_BEAM + _UNDER_BUZZ * has_buzz, flagged)
    edges = [edge + (-1 if is_up else 1) * (beam + STACK_GAP) for edge in rests]
    if is_up:
        return min(_UP_BEAM_Y, min(heights) - beyond, *edges)
    return max(_DOWN_BEAM_Y, max(heights) + beyond, *edges)


def flag_room(dots: int, is_buzz: bool, slashes: int) -> float:
    """What a note asks for between its head and its flags."""
    on_stem = _OVER_BUZZ if is_buzz or slashes else 0.0
    return max(_OVER_DOT * (dots > 0), on_stem + _OVER_SLASH * max(slashes - 1, 0))


def flag_overhang(count: int) -> float:
    """How far so many flags would reach beyond the point where they hang on the stem."""
    return max(sign_box(f"flag_{4 << count}").top, 0.0) if count else 0.0


def staff_rows(score: Score, limbs: NDArray[np.int8] | None = None, bars: range | None = None) -> StaffRows:
    """The rows of the staff of `score` over its `bars`, None for all of them.

    `limbs` (n,) write its sticking, None those of the score itself.
    """
    score, known, _ = whole_score(score, limbs)
    shown = shown_limbs(score, known)
    is_foot = np.isin(score.notes["piece"], [int(piece) for piece in FOOT_PIECES])
    places = list(_bar_rows(score, bars if bars is not None else range(score.bar_count)))
    rows = np.concatenate([np.arange(first, last) for first, last in places] or [np.arange(0)])
    hands_row = _reach(score, ~is_foot, places, -1) - STACK_GAP
    has_hands = bool(np.isin(shown[rows], (Limb.RIGHT_HAND, Limb.LEFT_HAND)).any())
    words = hands_row - (_LETTERS if has_hands else 0.0) - (LETTER_LINE if _both_hands(score, shown, rows) else 0.0)
    feet = _reach(score, is_foot, places, 1) + _LETTERS
    has_feet = bool(np.isin(shown[rows], (Limb.RIGHT_FOOT, Limb.LEFT_FOOT)).any())
    low = feet if has_feet else feet - _LETTERS
    loudness = low + _LOUDNESS - _UNDER_WORD
    bottom = (low + _LOUDNESS if score.loudness else low) + STACK_GAP
    top = words - (_SWING_WORDS if score.notes["swing_ticks"].any() else _WORDS)
    return StaffRows(top, words, hands_row, feet, loudness, bottom)


def _both_hands(score: Score, shown: NDArray[np.int8], rows: NDArray[np.int64]) -> bool:
    """Whether both hands' letters stand over one place, on top of each other."""
    own = [rows[(shown[rows] == hand) & ~score.is_grace[rows]] for hand in (Limb.RIGHT_HAND, Limb.LEFT_HAND)]
    return bool(np.intersect1d(*(score.notes["tick"][some] for some in own)).size)


def _bar_rows(score: Score, bars: range) -> Iterator[tuple[int, int]]:
    """First stroke of each bar, and the first one after it."""
    starts = [score.tempo_map.bar_start(bar) for bar in range(bars.start, bars.stop + 1)]
    yield from pairwise(np.searchsorted(score.notes["tick"], starts).tolist())


def _reach(score: Score, of_voice: NDArray[np.bool_], places: Sequence[tuple[int, int]], way: int) -> float:
    """How far what is stacked on the chords of one voice reaches at the most, in any bar."""
    strokes = staff_strokes(score, closing=closing_hats(score))
    found = way * _BARE_STAFF
    for first, last in places:
        own = (first + np.flatnonzero(of_voice[first:last])).tolist()
        if own:
            reach = _bar_reach(score.notes[own], [strokes[i] for i in own], way)
            found = min(found, reach) if way < 0 else max(found, reach)
    return found


def _bar_reach(notes: NDArray[np.void], strokes: Sequence[StaffStroke], way: int) -> float:
    """How far the chords of one voice reach in a bar: no nearer than they do once their rhythm is spelled.

    `notes` (n,) and `strokes` are the same rows.
    """
    heights = [height(step_of(Piece(piece))) for piece in set(notes["piece"].tolist())]
    written = notes["tick"] - notes["swing_ticks"]
    beams = _most_beams(written)
    rests = [rest_edge(4 << k, way < 0, ()) for k in range(1, beams + 1)] if beams > _PLAIN_BEAMS else []
    has_marks = (notes["articulation"] == Articulation.BUZZ) | np.isin(
        notes["ornament"], (Ornament.DIDDLE, Ornament.ROLL)
    )
    stem = stem_end(heights, way < 0, beams, flag_room(1, bool(has_marks.any()), 0), rests, bool(has_marks.any()))
    has_tuplets = (written % _PLAIN_GRID != 0).any()
    return stem + way * (_tallest(strokes) + (TUPLET_HEIGHT if has_tuplets else 0.0))


def _most_beams(written: NDArray[np.int64]) -> int:
    """How many beams write the shortest step from stroke to stroke or to a beat, at the most."""
    ticks = np.unique(written)
    beside = np.concatenate([np.diff(ticks), ticks % PPQ, -ticks % PPQ])
    shortest = int(beside[beside > 0].min(initial=PPQ))
    return min((PPQ // shortest).bit_length() - 1, _FINEST)


def _tallest(strokes: Sequence[StaffStroke]) -> float:
    """The highest stack of the chords among `strokes`."""
    chords = groupby((stroke for stroke in strokes if stroke.is_main), key=attrgetter("tick"))
    return max((stack_height(stacked_signs(list(chord))) for _, chord in chords), default=0.0)
