"""From hits in roughly score time to the matching of least cost: pair, see where the player stands, pair again.

A first pairing within the wide reach that the music leaves (`note_reach`) shows how the player leans: as a whole, on
each piece at each place in the beat (a swung offbeat leans on its own), and slowly drifting. The next pairings measure
distance from there, with a reach made from the spread that was seen, so that a steady player's stray hit stays an extra
and a beginner's late one is still a late hit. What is left on both sides is then paired across pieces within a narrower
reach (the right time, another piece). All times are integer ns of score time; positive deviations are late.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_MS, NS_PER_S, PPQ
from station.music.score import Score
from station.scoring.matching.note_reach import LEAST_REACH_NS, TOGETHER_NS
from station.scoring.matching.pairing import Indices, Room, Times, lanes, pair_nearest
from station.scoring.matching.slow_drift import local_trend, median, robust_sd

Floats = NDArray[np.float64]

REACH_SDS = 4.5
"""A pair is likelier than a miss beside an extra out to about 4.4 SD, at 3 % misses and 0.06 extras a second on the
piece (ratio of the normal density to the product of the two rates)."""

MAX_REACH_MS = 150.0
"""Beyond it from where the player stands nobody meant that note (our choice)."""

WRONG_REACH_SDS, MIN_WRONG_REACH_MS, MAX_WRONG_REACH_MS = 3.0, 30.0, 60.0
"""As `REACH_SDS`, but extras of all pieces together come an order of magnitude more often: about 2.7 SD."""

_TREND_HALF_WIDTH = 16
"""Hits to each side in the running trend: its noise is a sixth of the player's, and it bends within two bars."""

LEAN_PRIOR = 8
"""A piece's lean is believed by half after so many hits (our choice)."""

_SURE_ERRORS, _LEAST_SURE = 3.0, 4
"""A lean this many standard errors from 0, of so many hits at least, is believed the more the farther it is (James and
Stein 1961, positive part): a straight offbeat in a shuffle lies a sixth of a beat off from the first."""

_ROUNDS = 3
"""Our choice: a first, a second with the leans that it shows, a third with the spread about them."""

_SETTLED = 0.01
"""Of the notes: so few that are paired otherwise than before move no median (our choice)."""

UNKNOWN_SD_MS = 25.0
"""Spread of a player of whom too few hits are known: the Groove MIDI Dataset's 26 ms (HUMANS)."""


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


_PLACES = 24
"""Places in a quarter that may lean on their own: triplets and 32nds, and what is written between goes to the next."""

_GRACE = _PLACES
"""The place of all grace strokes: a player's flams are as wide as they are, wherever they stand."""


def leaning_places(score: Score) -> Indices:
    """Which notes of a piece share a lean, (n,): those at one place in the beat; and grace strokes, wherever."""
    place = (score.notes["tick"] % PPQ * _PLACES + PPQ // 2) // PPQ % _PLACES
    return np.where(score.is_grace, _GRACE, place)


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
class Leaning:
    """What the notes (n,) tell of how hits may lie about them: `place` (`leaning_places`) and `room` (`note_reach`)."""

    place: Indices
    room: Room


def spots(rows: NDArray[np.void]) -> Indices:
    """Zone and way of striking of each note or hit in one number, shape (n,)."""
    spot: Indices = rows["zone"].astype(np.int64) * _MOST_ARTICULATIONS + rows["articulation"]
    return spot


_MOST_ARTICULATIONS = 64


def assign(
    notes: AssignmentSide, hits: AssignmentSide, leaning: Leaning, unpaired: NDArray[np.bool_], lean_ns: Times
) -> HitAssignment:
    """The matching of `hits` (m,) to `notes` (n,).

    `unpaired` (m,) marks hits that are never paired with another piece's note; `lean_ns` (n,) is where
    the player is believed to stand at first.
    """
    count = len(notes.at_ns)
    span = _span(notes, hits)
    hit_lane = lanes(hits.at_ns, hits.lane, span)
    player = _Player(lean_ns, np.zeros(count, np.int64), None)
    partner = np.full(count, -1, np.int64)
    room: Room | None = leaning.room
    reach_ns = _widest(leaning.room)
    for _ in range(_ROUNDS):
        before, note_lane = partner, lanes(notes.at_ns + player.expected_ns, notes.lane, span)
        partner = pair_nearest(note_lane, hit_lane, reach_ns, room)
        if room is None and np.count_nonzero(partner != before) <= _SETTLED * count:
            break
        player = _player(notes, hits, partner, leaning.place, lean_ns, player)
        if player.sd_ms is not None:
            room, reach_ns = None, reach_by_spread(player.sd_ms)
    if _differ(notes.spot):
        partner = _like_first(notes, hits, player.expected_ns, partner, reach_ns)
    wrong = _other_pieces(notes, hits, partner, player, unpaired)
    return HitAssignment(partner, wrong, player.trend_ns, player.sd_ms)


def _widest(room: Room) -> int:
    return int(max(room.early.max(initial=LEAST_REACH_NS), room.late.max(initial=LEAST_REACH_NS)))


def reach_by_spread(sd_ms: float) -> int:
    """How many ns from where a player of that spread stands a hit is still theirs."""
    return max(round(min(REACH_SDS * sd_ms, MAX_REACH_MS) * NS_PER_MS), LEAST_REACH_NS)


def wrong_reach_by_spread(sd_ms: float) -> int:
    """The same of a hit on another piece."""
    return round(min(max(WRONG_REACH_SDS * sd_ms, MIN_WRONG_REACH_MS), MAX_WRONG_REACH_MS) * NS_PER_MS)


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
        return UNKNOWN_SD_MS if self.sd_ms is None else self.sd_ms


def _span(notes: AssignmentSide, hits: AssignmentSide) -> int:
    ends = [
        side.at_ns[k] for side in (notes, hits) if len(side.at_ns) for k in (side.at_ns.argmin(), side.at_ns.argmax())
    ]
    return int(max(ends) - min(ends)) + _APART_NS if ends else 1


_APART_NS = 4 * NS_PER_S
"""More than lanes overlap by leans and reaches."""


def _player(
    notes: AssignmentSide, hits: AssignmentSide, partner: Indices, place: Indices, lean_ns: Times, before: _Player
) -> _Player:
    """The player as the pairs show them; as `before` where they are too few."""
    known = np.flatnonzero(partner >= 0)
    known = known[np.argsort(notes.at_ns[known], kind="stable")]
    deviation = (hits.at_ns[partner[known]] - notes.at_ns[known]).astype(np.float64)
    main = place[known] != _GRACE
    spread = robust_sd(deviation[main])
    if spread is None:
        return before
    beside = deviation - lean_ns[known]
    lean = _leans(notes.classes, place, known, beside - median(beside[main]))
    off, at_s = (deviation - lean[known])[main], notes.at_ns[known[main]] / NS_PER_S
    trend = local_trend(at_s, off, _TREND_HALF_WIDTH, max(robust_sd(off) or 0.0, NS_PER_MS))
    rest = robust_sd(off - trend) or 0.0
    everywhere = np.interp(notes.at_ns / NS_PER_S, at_s, trend)
    return _Player(_whole(everywhere), _whole(lean), rest / NS_PER_MS)


def _whole(values: Floats) -> Times:
    return np.rint(values).astype(np.int64)


def _leans(classes: Indices, place: Indices, known: Indices, deviation: Floats) -> Floats:
    """The lean of every note (n,): its piece's, and that of its place on the piece beyond; `deviation` of the known."""
    of_piece = _believed(classes, known, deviation)
    group = classes * (_PLACES + 1) + place
    return of_piece + _believed(group, known, deviation - of_piece[known])


def _believed(group: Indices, known: Indices, deviation: Floats) -> Floats:
    """The median deviation of each note's group (n,), drawn towards 0 where the data say little."""
    mine = group[known]
    counts = np.bincount(mine, minlength=int(group.max(initial=0)) + 1)
    order = np.argsort(mine, kind="stable")
    ends = np.cumsum(counts).tolist()
    leans = np.zeros(len(counts))
    for k in np.flatnonzero(counts).tolist():
        leans[k] = median(deviation[order[ends[k] - counts[k] : ends[k]]])
    error = (robust_sd(deviation - leans[mine]) or 0.0) / np.sqrt(np.maximum(counts, 1))
    sure = 1.0 - np.square(_SURE_ERRORS * error / np.where(leans == 0.0, 1.0, leans))
    belief = counts / (counts + LEAN_PRIOR)
    believed: Floats = leans * np.where(counts >= _LEAST_SURE, np.maximum(belief, sure), belief)
    return believed[group]


def _other_pieces(
    notes: AssignmentSide, hits: AssignmentSide, partner: Indices, player: _Player, unpaired: NDArray[np.bool_]
) -> Indices:
    """Hits on another piece at the time of notes that got none."""
    taken = unpaired.copy()
    taken[partner[partner >= 0]] = True
    free_notes, free_hits = np.flatnonzero(partner < 0), np.flatnonzero(~taken)
    span = _span(notes, hits)
    found = pair_nearest(
        lanes(notes.at_ns + player.expected_ns, notes.strand, span)[free_notes],
        lanes(hits.at_ns, hits.strand, span)[free_hits],
        wrong_reach_by_spread(player.spread_ms),
    )
    wrong = np.full(len(partner), -1, np.int64)
    wrong[free_notes[found >= 0]] = free_hits[found[found >= 0]]
    return wrong
