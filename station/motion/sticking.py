"""The hands that are cheapest together over a whole score: a beam over the hands' last notes, linear in the notes.

After each note the state is which note each hand played last and how often it has just bounced; of all ways into it
the cheapest survives, and of all states the cheapest dozen. What a note costs a hand depends on that state alone
(`sticking_costs`), so with a beam wide enough the result is optimal; a dozen is, on every score tried.
"""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb, Piece
from station.motion import sticking_costs as price
from station.motion.sticking_costs import LEFT, RIGHT, HandNotes

BEAM = 12


class _State(NamedTuple):
    cost: float
    last: tuple[int, int]  # of each hand: its last note, −1 for none
    bounced: tuple[int, int]
    before: "_State | None"
    hand: int


_START = _State(0.0, (-1, -1), (0, 0), None, -1)


def choose_hands(notes: HandNotes) -> tuple[NDArray[np.int8], list[str]]:
    """The hand of every note, and why, in the order of the rows that `notes` were made from."""
    states = [_START]
    for i in range(len(notes.time_s)):
        reached: dict[tuple[int, int, int, int], _State] = {}
        for state in states:
            for hand in (RIGHT, LEFT):
                after = _step(notes, i, hand, state)
                key = (*after.last, *after.bounced)
                best = reached.get(key)
                if best is None or after.cost < best.cost:
                    reached[key] = after
        states = sorted(reached.values(), key=_cost)[:BEAM]
    path = _path(states[0])
    limbs, reasons = np.empty(len(path), np.int8), [""] * len(path)
    for i, state in enumerate(path):
        row = int(notes.order[i])
        limbs[row] = Limb.RIGHT_HAND if state.hand == RIGHT else Limb.LEFT_HAND
        reasons[row] = _reason(notes, i, state)
    return limbs, reasons


def cost_of(notes: HandNotes, hands: Sequence[int]) -> float:
    """What it costs that `hands` (one a note, in order of time) play `notes`."""
    state = _START
    for i, hand in enumerate(hands):
        state = _step(notes, i, hand, state)
    return state.cost


def _cost(state: _State) -> float:
    return state.cost


def _path(state: _State) -> list[_State]:
    path = []
    while state.before is not None:
        path.append(state)
        state = state.before
    return path[::-1]


def _step(notes: HandNotes, i: int, hand: int, state: _State) -> _State:
    cost = sum(_terms(notes, i, hand, state))
    last, bounced = list(state.last), list(state.bounced)
    before = last[hand]
    quick = before >= 0 and notes.time_s[i] - notes.time_s[before] < price.BOUNCE_S
    bounced[hand] = bounced[hand] + 1 if quick else 0
    last[hand] = i
    return _State(state.cost + cost, (last[0], last[1]), (bounced[0], bounced[1]), state, hand)


_WRITTEN, _TOGETHER, _PAIRED, _TRAVEL, _REPEAT, _CROSSING, _OSTINATO, _NATURAL, _HOME = range(9)
_REASONS = (
    "written",
    "one hand cannot be in two places",
    "its partner in the ornament",
    "the nearer hand in the time there is",
    "too quick for the other hand",
    "the hands stay uncrossed",
    "the ostinato stays in its hand",
    "natural sticking",
    "its own side of the kit, or the leading hand begins",
)
_DOUBLE, _AHEAD, _FREE = "a double stroke", "so that the strokes after it fall well", "either hand"
_SLIGHT = 0.02
"""A difference of cost below this decides nothing."""


def _terms(notes: HandNotes, i: int, hand: int, state: _State) -> list[float]:
    """What note `i` costs `hand`, by the names in `_REASONS`."""
    terms = [0.0] * len(_REASONS)
    now, piece, other = notes.time_s[i], notes.piece[i], 1 - hand
    x, y, z = notes.spot[hand][i]
    own, others = state.last[hand], state.last[other]
    if notes.written[i] not in (Limb.UNKNOWN, hand):
        terms[_WRITTEN] = price.WRITTEN
    if own >= 0:
        gap = now - notes.time_s[own]
        if notes.piece[own] == piece:
            _repeat(terms, gap, state.bounced[hand], notes.paired[i] == 1)
            if gap < price.BOUNCE_S and not notes.odd[i]:
                terms[_REPEAT] += price.LATE_BOUNCE
        else:
            ox, oy, oz = notes.spot[hand][own]
            _travel(terms, gap, math.sqrt((x - ox) ** 2 + (y - oy) ** 2 + (z - oz) ** 2))
    if notes.paired[i] and i and (own == i - 1) != (notes.paired[i] == 1):
        terms[_PAIRED] = price.GRACE
    if others >= 0:
        terms[_CROSSING] = _crossing(notes, i, hand, others)
        if piece in price.OSTINATO_PIECES and notes.piece[others] == piece:
            terms[_OSTINATO] = price.SWITCH * _fresh(now - notes.time_s[others])
    if piece in price.OSTINATO_PIECES and hand != notes.ostinato_lead:
        terms[_OSTINATO] += price.OSTINATO
    elif hand != notes.natural[i]:
        terms[_NATURAL] = price.NATURAL
    terms[_HOME] = price.HOME * max(0.0, (x if hand == LEFT else -x) - price.MIDDLE_M)
    if hand != notes.lead and (i == 0 or now - notes.time_s[i - 1] > price.PHRASE_S):
        terms[_HOME] += price.BEGIN
    return terms


def _fresh(ago_s: float) -> float:
    """1 for what has just happened … 0 for what happened long ago."""
    return max(0.0, 1.0 - ago_s / price.CROSSING_FADES_S)


def _repeat(terms: list[float], gap_s: float, bounced: int, double: bool) -> None:
    """The price of one hand's next stroke on the same piece."""
    if gap_s < price.TOGETHER_S:
        terms[_TOGETHER] = price.CRUSHED
    elif gap_s < price.BOUNCE_S:
        terms[_REPEAT] = 0.0 if double else price.BOUNCE
        if bounced:  # a third stroke has no rebound left to live on
            terms[_REPEAT] += price.UNEVEN
    elif gap_s < price.EASY_REPEAT_S:
        terms[_REPEAT] = price.SLOW * (price.EASY_REPEAT_S - gap_s) / (price.EASY_REPEAT_S - price.BOUNCE_S)


def _travel(terms: list[float], gap_s: float, way_m: float) -> None:
    """The price of moving to another piece in the time there is."""
    if gap_s < price.TOGETHER_S:
        terms[_TOGETHER] = price.IMPOSSIBLE
        return
    need = price.STRIKE_S + price.TRAVEL_S_PER_M * way_m
    terms[_TRAVEL] = price.METRE * way_m + price.LATE * max(0.0, need / gap_s - 0.7) ** 2


def _crossing(notes: HandNotes, i: int, hand: int, others: int) -> float:
    """The price of reaching over the other hand; the leading hand on the hat over the other on the snare is home."""
    over = notes.spot[1 - hand][others][0] - notes.spot[hand][i][0]
    over = (over if hand == RIGHT else -over) - price.CROSSING_MARGIN_M
    if over <= 0:
        return 0.0
    own, other = notes.piece[i], notes.piece[others]
    lead_on, other_on = (own, other) if hand == notes.lead else (other, own)
    if lead_on == Piece.HIHAT and other_on == Piece.SNARE and notes.ostinato_lead == notes.lead:
        return 0.0
    return price.CROSSING * _fresh(notes.time_s[i] - notes.time_s[others]) * min(1.0, over / 0.2)


def _reason(notes: HandNotes, i: int, state: _State) -> str:
    """The term that speaks most for the hand that was chosen."""
    assert state.before is not None
    chosen = _terms(notes, i, state.hand, state.before)
    if state.bounced[state.hand]:
        return _DOUBLE
    spared = [b - a for a, b in zip(chosen, _terms(notes, i, 1 - state.hand, state.before), strict=True)]
    if sum(spared) < -_SLIGHT:
        return _AHEAD
    most = max(range(len(spared)), key=spared.__getitem__)
    return _REASONS[most] if spared[most] > _SLIGHT else _FREE
