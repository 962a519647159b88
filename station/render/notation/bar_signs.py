"""What stands at a bar line where time rolls by: the line or a repeat sign, numbers, endings, meters, tempi and feel.

A score on the screen is written out as it is played: repeat signs stand where a loop is played again, and the bracket
of an ending over its bars in every pass. Units are staff spaces, y down, x from the bar's first beat.
"""

from collections.abc import Mapping

import numpy as np

from station.core.units import PPQ
from station.music.repeats import Passage, folded
from station.music.score import Score
from station.music.tempo import MeterChange
from station.music.tempo_words import TempoWord, read_tempo_words
from station.render.notation.bar_lines import BarLine, Volta, draw_slim_line, draw_volta
from station.render.notation.beams import Anchor
from station.render.notation.beat_note import draw_beat_note
from station.render.notation.chord_width import GRACE, GRACE_GAP, GRACE_STEP
from station.render.notation.head_places import EDGE_X
from station.render.notation.sheet_words import RAMPS
from station.render.notation.swing_words import SwingMark, draw_swing_mark
from station.render.palette import BRAND, INK, INK_SOFT
from station.render.snapshot import BarNumbers
from station.render.text.draw_list import DrawList, TypeStyle
from station.render.text.fonts import Face

_LINE_X = -1.25
"""Where a bar line stands."""
_LINE_GAP = 0.5
"""Between the line and the grace notes before the first beat, as between it and a head."""
_NUMBER_X = 0.35
"""A bar's number begins so far left of its line: clear of what stands over the first beat."""
_VOLTA_UP, _VOLTA_ENDS = 1.25, (-1.95, -2.4)
"""The bracket of an ending stands so far above the words' line, its number among them, and from the bar's own number to
that of the next one."""
_NUMBER, _SECTION, _WORD, _ENDING = (
    TypeStyle(1.25, INK_SOFT, Face.BOLD),
    TypeStyle(1.5, INK, Face.BOLD),
    TypeStyle(1.5, BRAND, Face.BOLD),
    TypeStyle(1.25, BRAND, Face.BOLD),
)
_LONGEST_NAME = 12
"""Letters of a section's name, of which a bar that rolls by has room for so many (our choice)."""
_WORD_GAP = 0.9
"""Meters and tempi stand above the staff beside the bar's number, so far apart: time leaves no room between notes."""


class BarSigns:
    """What stands at the bar lines of `score`; `numbers` says which bars come again, `beat_ticks` what tempi count.

    `swing` are the marks by bar, from 0.
    """

    def __init__(self, score: Score, numbers: BarNumbers, beat_ticks: int, swing: Mapping[int, SwingMark]) -> None:
        self._score, self._numbers, self._beat_ticks = score, numbers, beat_ticks
        self._tempo_words = read_tempo_words(score.tempo_map)
        self._has_pickup = numbers.first == 0 and _begins_with_pickup(score, numbers)
        self._swing = swing
        self._voltas = _voltas(score, numbers)

    def draw_line(self, draw_list: DrawList, bar: int, closes: bool = True, opens: bool = True) -> None:
        """The line on the left of `bar`: what it `closes` of the bar before, and what it `opens`."""
        begins, ends = opens and self._begins_pass(bar), closes and self._ends_pass(bar)
        line = BarLine.FINAL if bar == self._score.bar_count else BarLine.PLAIN
        if begins or ends:
            both = BarLine.REPEAT_BOTH if begins and ends else BarLine.REPEAT_START
            line = both if begins else BarLine.REPEAT_END
        draw_slim_line(draw_list, self._line_x(bar), line, INK_SOFT)

    def _line_x(self, bar: int) -> float:
        """Where the line on the left of `bar` stands: before the grace notes of its first beat."""
        score = self._score
        first = score.notes["tick"] == score.tempo_map.bar_start(bar)
        graces = score.notes["piece"][first & score.is_grace]
        if not len(graces):
            return _LINE_X
        most = int(np.unique(graces, return_counts=True)[1].max())
        return -(EDGE_X + GRACE_GAP + GRACE_STEP * (most - 1) + EDGE_X * GRACE + _LINE_GAP)

    def _begins_pass(self, bar: int) -> bool:
        """Whether a pass of a loop begins with the bar."""
        loop, passes = self._numbers.per_pass, self._passes
        return passes > 1 and bar % loop == 0 and bar // loop < passes

    def _ends_pass(self, bar: int) -> bool:
        """Whether a pass of a loop ends before the bar that is not the last one."""
        loop, passes = self._numbers.per_pass, self._passes
        is_last = bar // loop == self._numbers.passes if loop else True
        return passes > 1 and bar > 0 and bar % loop == 0 and bar // loop <= passes and not is_last

    @property
    def _passes(self) -> int:
        """How often the loop is played; 0 where there is none."""
        loop, passes = self._numbers.per_pass, self._numbers.passes
        fitting = self._score.bar_count // loop if loop else 0
        return fitting if passes is None else min(passes, fitting)

    def draw_words(self, anchor: Anchor, bar: int, y: float) -> None:
        """The words above the bar, their line at `y`; nothing after the last one."""
        tempo = self._score.tempo_map
        start, end = tempo.bar_start(bar), tempo.bar_start(bar + 1)
        if start >= self._score.end_tick:
            return
        anchor.at(start)
        draw_list, x = anchor.draw_list, _LINE_X
        number = "" if self._is_pickup(bar) else str(self._numbers.of(bar))
        x += _NUMBER_X + draw_list.text(number, (x - _NUMBER_X, y), _NUMBER)
        if name := self._numbers.section_of(bar):
            x += _WORD_GAP + draw_list.text(_short(name), (x + _WORD_GAP / 2, y), _SECTION)
        if (volta := self._voltas.get(bar)) is not None:
            x += _WORD_GAP / 2 + self._draw_volta(anchor, (start, end), (x, y), volta)
            anchor.at(start)
        if word := self._meter_word(bar):
            x += _WORD_GAP + draw_list.text(word, (x, y), _WORD)
        if (mark := self._swing.get(bar)) is not None:
            x += _WORD_GAP + draw_swing_mark(draw_list, (x, y), _WORD.size, mark, BRAND)
        for change in self._tempo_words:
            if start <= change.tick < end:
                self._draw_tempo(anchor, change, (x if change.tick == start else -0.6, y))

    def meter_of(self, bar: int) -> MeterChange:
        """The meter under which the bar is written: a pick-up's is that of the bar after it."""
        tempo = self._score.tempo_map
        return tempo.meter_at(tempo.bar_start(bar + 1 if self._is_pickup(bar) else bar))

    def _is_pickup(self, bar: int) -> bool:
        return self._has_pickup and (bar % self._numbers.per_pass if self._numbers.per_pass else bar) == 0

    def _meter_word(self, bar: int) -> str:
        """The new meter of the bar; empty where there is none."""
        word = str(self.meter_of(bar))
        return word if bar and word != str(self.meter_of(bar - 1)) else ""

    def _draw_tempo(self, anchor: Anchor, word: TempoWord, at: tuple[float, float]) -> None:
        """A new tempo, or where it grows faster or slower and to which."""
        draw_list, (left, y) = anchor.draw_list, at
        anchor.at(word.tick)
        if word.way:
            left += _WORD_GAP / 2 + draw_list.text(RAMPS[word.way], (left, y), _WORD)
        left = draw_beat_note(draw_list, (left, y), 1.0, self._beat_ticks, BRAND)
        draw_list.text(f"= {word.tempo_bpm * PPQ / self._beat_ticks:.0f}", (left, y), _WORD)

    def _draw_volta(self, anchor: Anchor, ticks: tuple[int, int], at: tuple[float, float], volta: Volta) -> float:
        """The bracket over a bar of an ending, its number at a place; returns how long that is."""
        (x, y), bracket = at, Volta("", volta.opens, volta.closes)
        anchor.at(ticks[0])
        anchor.until(ticks[1])
        draw_volta(anchor.draw_list, _VOLTA_ENDS, y - _VOLTA_UP, bracket, BRAND)
        anchor.draw_list.span_s = 0.0
        return anchor.draw_list.text(volta.text, (x + 0.2, y), _ENDING) if volta.text else 0.0


def _begins_with_pickup(score: Score, numbers: BarNumbers) -> bool:
    """Whether the first pass does."""
    end_tick = min(score.tempo_map.bar_start(numbers.per_pass or score.bar_count), score.end_tick)
    return score.tempo_map.section(0, end_tick).pickup_ticks(end_tick) > 0


def _short(name: str) -> str:
    return name if len(name) <= _LONGEST_NAME else f"{name[: _LONGEST_NAME - 1].rstrip()}…"


def _voltas(score: Score, numbers: BarNumbers) -> dict[int, Volta]:
    """The brackets over the bars as they are played, each with the pass that it is."""
    loop = numbers.per_pass or score.bar_count
    found, start = dict[int, Volta](), 0
    for passage in folded(score.bars(0, min(loop, score.bar_count) - 1), dict(numbers.sections)):
        for number in range(passage.times):
            if passage.endings:
                end = start + (number + 1) * passage.pass_length
                found |= _of_ending(passage, number, end)
        start += passage.times * passage.pass_length
    if not found:
        return {}
    return {bar: found[bar % loop] for bar in range(score.bar_count) if bar % loop in found}


def _of_ending(passage: Passage, number: int, end: int) -> dict[int, Volta]:
    """The bracket of a pass, from 0, that ends before bar `end`."""
    ending = passage.endings[0]
    first = end - (ending.last_bar - ending.first_bar + 1)
    return {
        bar: Volta(f"{number + 1}." if bar == first else "", bar == first, bar == end - 1) for bar in range(first, end)
    }
