"""From hits in roughly score time to the matching of least cost: pair, see where the player stands, pair again.

A first pairing within a wide reach shows how the player leans: as a whole, on each piece, and slowly drifting. The
second pairing measures distance from there, with a reach made from the spread that was seen, so that a steady player's
stray hit stays an extra and a beginner's late one is still a late hit. What is left on both sides is then paired across
pieces within a narrower reach (the right time, another piece). All times are integer ns of score time; positive
deviations are late.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_MS, PPQ
from station.music.score import Score
from station.scoring.matching.pairing import Indices, Times, lanes, pair_nearest
from station.scoring.matching.slow_drift import local_trend, median, robust_sd

REACH_SDS = 4.5
"""A pair is likelier than a miss beside an extra out to about 4.4 SD, at 3 % misses and 0.06 extras a second on the
piece (ratio of the normal density to the product of the two rates)."""

MIN_REACH_MS, FIRST_REACH_MS, MAX_REACH_MS = 60.0, 120.0, 150.0
"""Our choice: below 45 ms even a machine-like player's slip would be a miss; above 150 ms nobody meant that note."""

WRONG_REACH_SDS, MIN_WRONG_REACH_MS, MAX_WRONG_REACH_MS = 3.0, 30.0, 60.0
"""As `REACH_SDS`, but extras of all pieces together come an order of magnitude more often: about 2.7 SD."""

_TREND_HALF_WIDTH = 16
"""Hits to each side in the running trend: its noise is a sixth of the player's, and it bends within two bars."""

_LEAN_PRIOR = 8
"""A piece's lean is believed by half after so many hits (our choice)."""

_ROUNDS = 3

_UNKNOWN_SD_MS = 25.0
"""Spread of a player of whom too few hits are known: the Groove MIDI Dataset's 26 ms (HUMANS)."""


TOGETHER_NS = 40 * NS_PER_MS
"""A piece's strokes written so close are one slot's: flams reach 40 ms (HUMANS, Timing)."""


@dataclass(frozen=True, eq=False)
class AssignmentSide:
    """One side of the problem: `at_ns` (n,) times, `classes` (n,) match classes below `MOST_CLASSES`.

    `strand` (n,) keeps apart what must not be paired though it lies on the same score time: the attempts at a passage
    that was played more than once. `spot` (n,) tells zones and ways of striking apart: where a piece has several
    strokes at one time, each goes to its like first.
    """

    at_ns: Times
    classes: Indices
    strand: Indices
    spot: Indices

    @property
    def lane(self) -> Indices:
        """Class and strand in one number."""
        return self.classes + MOST_CLASSES * self.strand


MOST_CLASSES = 256
"""A piece's number is one byte."""


PLAIN, GRACE, SWUNG = 0, 1, 2
_KINDS = 3
_SWUNG_FROM, _SWUNG_TO = 0.54, 0.74
"""Where in its quarter or eighth a swung offbeat may be written (as `music.passages`)."""


def note_kinds(score: Score) -> Indices:
    """Which notes share a lean besides their piece, shape (n,): a player's flams and swing are their own.

    `GRACE` strokes may all come closer to or farther from their main strokes than written, notes in the place of a
    swung offbeat (`SWUNG`) all earlier or later.
    """
    tick = score.notes["tick"]
    swung = np.zeros(len(score), np.bool_)
    for unit in (PPQ, PPQ // 2):
        place = tick % unit / unit
        swung |= (place > _SWUNG_FROM) & (place < _SWUNG_TO)
    return np.where(score.is_grace, GRACE, np.where(swung, SWUNG, PLAIN))


@dataclass(frozen=True, eq=False)
class HitAssignment:
    """The matching, and the player as it shows them.

    `partner` (n,) hit of each note or −1; `wrong` (n,) hit on another piece or −1; `trend_ns` (n,) where the player as
    a whole stands at each note; `sd_ms` spread about that and the pieces' leans, None where too little is known.
    """

    partner: Indices
    wrong: Indices
    trend_ns: Times
    sd_ms: float | None


@dataclass(frozen=True, eq=False)
class Start:
    """What is believed at first: a deviation in ns common to all, a reach in ms, and how often to look again."""

    deviation_ns: int = 0
    reach_ms: float = FIRST_REACH_MS
    rounds: int = 3


def spots(rows: NDArray[np.void]) -> Indices:
    """Zone and way of striking of each note or hit in one number, shape (n,)."""
    spot: Indices = rows["zone"].astype(np.int64) * _MOST_ARTICULATIONS + rows["articulation"]
    return spot


_MOST_ARTICULATIONS = 64


def assign(
    notes: AssignmentSide, hits: AssignmentSide, kinds: Indices, unpaired: NDArray[np.bool_], start: Start
) -> HitAssignment:
    """The matching of `hits` (m,) to `notes` (n,).

    `kinds` (n,) says which notes share a lean (`note_kinds`), `unpaired` (m,) marks hits that are never paired with
    another piece's note.
    """
    span = _span(notes, hits)
    hit_lane = lanes(hits.at_ns, hits.lane, span)
    player = _Player(np.full(len(notes.at_ns), start.deviation_ns), np.zeros(len(notes.at_ns), np.int64), None)
    reach_ms = start.reach_ms
    partner = np.full(len(notes.at_ns), -1, np.int64)
    for _ in range(start.rounds):
        note_lane = lanes(notes.at_ns + player.expected_ns, notes.lane, span)
        partner = pair_nearest(note_lane, hit_lane, round(reach_ms * NS_PER_MS))
        player = _player(notes, hits, partner, kinds, player)
        reach_ms = min(max(REACH_SDS * player.spread_ms, MIN_REACH_MS), MAX_REACH_MS)
    if _differ(notes.spot):
        partner = _like_first(notes, hits, player.expected_ns, partner, round(reach_ms * NS_PER_MS))
    wrong = _other_pieces(notes, hits, partner, player, unpaired)
    return HitAssignment(partner, wrong, player.trend_ns, player.sd_ms)


def _differ(values: Indices) -> bool:
    return bool((values != values[:1]).any())


def _like_first(
    notes: AssignmentSide, hits: AssignmentSide, expected_ns: Times, partner: Indices, reach_ns: int
) -> Indices:
    """The matching again where a piece's strokes are written together: those on one spot first, then what is left."""
    again = _together(notes)
    if not _differ(notes.spot[again]):
        return partner
    due_ns, span = notes.at_ns + expected_ns, _span(notes, hits)
    own = np.concatenate([notes.lane, hits.lane]), np.concatenate([notes.spot, hits.spot])
    kinds = np.unique(np.stack(own, 1), axis=0, return_inverse=True)[1].reshape(-1)
    free = np.ones(len(hits.at_ns), np.bool_)
    free[partner[~again & (partner >= 0)]] = False
    result = np.where(again, -1, partner)
    note_kind, hit_kind = kinds[: len(due_ns)], kinds[len(due_ns) :]
    for note_lane, hit_lane in ((note_kind, hit_kind), (notes.lane, hits.lane)):
        some_notes, some_hits = np.flatnonzero(again & (result < 0)), np.flatnonzero(free)
        due, played = due_ns[some_notes], hits.at_ns[some_hits]
        found = pair_nearest(
            lanes(due, note_lane[some_notes], span), lanes(played, hit_lane[some_hits], span), reach_ns
        )
        taken = found >= 0
        result[some_notes[taken]] = some_hits[found[taken]]
        free[some_hits[found[taken]]] = False
    return result


def _together(notes: AssignmentSide) -> NDArray[np.bool_]:
    """Which notes have another of their lane in the same slot."""
    order = np.lexsort((notes.at_ns, notes.lane))
    close = (np.diff(notes.lane[order]) == 0) & (np.diff(notes.at_ns[order]) <= TOGETHER_NS)
    together = np.zeros(len(order), np.bool_)
    together[order[1:][close]] = True
    together[order[:-1][close]] = True
    return together


@dataclass(frozen=True, eq=False)
class _Player:
    """Trend and lean (n,) of every note in ns, and the spread about both."""

    trend_ns: Times
    lean_ns: Times
    sd_ms: float | None

    @property
    def expected_ns(self) -> Times:
        return self.trend_ns + self.lean_ns

    @property
    def spread_ms(self) -> float:
        return _UNKNOWN_SD_MS if self.sd_ms is None else self.sd_ms


def _span(notes: AssignmentSide, hits: AssignmentSide) -> int:
    ends = [
        side.at_ns[k] for side in (notes, hits) if len(side.at_ns) for k in (side.at_ns.argmin(), side.at_ns.argmax())
    ]
    return int(max(ends) - min(ends)) + round(4 * MAX_REACH_MS * NS_PER_MS) if ends else 1


def _player(notes: AssignmentSide, hits: AssignmentSide, partner: Indices, kinds: Indices, before: _Player) -> _Player:
    """The player as the pairs show them; as `before` where they are too few."""
    known = np.flatnonzero(partner >= 0)
    known = known[np.argsort(notes.at_ns[known], kind="stable")]
    deviation = (hits.at_ns[partner[known]] - notes.at_ns[known]).astype(np.float64)
    main = kinds[known] != GRACE
    spread = robust_sd(deviation[main])
    if spread is None:
        return before
    groups = notes.classes + MOST_CLASSES * kinds
    lean = _leans(groups[known], deviation - median(deviation[main]), MOST_CLASSES * _KINDS)[groups]
    off, at_s = (deviation - lean[known])[main], notes.at_ns[known[main]] / 1e9
    trend = local_trend(at_s, off, _TREND_HALF_WIDTH, max(spread, NS_PER_MS))
    rest = robust_sd(off - trend) or 0.0
    everywhere = np.interp(notes.at_ns / 1e9, at_s, trend)
    return _Player(_whole(everywhere), _whole(lean), rest / NS_PER_MS)


def _whole(values: NDArray[np.float64]) -> Times:
    return np.rint(values).astype(np.int64)


def _leans(classes: Indices, deviation: NDArray[np.float64], count: int) -> NDArray[np.float64]:
    """Median deviation of each group, drawn towards 0 where few are known, shape (count,)."""
    leans = np.zeros(count)
    for c in np.flatnonzero(np.bincount(classes)):
        own = deviation[classes == c]
        leans[c] = median(own) * len(own) / (len(own) + _LEAN_PRIOR)
    return leans


def _other_pieces(
    notes: AssignmentSide, hits: AssignmentSide, partner: Indices, player: _Player, unpaired: NDArray[np.bool_]
) -> Indices:
    """Hits on another piece at the time of notes that got none."""
    taken = unpaired.copy()
    taken[partner[partner >= 0]] = True
    free_notes, free_hits = np.flatnonzero(partner < 0), np.flatnonzero(~taken)
    reach_ms = min(max(WRONG_REACH_SDS * player.spread_ms, MIN_WRONG_REACH_MS), MAX_WRONG_REACH_MS)
    span = _span(notes, hits)
    found = pair_nearest(
        lanes(notes.at_ns + player.expected_ns, notes.strand, span)[free_notes],
        lanes(hits.at_ns, hits.strand, span)[free_hits],
        round(reach_ms * NS_PER_MS),
    )
    wrong = np.full(len(partner), -1, np.int64)
    wrong[free_notes[found >= 0]] = free_hits[found[found >= 0]]
    return wrong
