"""Draws the chords of one voice at their anchor: heads, stems, signs above them, sticking, and grace notes.

Units are staff spaces, y down, 0 on the staff's middle line. Proportions follow Gould, "Behind Bars" (2011).
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Articulation, Dynamic, Limb, Piece, Zone
from station.music.score import Score
from station.render.notation.beams import BEAM_STEP, FLAG_STEP, STEM, STEM_X, Anchor, StaffVoice
from station.render.notation.note_shapes import STAFF_LINE, draw_hat_sign, draw_head
from station.render.notation.note_values import TimedValue, Value
from station.render.notation.staff import PLACES, head_of, height, ledger_steps
from station.render.palette import INK, INK_SOFT
from station.render.text.draw_list import TypeStyle
from station.render.text.fonts import Face

STICKING_Y = 7.0
"""Baseline of the R and L below the staff, clear of the accents and numbers below the feet's beams."""
_GRACE = 0.62
_GRACE_STEP = 1.0
_GRACE_GAP = 1.5
_BUZZ_OFF = 1.4
"""From a stem's end to the middle of a buzz's sign on it, clear of one beam."""
_BUZZ_BELOW_FLAG = 3.2
"""And clear of one flag, which is two and a half spaces long."""
_BUZZ_OVER_WHOLE = 1.6
"""And from a whole note's head, which has no stem."""
_HOLLOW = 2
"""Heads of notes from a half on are hollow."""
_BRACKET = 0.55
"""How much farther a dot or a grace stroke stands from a note in brackets."""
LETTERS = {Limb.RIGHT_HAND: "R", Limb.LEFT_HAND: "L"}
OPEN_FROM, _WIDE_FROM = 0.25, 0.75
"""Openness from which a hat is written half open and open (our choice)."""


@dataclass(frozen=True, slots=True)
class Chord:
    """The main strokes of one voice at one place, and the grace strokes before it: indices into the score.

    `tick` is where they sound and stand, `written` the cell in which notation writes them (straight where they swing).
    """

    tick: int
    written: int
    mains: tuple[int, ...]
    graces: tuple[int, ...]
    is_tied: bool = False
    """No stroke, but a roll that goes on: it is tied to the note before it."""


def closing_hats(score: Score) -> NDArray[np.bool_]:
    """Which strokes are the first closed ones after an open hi-hat, shape (n,)."""
    hats = np.flatnonzero(score.notes["piece"] == Piece.HIHAT)
    opened = score.notes["openness"][hats] >= OPEN_FROM
    closing = np.zeros(len(score), np.bool_)
    closing[hats[1:]] = opened[:-1] & (score.notes["openness"][hats[1:]] < OPEN_FROM)
    return closing


class ChordPen:
    """Draws chords of `score` at `anchor`; `limbs` (n,) of `Limb` play them, `closing` (n,) close the hi-hat."""

    def __init__(self, score: Score, limbs: NDArray[np.int8], closing: NDArray[np.bool_], anchor: Anchor) -> None:
        self._notes, self._limbs, self._closing = score.notes, limbs, closing
        self._anchor, self._draw_list = anchor, anchor.draw_list

    def step(self, index: int) -> int:
        """On which step of the staff stroke `index` stands."""
        return PLACES[Piece(int(self._notes["piece"][index]))].step

    def draw(self, chord: Chord, stroke: TimedValue, voice: StaffVoice, beam_y: float) -> None:
        """Heads, stem and signs at the anchor; the stem ends at `beam_y`."""
        heights = [height(self.step(i)) for i in chord.mains]
        root = max(heights) if voice.is_up else min(heights)
        if stroke.value.base > 1:
            self._draw_list.line((voice.stem_x, root), (voice.stem_x, beam_y), STEM, INK)
        for i in chord.mains:
            self._head(i, 0.0, 1.0, is_hollow=stroke.value.base <= _HOLLOW)
            if stroke.value.dots:
                dot_x = 1.15 + (_BRACKET if self._is_bracketed(i) else 0.0)
                self._draw_list.ellipse((dot_x, height(self.step(i) | 1)), (0.2, 0.2), INK)
        if not chord.is_tied:
            self._above(chord, voice, beam_y)
            self._sticking(chord)

    def is_buzz(self, chord: Chord) -> bool:
        """Whether a roll is in the chord."""
        return any(self._notes["articulation"][i] == Articulation.BUZZ for i in chord.mains)

    def draw_buzz(self, chord: Chord, value: Value, voice: StaffVoice, end: tuple[float, bool]) -> None:
        """The sign on the stem, or above a head without one; `end` is the stem's, and whether it bears flags alone."""
        beam_y, has_flags = end
        levels = max(value.beams - 1, 0)
        heights = [height(self.step(i)) for i in chord.mains]
        if value.base == 1:
            at = 0.0, (min(heights) if voice.is_up else max(heights)) + voice.way * _BUZZ_OVER_WHOLE
        elif has_flags and value.beams:
            nearest = (min(heights) if voice.is_up else max(heights)) + voice.way * _BUZZ_OFF
            below = beam_y - voice.way * (_BUZZ_BELOW_FLAG + FLAG_STEP * levels)
            at = voice.stem_x, min(below, nearest) if voice.is_up else max(below, nearest)
        else:
            at = voice.stem_x, beam_y - voice.way * (_BUZZ_OFF + BEAM_STEP * levels)
        self._draw_list.sign("buzz", at, INK)

    def _head(self, index: int, x: float, scale: float, is_hollow: bool = False) -> None:
        row = self._notes[index]
        piece, zone, how = Piece(int(row["piece"])), Zone(int(row["zone"])), Articulation(int(row["articulation"]))
        step = PLACES[piece].step
        y = height(step)
        for line in ledger_steps(step):
            self._draw_list.line(
                (x - 1.05 * scale, height(line)), (x + 1.05 * scale, height(line)), STAFF_LINE, INK_SOFT
            )
        draw_head(self._draw_list, head_of(piece, zone, how), (x, y), scale, is_hollow)
        if self._is_bracketed(index):
            self._draw_list.sign("bracket_left", (x - 1.0 * scale, y), INK, scale)
            self._draw_list.sign("bracket_right", (x + 1.0 * scale, y), INK, scale)
        if how is Articulation.RIM_SHOT:
            self._draw_list.sign("slash", (x, y), INK, scale)
        if row["choke_ticks"] > 0:
            self._draw_list.sign("choke", (x + 1.3, y - 0.7), INK)

    def _is_bracketed(self, index: int) -> bool:
        """Whether brackets say that the stroke is soft; grace strokes are so by themselves."""
        row = self._notes[index]
        return bool(row["dynamic"] == Dynamic.GHOST and row["lead_ms"] == 0)

    def _above(self, chord: Chord, voice: StaffVoice, beam_y: float) -> None:
        """Hi-hat signs and accents, stacked outward from the stem's end."""
        notes, way = self._notes, voice.way
        y = beam_y + way * (0.85 if voice.is_up else 0.65)
        for kind in self._hat_signs(chord):
            draw_hat_sign(self._draw_list, kind, (voice.stem_x, y))
            y += way * 1.15
        if any(notes["dynamic"][i] == Dynamic.ACCENT for i in chord.mains):
            self._draw_list.sign("accent", (voice.stem_x * 0.4, y), INK, 0.95)

    def _hat_signs(self, chord: Chord) -> Iterator[str]:
        notes = self._notes
        for i in chord.mains:
            piece = notes["piece"][i]
            if piece == Piece.HIHAT and notes["openness"][i] >= OPEN_FROM:
                yield "open" if notes["openness"][i] >= _WIDE_FROM else "half"
            elif piece == Piece.HIHAT and self._closing[i]:
                yield "closed"
            elif piece == Piece.HIHAT_PEDAL and notes["articulation"][i] == Articulation.SPLASH:
                yield "open"

    def _sticking(self, chord: Chord) -> None:
        """The hands' letters, grace strokes small before the main stroke as drummers write them (lR, llR)."""
        graces = sorted(chord.graces, key=lambda i: -self._notes["lead_ms"][i])
        text = "".join(LETTERS.get(Limb(int(self._limbs[i])), "").lower() for i in graces)
        text += "".join(sorted({LETTERS.get(Limb(int(self._limbs[i])), "") for i in chord.mains}, reverse=True))
        if text:
            self._draw_list.text(text, (0.0, STICKING_Y), TypeStyle(1.3, INK_SOFT, Face.BOLD, 0.5))

    def draw_graces(self, chord: Chord) -> None:
        """The small notes before it, beamed among themselves and slurred to it."""
        if not chord.graces:
            return
        self._anchor.at(chord.tick)
        count = len(chord.graces)
        notes = self._notes
        gap = _GRACE_GAP + (_BRACKET if any(map(self._is_bracketed, chord.mains)) else 0.0)
        top = min(height(self.step(i)) for i in chord.graces) - 2.4
        stems: list[float] = []
        for k, i in enumerate(sorted(chord.graces, key=lambda i: -notes["lead_ms"][i])):
            x = -gap - (count - 1 - k) * _GRACE_STEP
            self._head(i, x, _GRACE)
            stems.append(x + STEM_X * _GRACE)
            self._draw_list.line((stems[-1], height(self.step(i))), (stems[-1], top), STEM * 0.8, INK)
        if count == 1:
            self._draw_list.sign("flag", (stems[0], top), INK, 0.55)
            self._draw_list.line((stems[0] - 0.55, top + 1.35), (stems[0] + 0.75, top + 0.45), 0.1, INK)
        else:
            for level in range(2):
                self._draw_list.box((stems[0], top + 0.5 * level), (stems[-1] - stems[0], 0.3), INK)
        low = max(height(self.step(i)) for i in chord.graces)
        self._draw_list.sign("slur", (-gap / 2 - 0.1, low + 0.7), INK_SOFT, 0.95)
