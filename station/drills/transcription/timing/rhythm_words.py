"""Which cells every beat is cut into: the simplest rhythm that explains its strokes, as the whole piece speaks.

Music repeats itself. A beat's rhythm, the set of its cells that are struck, is a word; a word that other beats have is
likelier than a new one, the more so where those beats stand at the same place of their bars. The prior is that of the
Chinese restaurant process (Aldous 1985; Goldwater, Griffiths & Johnson 2009 for words): a word costs less the more
beats share it, a new one what its division and its cells cost. Choices and counts are found in turn until they agree.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from math import lgamma, log

import numpy as np

from station.drills.transcription.timing.beat_spans import BeatSpans, Floats, Ints
from station.drills.transcription.timing.divisions import Division, cell_places, divisions_of
from station.drills.transcription.timing.take_fit import Strokes, collision_cost, nearest_cells
from station.music.swing import Swing

NEW_WORDS = 2.0
"""The strength of what is new against what a piece has said (the process's alpha), in beats. Our choice."""
AT_THIS_PLACE = 3.0
"""How many beats at one place of the bar weigh as much as the whole piece. Our choice."""
SILENT_CELL = 2.0
"""What it costs that a word's cell is not struck: about the odds of a missed stroke (our choice)."""
MAX_WORDS = 32
"""The commonest words of a piece that every beat is tried with."""
ROUNDS = 4
"""Choices and counts agree after two or three rounds."""
_CELL_BITS = 16
"""A word is a number: the cells of its division above so many bits, and below a bit for each cell that is struck."""


@dataclass(frozen=True, eq=False)
class Reading:
    """What the strokes are read as: `cells` (s,) that each span is cut into, `place` (n,) where each stroke is meant.

    `place` is 0 to 1 within the stroke's span; `cost` is what all of it costs.
    """

    cells: Ints
    place: Floats
    cost: float


@dataclass(frozen=True, eq=False)
class _Option:
    """One way to read the spans of one kind: what each then costs (s,), its word (s,), and the strokes' places (n,).

    `error` is the cost of the strokes' errors, `cut` that of the word's division, `cells` that of its struck cells.
    """

    error: Floats
    cut: Floats
    cells: Floats
    word: Ints
    place: Floats


@dataclass(frozen=True, eq=False)
class _Kind:
    """The strokes of all spans of one length and nature, over those of these spans alone that have any.

    `which` (n,) are the strokes' indices among all strokes, `spans` (s,) those of their spans among all spans.
    """

    strokes: Strokes
    which: Ints
    spans: Ints
    divisions: tuple[Division, ...]

    @cached_property
    def by_division(self) -> list[_Option]:
        """The spans cut into each division, every stroke on its nearest cell."""
        return [_cut(self, division) for division in self.divisions]


def read(strokes: Strokes, swing: Swing, max_words: int = MAX_WORDS) -> Reading:
    """The likeliest reading of the strokes under `swing`.

    With `max_words` 0 each beat is read for itself, and the piece speaks only through its counts: enough to compare
    one swing with another.
    """
    cells, place = np.ones(len(strokes.spans), np.int64), np.zeros(len(strokes.span))
    cost = 0.0
    for kind in _kinds(strokes, swing):
        cells[kind.spans], place[kind.which], spent = _read_kind(kind, max_words)
        cost += spent
    return Reading(cells, place, cost)


def cells_of(spans: BeatSpans, span: Ints, reading: Reading, swing: Swing) -> Ints:
    """On which cell of its `span` (n,) each stroke of the reading is, from 0; the next beat's start is the last."""
    found = np.zeros(len(span), np.int64)
    for chosen, cells, length in _by_cut(spans, span, reading.cells[span]):
        places = cell_places(cells, length, swing)
        found[chosen] = np.argmin(np.abs(reading.place[chosen, None] - places), axis=1)
    return found


def played_places(spans: BeatSpans, span: Ints, cell: Ints, cells: Ints, swing: Swing) -> Floats:
    """Where in its `span` (n,), 0 to 1, each stroke is played that is on `cell` of `cells`."""
    found = np.zeros(len(span))
    for chosen, count, length in _by_cut(spans, span, cells):
        found[chosen] = cell_places(count, length, swing)[cell[chosen]]
    return found


def _by_cut(spans: BeatSpans, span: Ints, cells: Ints) -> Iterator[tuple[Ints, int, int]]:
    """The strokes whose spans have the same length and as many cells: which, how many, how long in ticks."""
    codes = np.stack([cells, spans.lengths[span]])
    for count, length in np.unique(codes, axis=1).T.tolist():
        yield np.nonzero((codes[0] == count) & (codes[1] == length))[0], count, length


def _kinds(strokes: Strokes, swing: Swing) -> Iterator[_Kind]:
    """The strokes by the kind of their span; spans without a stroke are in none."""
    spans = strokes.spans
    code = spans.lengths * 2 + spans.is_ternary
    struck = np.unique(strokes.span)
    for value in np.unique(code[struck]):
        chosen = np.nonzero(code[strokes.span] == value)[0]
        here = struck[code[struck] == value]
        divisions = divisions_of(bool(value % 2), int(value // 2), swing)
        of_stroke = np.searchsorted(here, strokes.span[chosen])
        own = Strokes(spans.only(here), of_stroke, strokes.place[chosen], strokes.piece[chosen], strokes.spread_s)
        yield _Kind(own, chosen, here, divisions)


def _read_kind(kind: _Kind, max_words: int) -> tuple[Ints, Floats, float]:
    """Of the spans of a kind the cells (s,), of their strokes the places (n,), and what both cost."""
    table = _Table.of(kind.by_division)
    chosen = np.argmin(table.error + table.cut + table.cells, axis=0)
    in_bar = kind.strokes.spans.in_bar
    for _ in range(ROUNDS):
        said = table.said(chosen)
        if max_words:
            spoken = [_spoken(kind, word) for word in _commonest(said, max_words)]
            table = _Table.of([*kind.by_division, *spoken])
        chosen = np.argmin(table.error + table.word_cost(said, in_bar), axis=0)
        if np.array_equal(said, table.said(chosen)):
            break
    chosen = _fewer_words(table, chosen)
    of_stroke = kind.strokes.span
    place = table.place[chosen[of_stroke], np.arange(len(of_stroke))]
    return table.said(chosen) >> _CELL_BITS, place, table.joint_cost(chosen)


def _fewer_words(table: "_Table", chosen: Ints) -> Ints:
    """The choice without the words that the piece does better without, the rarest first.

    Beats that share a slip of the hand make a word of it in choosing by turns, each on the others' account.
    """
    cost = table.joint_cost(chosen)
    words, counts = np.unique(table.said(chosen), return_counts=True)
    for word in words[np.argsort(counts, kind="stable")].tolist():
        said = table.said(chosen)
        concerned = said == word
        others = table.error + _word_cost(table, said[~concerned])
        others[table.word == word] = np.inf
        tried = np.where(concerned, np.argmin(others, axis=0), chosen)
        if (then := table.joint_cost(tried)) < cost:
            chosen, cost = tried, then
    return chosen


# --- options ----------------------------------------------------------------------------------------------------------


def _cut(kind: _Kind, division: Division) -> _Option:
    strokes = kind.strokes
    cell = nearest_cells(strokes, division.places)
    struck = np.zeros((len(strokes.spans), division.cells + 1), np.bool_)
    struck[strokes.span, cell] = True
    inner = struck[:, 1:-1]
    word = (division.cells << _CELL_BITS) + (inner << np.arange(1, division.cells)).sum(axis=1)
    error = strokes.sums(strokes.error_cost(division.places[cell])) + collision_cost(strokes, cell)
    cut = np.full(len(kind.spans), division.cost)
    return _Option(error + division.fine, cut, inner @ division.costs[1:-1], word, division.places[cell])


def _commonest(said: Ints, most: int) -> list[int]:
    """The words with strokes off the beat that more than one span has, at most so many."""
    words, counts = np.unique(said[said & ((1 << _CELL_BITS) - 1) > 0], return_counts=True)
    order = np.argsort(-counts, kind="stable")[:most]
    return [int(words[i]) for i in order if counts[i] > 1]


def _spoken(kind: _Kind, word: int) -> _Option:
    """The spans read as one word: strokes only where it has one, silent cells at a cost."""
    strokes = kind.strokes
    cells = word >> _CELL_BITS
    division = next(d for d in kind.divisions if d.cells == cells)
    inner = [k for k in range(1, cells) if word >> k & 1]
    places = division.places[[0, *inner, cells]]
    cell = nearest_cells(strokes, places)
    struck = np.zeros((len(strokes.spans), len(places)), np.bool_)
    struck[strokes.span, cell] = True
    silent = (~struck[:, 1:-1]).sum(axis=1) * SILENT_CELL
    error = strokes.sums(strokes.error_cost(places[cell])) + collision_cost(strokes, cell)
    cut, struck_cells, words = (np.full(len(kind.spans), x) for x in (division.cost, division.costs[inner].sum(), word))
    return _Option(error + silent + division.fine, cut, struck_cells, words, places[cell])


# --- what the piece has said ------------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class _Table:
    """Options (o) of the spans of a kind: `error`, `cut`, `cells` and `word` (o, s), `place` (o, n); see `_Option`."""

    error: Floats
    cut: Floats
    cells: Floats
    word: Ints
    place: Floats

    @classmethod
    def of(cls, options: list[_Option]) -> "_Table":
        """The options side by side."""
        return cls(
            *(np.stack([getattr(o, name) for o in options]) for name in ("error", "cut", "cells", "word", "place"))
        )

    def said(self, chosen: Ints) -> Ints:
        """The word of each span under the option `chosen` for it (s,)."""
        words: Ints = self.word[chosen, np.arange(len(chosen))]
        return words

    def word_cost(self, said: Ints, in_bar: Ints) -> Floats:
        """What each word (o, s) costs after all that the other spans have said, first of all those at its place."""
        own = (self.word == said).astype(np.float64)
        likely = np.exp(-_word_cost(self, said, own))
        base = 1 << (2 * _CELL_BITS)
        here = _count(self.word + in_bar * base, said + in_bar * base) - own
        at_place = np.bincount(in_bar)[in_bar] - 1
        cost: Floats = -np.log((here + AT_THIS_PLACE * likely) / (at_place + AT_THIS_PLACE))
        return cost

    def joint_cost(self, chosen: Ints) -> float:
        """What errors and words cost together: every word once as a new one, then as one that is known."""
        rows = np.arange(len(chosen))
        words, first, counts = np.unique(self.said(chosen), return_index=True, return_counts=True)
        _, first_cut, words_of_cut = np.unique(words >> _CELL_BITS, return_index=True, return_counts=True)
        new = self.cut[chosen, rows][first][first_cut].sum() + self.cells[chosen, rows][first].sum()
        return float(self.error[chosen, rows].sum() + new + _seating(counts) + _seating(words_of_cut))


def _seating(counts: Ints) -> float:
    """What it costs in the Chinese restaurant process that guests sit so at tables, one for each word."""
    seats = sum(map(lgamma, counts.tolist())) + len(counts) * log(NEW_WORDS)
    return lgamma(counts.sum() + NEW_WORDS) - lgamma(NEW_WORDS) - seats


def _word_cost(table: _Table, said: Ints, own: Floats | float = 0.0) -> Floats:
    """What each word of the table costs after `said`, of which `own` are not to count."""
    total = len(said) - np.max(own, initial=0.0)
    known = np.unique(said)
    cut = _odds(table.cut, _count(table.word >> _CELL_BITS, known >> _CELL_BITS), len(known))
    cost: Floats = -np.log(_odds(-np.log(cut) + table.cells, _count(table.word, said) - own, total))
    return cost


def _odds(new: Floats, count: Floats, total: float) -> Floats:
    """The probability of what was said `count` times of `total`, and costs `new` before it is said."""
    odds: Floats = (count + NEW_WORDS * np.exp(-new)) / (total + NEW_WORDS)
    return odds


def _count(words: Ints, said: Ints) -> Floats:
    """How often each of `words` was said."""
    if not len(said):
        return np.zeros(words.shape)
    known, counts = np.unique(said, return_counts=True)
    at = np.minimum(np.searchsorted(known, words), len(known) - 1)
    return np.where(known[at] == words, counts[at], 0).astype(np.float64)
