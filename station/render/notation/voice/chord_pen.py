"""Draws the chords of one voice at their anchor: heads, stems, signs above them, sticking, and grace notes.

Units are staff spaces, y down, 0 on the staff's middle line. Proportions follow Gould, "Behind Bars" (2011), and the
music font (`sign_outlines`).
"""

from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from operator import attrgetter

from station.core.pieces import Articulation, Dynamic
from station.render.notation.beams import Anchor, StaffVoice
from station.render.notation.chord_width import (
    DOT_GAP,
    GRACE,
    GRACE_GAP,
    GRACE_STEP,
    heads_extent,
    sticking,
)
from station.render.notation.head_places import EDGE_X, PlacedHead, placed_heads
from station.render.notation.note_shapes import STEM_FROM, draw_brackets, draw_head, draw_letters, draw_slur
from station.render.notation.spelling.note_values import TimedValue, Value
from station.render.notation.staff import FOOT_PIECES, height, ledger_steps
from station.render.notation.staff_rows import LETTER_LINE, STACK_GAP, StaffRows, stack_height, stacked_signs
from station.render.notation.staff_strokes import StaffStroke
from station.render.palette import INK, INK_SOFT
from station.render.text.sign_outlines import BEAM, BEAM_STEP, LEDGER_LINE, LEDGER_OUT, STEM, sign_box

_BUZZ, _ACCENT, _FOOT_PIECES = int(Articulation.BUZZ), int(Dynamic.ACCENT), frozenset(map(int, FOOT_PIECES))
_TICK = attrgetter("tick")
_BUZZ_OFF, _BUZZ_UNDER_BEAM = 1.4, BEAM + STACK_GAP + sign_box("buzz").height / 2
"""To the middle of a buzz's sign on a stem: below flags from the head, else from the stem's end, clear of one beam."""
_BUZZ_OVER_WHOLE = 1.6
"""And from a whole note's head, which has no stem."""
_GRACE_STEM = 2.4
_GRACE_BEAM, _GRACE_BEAM_STEP = 0.3, 0.5
"""Beams of grace notes, and from one to the next: those of others, as much smaller as the notes are."""
_SLASH = ((-0.55, 1.35), (0.75, 0.45))
"""The ends of the stroke through a single grace note's flag, from its stem's end."""
_SLUR_OFF, _SLUR_BOW = 0.6, 0.4
"""How far below its heads a grace note's slur begins, and how deep it hangs."""


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


class ChordPen:
    """Draws chords of `strokes`, which stand in order of ticks, at `anchor`."""

    def __init__(self, strokes: Sequence[StaffStroke], anchor: Anchor, rows: StaffRows) -> None:
        self._strokes, self._anchor, self._draw_list, self._rows = strokes, anchor, anchor.draw_list, rows

    def step(self, index: int) -> int:
        """On which step of the staff stroke `index` stands."""
        return self._strokes[index].step

    def draw(self, chord: Chord, stroke: TimedValue, voice: StaffVoice, beam_y: float) -> None:
        """Heads, stem and signs at the anchor; the stem ends at `beam_y`."""
        heads = self._placed(chord)
        if stroke.value.base > 1:
            self._stem(heads, voice, beam_y)
        for head in heads:
            self._head(head, stroke.value.base)
        if stroke.value.dots:
            self._dots(chord, heads, stroke.value.dots)
        if not chord.is_tied:
            self._stack(chord, voice, self._stack_from(chord, stroke.value, voice, beam_y))
            self._letters(chord, voice, is_double=stroke.slashes > 0)

    def reach(self, chord: Chord, value: Value, voice: StaffVoice, beam_y: float) -> float:
        """How far up (hands) or down (feet) the chord's stem and what is stacked on it reach."""
        y = self._stack_from(chord, value, voice, beam_y)
        return y if chord.is_tied else y + voice.way * stack_height(self._stacked(chord))

    def is_buzz(self, chord: Chord) -> bool:
        """Whether a roll is in the chord."""
        return any(self._strokes[i].articulation == _BUZZ for i in chord.mains)

    def is_accented(self, chord: Chord) -> bool:
        """Whether a stroke of the chord is."""
        return any(self._strokes[i].dynamic == _ACCENT for i in chord.mains)

    def draw_buzz(self, chord: Chord, value: Value, voice: StaffVoice, end: tuple[float, bool]) -> None:
        """The sign on the stem, or above a head without one; `end` is the stem's, and whether it bears flags alone."""
        beam_y, has_flags = end
        levels = max(value.beams - 1, 0)
        heights = [height(self.step(i)) for i in chord.mains]
        if value.base == 1:
            at = 0.0, (min(heights) if voice.is_up else max(heights)) + voice.way * _BUZZ_OVER_WHOLE
        elif has_flags and value.beams:
            nearest = (min(heights) if voice.is_up else max(heights)) + voice.way * _BUZZ_OFF
            at = voice.stem_x, nearest
        else:
            at = voice.stem_x, beam_y - voice.way * (_BUZZ_UNDER_BEAM + BEAM_STEP * levels)
        self._draw_list.sign("buzz", at, INK)

    def heads_at(self, tick: int, voice: StaffVoice) -> list[int]:
        """The steps of the other voice's heads that stand where a rest of `voice` does, at `tick`."""
        return [s.step for s in self._strokes[self._span(tick)] if (s.piece in _FOOT_PIECES) == voice.is_up]

    def _span(self, tick: int) -> slice:
        """The strokes at `tick`."""
        first = bisect_left(self._strokes, tick, key=_TICK)
        return slice(first, bisect_right(self._strokes, tick, first, key=_TICK))

    # --- heads --------------------------------------------------------------------------------------------------------

    def _at_once(self, chord: Chord) -> list[StaffStroke]:
        """The main strokes that stand where the chord does, its own first, those of the other voice after them."""
        mains = [self._strokes[i] for i in chord.mains]
        if chord.is_tied:
            return mains
        span = self._span(chord.tick)
        there = (i for i in range(span.start, span.stop) if i not in chord.mains)
        return [*mains, *(self._strokes[i] for i in there if self._strokes[i].is_main)]

    def _placed(self, chord: Chord) -> list[PlacedHead]:
        """The heads of the chord, clear of each other and of the other voice's."""
        return placed_heads(self._at_once(chord))[: len(chord.mains)]

    def _stem(self, heads: Sequence[PlacedHead], voice: StaffVoice, beam_y: float) -> None:
        """From the head that is farthest from its end."""
        root = min(heads, key=lambda head: head.step) if voice.is_up else max(heads, key=lambda head: head.step)
        up, down = STEM_FROM.get(root.head, (0.0, 0.0))
        y = height(root.step) - (up if voice.is_up else down) * root.scale
        self._draw_list.line((voice.stem_x, y), (voice.stem_x, beam_y), STEM, INK)

    def _head(self, head: PlacedHead, base: int) -> None:
        y = height(head.step)
        for line in ledger_steps(head.step):
            half = (head.right - head.left) / 2 + LEDGER_OUT * head.scale
            self._draw_list.line((head.x - half, height(line)), (head.x + half, height(line)), LEDGER_LINE, INK_SOFT)
        draw_head(self._draw_list, head.head, (head.x, y), head.scale, base)
        if (pair := head.brackets) is not None:
            draw_brackets(self._draw_list, (pair.left, pair.right), height(pair.step), pair.scale)

    def _dots(self, chord: Chord, heads: Sequence[PlacedHead], count: int) -> None:
        """Right of everything, in the space that the head stands in or the one above its line."""
        right = heads_extent(self._at_once(chord)).right
        for k in range(count):
            x = right + DOT_GAP + sign_box("dot").width * (k + 0.5)
            for step in {head.step | 1 for head in heads}:
                self._draw_list.sign("dot", (x, height(step)), INK)

    # --- beyond the stem's end ----------------------------------------------------------------------------------------

    def _stacked(self, chord: Chord) -> list[str]:
        return stacked_signs([self._strokes[i] for i in chord.mains])

    def _stack_from(self, chord: Chord, value: Value, voice: StaffVoice, beam_y: float) -> float:
        """Where the stack begins: at the stem's end, or beyond the heads of a note that has none."""
        if value.base > 1:
            return beam_y
        heights = [height(self.step(i)) for i in chord.mains]
        off = 0.5 + (_BUZZ_OVER_WHOLE if self.is_buzz(chord) else 0.0)
        return (min(heights) if voice.is_up else max(heights)) + voice.way * off

    def _stack(self, chord: Chord, voice: StaffVoice, y: float) -> None:
        """Hi-hat signs, chokes and accents from `y` outward, over the head as articulations stand."""
        for name in self._stacked(chord):
            tall = sign_box(name).height
            self._draw_list.sign(name, (0.0, y + voice.way * (STACK_GAP + tall / 2)), INK)
            y += voice.way * (STACK_GAP + tall)

    def _letters(self, chord: Chord, voice: StaffVoice, is_double: bool) -> None:
        """The sticking; a diddle's hand twice, as both strokes are its own."""
        strokes = [self._strokes[i] for i in (*chord.graces, *chord.mains)]
        y = self._rows.hands if voice.is_up else self._rows.feet
        for k, text in enumerate(sticking(strokes, voice.is_up)):
            at = 0.0, y + voice.way * LETTER_LINE * k
            draw_letters(self._draw_list, text + text[-1] * is_double, at)

    # --- grace notes --------------------------------------------------------------------------------------------------

    def draw_graces(self, chord: Chord) -> None:
        """The small notes before it, beamed among themselves and slurred to it."""
        if not chord.graces:
            return
        self._anchor.at(chord.tick)
        order = sorted(chord.graces, key=lambda i: -self._strokes[i].lead_ms)
        heads = [placed_heads([self._strokes[i]])[0] for i in order]
        last_x = -heads_extent(self._at_once(chord)).left - GRACE_GAP
        top = min(height(head.step) for head in heads) - _GRACE_STEM
        stems: list[float] = []
        for k, head in enumerate(heads):
            x = last_x - GRACE_STEP * (len(heads) - 1 - k)
            self._head(PlacedHead(head.step, head.head, x, is_foot=False, scale=GRACE), 8)
            stems.append(x + (EDGE_X - STEM / 2) * GRACE)
            self._draw_list.line((stems[-1], height(head.step)), (stems[-1], top), STEM * 0.8, INK)
        self._grace_flag(stems[0], top) if len(stems) == 1 else self._grace_beams(stems, top)
        low = max(height(head.step) for head in heads) + _SLUR_OFF
        draw_slur(self._draw_list, ((stems[0] - EDGE_X * GRACE, low), (-0.1, low)), _SLUR_BOW)

    def _grace_flag(self, x: float, top: float) -> None:
        self._draw_list.sign("flag_8", (x - STEM / 2, top), INK, GRACE)
        (left, low), (right, high) = _SLASH
        self._draw_list.line((x + left, top + low), (x + right, top + high), 0.1, INK)

    def _grace_beams(self, stems: Sequence[float], top: float) -> None:
        for level in range(2):
            at = stems[0], top + _GRACE_BEAM_STEP * level
            self._draw_list.box(at, (stems[-1] - stems[0], _GRACE_BEAM), INK)
