"""Bars that come again, folded as a part on paper folds them: repeats and first and second endings.

A score has every bar written out. Two bars are alike if notation writes them alike: the same strokes with sticking,
dynamics and ornaments, the same rolls held into them, the same meter, tempo and loudness. How hard each stroke is
struck (its velocity) is written nowhere and tells no two bars apart.
"""

from bisect import bisect_left, bisect_right
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from types import MappingProxyType

import numpy as np

from station.music.loudness_marks import USUAL
from station.music.score import Score

LONGEST_PASSAGE = 32
"""Bars of a repeated passage at the most: the chorus of a song; whoever reads looks no farther back (our choice)."""
_ENDING_LENGTHS = (1, 2, 3, 4)
_SIGN, _NAMED_SIGN, _ENDINGS = 2.2, 0.2, 0.5
"""What a pair of repeat signs, and endings besides, cost in bars: a fold saves at least three, where a section begins
again by its name at least one (our choice: two bars that are alike are quicker read than two signs)."""
_NO_NAMES: Mapping[int, str] = MappingProxyType({})
_UNWRITTEN = ("velocity", "midi_note")
"""Fields of a stroke that notation does not write."""


@dataclass(frozen=True, slots=True)
class Ending:
    """How a passage ends in its `passes`, from 1: bars `first_bar` to `last_bar`, inclusive, as first played."""

    first_bar: int
    last_bar: int
    passes: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Passage:
    """Bars `first_bar` to `last_bar`, inclusive, from 0, played `times` times, each time with the ending of that pass.

    Without `endings` every pass is these bars alone. Endings are all of one length, in the order of their first pass.
    """

    first_bar: int
    last_bar: int
    times: int = 1
    endings: tuple[Ending, ...] = ()

    @property
    def pass_length(self) -> int:
        """Bars of one pass, with its ending."""
        ending = self.endings[0].last_bar - self.endings[0].first_bar + 1 if self.endings else 0
        return self.last_bar - self.first_bar + 1 + ending

    @property
    def written_bars(self) -> tuple[int, ...]:
        """The bars that stand on paper, in order: the passage, then its endings."""
        spans = [(self.first_bar, self.last_bar), *((e.first_bar, e.last_bar) for e in self.endings)]
        return tuple(bar for first, last in spans for bar in range(first, last + 1))


def folded(score: Score, sections: Mapping[int, str] = _NO_NAMES, apart: Collection[int] = ()) -> list[Passage]:
    """The bars of `score` as passages in order, each bar in one of them, with the fewest bars that are worth it.

    `sections` are names by the bar, from 0, where they begin: within a passage each pass has the same ones in the same
    places, or the passage begins one section. No passage reaches over a bar in `apart`.
    """
    known: dict[_BarForm, _BarForm] = {}  # alike bars are one object, which lists compare at once
    forms = (replace(form, section=sections.get(bar, "")) for bar, form in enumerate(_bar_forms(score)))
    bars = [known.setdefault(form, form) for form in forms]
    ends = sorted({0, len(bars), *(bar for bar in apart if 0 < bar < len(bars))})
    return [passage for first, last in pairwise(ends) for passage in _best(bars, first, last)]


def written_forms(score: Score, known: dict[object, int] | None = None) -> list[tuple[int, str]]:
    """What is written in each bar, as numbers with the loudness that is new there: bars with one form look alike.

    `known` has the forms of other scores by their numbers and gets those of this one, so that bars of both compare.
    """
    return [(form.lasting, form.new[2]) for form in _bar_forms(score, known)]


# --- which bars are alike ---------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class _BarForm:
    """How a bar is written.

    `lasting` numbers all but what is new at its start, though with what that sets; `new` says meter, tempo and loudness
    that are new there, empty where they hold on; `section` is the name of what begins with it.
    """

    lasting: int
    new: tuple[str, str, str]
    section: str = ""


def _bar_forms(score: Score, numbers: dict[object, int] | None = None) -> Iterator[_BarForm]:
    whole, is_beyond = score.whole
    rows = whole.notes.copy()
    for name in _UNWRITTEN:
        rows[name] = 0
    starts = [score.tempo_map.bar_start(bar) for bar in range(score.bar_count + 1)]
    edges = np.searchsorted(rows["tick"], starts).tolist()
    loudness, tempi = _Loudness(score), _Tempi(score)
    held_over = _held_over(score)
    known = {} if numbers is None else numbers
    for bar, (start, end) in enumerate(pairwise(starts)):
        strokes = rows[edges[bar] : edges[bar + 1]].copy()
        strokes["tick"] -= start
        held = tuple((until - start, piece) for tick, until, piece in held_over if tick < start < until)
        meter = score.tempo_map.meter_at(start)
        signature = (meter.beats, meter.unit, meter.groups, end - start)
        small = is_beyond[edges[bar] : edges[bar + 1]].tobytes()
        form = (strokes.tobytes(), small, held, signature, tempi.within(start, end), loudness.within(start, end))
        new_meter = str(meter) if bar == 0 or meter.tick == start else ""
        yield _BarForm(known.setdefault(form, len(known)), (new_meter, tempi.new_at(start), loudness.new_at(start)))


def _held_over(score: Score) -> list[tuple[int, int, int]]:
    """The rolls that last beyond their bar: from which tick, up to which, on which piece."""
    rows = score.notes
    ends = rows["tick"] + rows["duration_ticks"]
    beyond = score.tempo_map.bars_at(np.maximum(ends - 1, rows["tick"])) > score.bar
    return [(int(rows["tick"][i]), int(ends[i]), int(rows["piece"][i])) for i in np.flatnonzero(beyond)]


class _Tempi:
    """The tempi of a score by tick."""

    def __init__(self, score: Score) -> None:
        self._changes = score.tempo_map.tempos
        self._ticks = [change.tick for change in self._changes]

    def within(self, start: int, end: int) -> tuple[tuple[int, int], ...]:
        """The tempo at `start` and what changes before `end`: ticks from the start, microseconds a quarter."""
        first, last = bisect_right(self._ticks, start) - 1, bisect_left(self._ticks, end)
        return tuple((max(t.tick - start, 0), t.us_per_quarter) for t in self._changes[first:last])

    def new_at(self, start: int) -> str:
        """The new tempo at `start`."""
        first, last = bisect_left(self._ticks, start), bisect_right(self._ticks, start)
        return " ".join(str(t.us_per_quarter) for t in self._changes[first:last])


class _Loudness:
    """The marks of a score's loudness by tick."""

    def __init__(self, score: Score) -> None:
        self._marks, self._end = score.loudness, score.end_tick
        self._ticks = [mark.tick for mark in self._marks]

    def within(self, start: int, end: int) -> tuple[tuple[str, int, int], ...]:
        """What holds at `start`, its own marks included, and what follows before `end`."""
        first, last = bisect_right(self._ticks, start) - 1, bisect_left(self._ticks, end)
        held = [(USUAL, 0, 0)] if first < 0 else []
        return (*held, *(self._said(i, start) for i in range(max(first, 0), last)))

    def new_at(self, start: int) -> str:
        """The marks at `start`."""
        first, last = bisect_left(self._ticks, start), bisect_right(self._ticks, start)
        return " ".join(mark.sign for mark in self._marks[first:last])

    def _said(self, i: int, start: int) -> tuple[str, int, int]:
        """A mark with where it stands from `start` and, of a hairpin, where it ends; words hold from wherever."""
        mark = self._marks[i]
        if not mark.is_hairpin:
            return mark.sign, max(mark.tick - start, 0), 0
        until = self._marks[i + 1].tick if i + 1 < len(self._marks) else self._end
        return mark.sign, mark.tick - start, until - start


def _comes_again(bars: Sequence[_BarForm], first: int, again: int, length: int) -> bool:
    """Whether the bars from `again` on are those from `first` on: a repeat sign leads back from the one to the other.

    What holds anyway may stand at the beginning on paper and be left out when it is played again, never the reverse; a
    meter may always be told again.
    """
    one, other = bars[first], bars[again]
    back = all(b in ("", a) for a, b in zip((*one.new[1:], one.section), (*other.new[1:], other.section), strict=True))
    alike = one.lasting == other.lasting and back
    return alike and bars[first + 1 : first + length] == bars[again + 1 : again + length]


# --- the cheapest way to write them -----------------------------------------------------------------------------------


def _best(bars: Sequence[_BarForm], start: int, end: int) -> list[Passage]:
    """The passages that write bars `start` up to `end` at the least cost; plain bars that follow each other are one."""
    costs: dict[int, tuple[float, Passage | None]] = {end: (0.0, None)}
    times: _Times = {}
    for at in range(end - 1, start - 1, -1):
        costs[at] = 1.0 + costs[at + 1][0], None
        for passage in _repeats(bars, at, end, times):
            after = at + passage.times * passage.pass_length
            is_named = bars[at + passage.pass_length].section != ""
            signs = (_NAMED_SIGN if is_named else _SIGN) + _ENDINGS * bool(passage.endings)
            cost = signs + len(passage.written_bars) + costs[after][0]
            if cost < costs[at][0]:
                costs[at] = cost, passage
    return list(_chosen(costs, start, end))


def _chosen(costs: dict[int, tuple[float, Passage | None]], start: int, end: int) -> Iterator[Passage]:
    at = plain = start
    while at < end:
        passage = costs[at][1]
        if passage is None:
            at += 1
            continue
        if plain < at:
            yield Passage(plain, at - 1)
        yield passage
        at = plain = at + passage.times * passage.pass_length
    if plain < end:
        yield Passage(plain, end - 1)


_Times = dict[tuple[int, int, int], int]
"""How often passes follow each other, by their first bar, their length, and how many of their bars are alike."""


def _repeats(bars: Sequence[_BarForm], at: int, end: int, times: _Times) -> Iterator[Passage]:
    """Every passage that begins at `at` and comes again at once; `times` has those that begin later, and gets these."""
    for length in range(1, min(LONGEST_PASSAGE, (end - at) // 2) + 1):
        if bars[at].lasting != bars[at + length].lasting:
            continue
        if (plain := _count(bars, at, (length, length), times)) > 1:
            yield Passage(at, at + length - 1, plain)
        for ending in _ENDING_LENGTHS:
            if 2 * ending <= length and (count := _count(bars, at, (length, length - ending), times)) > plain:
                yield _with_endings(bars, at, (length, ending), count)


def _count(bars: Sequence[_BarForm], at: int, lengths: tuple[int, int], times: _Times) -> int:
    """How often passes of so many bars follow each other whose first ones, so many, are alike, from once on."""
    whole, alike = lengths
    count = 1 + times.get((at + whole, whole, alike), 1) if _comes_again(bars, at, at + whole, alike) else 1
    times[at, whole, alike] = count
    return count


def _with_endings(bars: Sequence[_BarForm], at: int, lengths: tuple[int, int], times: int) -> Passage:
    """The passage of at most so many passes so long with an ending so long.

    Passes that follow each other share an ending if they end alike; where an earlier ending comes back the passage
    stops: who has gone on to the second never returns to the first.
    """
    whole, ending = lengths
    endings: list[Ending] = []
    forms: list[Sequence[_BarForm]] = []
    for number in range(1, times + 1):
        first = at + number * whole - ending
        form = bars[first : first + ending]
        if forms and form == forms[-1]:
            endings[-1] = replace(endings[-1], passes=(*endings[-1].passes, number))
        elif form in forms:
            times = number - 1
            break
        else:
            endings.append(Ending(first, first + ending - 1, (number,)))
            forms.append(form)
    return Passage(at, at + whole - ending - 1, times, tuple(endings))
