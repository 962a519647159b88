"""The hands that are cheapest together over a whole score, in time linear in its length.

What a note costs a hand depends on what each hand played last and whether that doubled the note before it
(`hand_costs`). One hand played the note before; so a state is that hand, the other hand's last note, and two
doubles. Of all ways into a state the cheapest survives. When the other hand played no longer matters once it is long
enough ago, only where: then states on one spot are one, and there are never more of them than a second's notes and a
kit's spots. The result is optimal.
"""

import heapq
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb
from station.motion.sticking import hand_costs as price
from station.motion.sticking.hand_notes import EASY_REPEAT_S, LEFT, RIGHT, HandNotes

MOST_STATES = 96
"""Of each hand. Only a score of more than some eighty strokes a second has more: then the cheapest survive."""


class _State(NamedTuple):
    cost: float
    hand: int  # that played the note before
    other: int  # the other hand's last note, −1 for none
    bounced: tuple[bool, bool]  # whether the last stroke of `hand`, of the other hand doubled the one before
    before: "_State | None"


_START = _State(0.0, RIGHT, -1, (False, False), None)


def choose_hands(notes: HandNotes) -> tuple[NDArray[np.int8], list[str]]:
    """The hand of every note, and why, in the order of the rows that `notes` were made from."""
    settled_s = price.settled_s(notes)
    states = [_START]
    for i in range(len(notes.time_s)):
        states = [s for hand in _who_may(notes, i) for s in _best_into(notes, i, hand, states, settled_s)]
    path = _path(min(states, key=_cost))
    limbs, reasons = np.empty(len(path), np.int8), [""] * len(path)
    for i, state in enumerate(path):
        row = int(notes.order[i])
        limbs[row] = Limb.RIGHT_HAND if state.hand == RIGHT else Limb.LEFT_HAND
        reasons[row] = _reason(notes, i, state)
    return limbs, reasons


def _who_may(notes: HandNotes, i: int) -> tuple[int, ...]:
    """The hands that may play note `i`: a written one is played by no other."""
    written = int(notes.written[i])
    return (written,) if written in (RIGHT, LEFT) else (RIGHT, LEFT)


def _cost(state: _State) -> float:
    return state.cost


def _path(state: _State) -> list[_State]:
    path = []
    while state.before is not None:
        path.append(state)
        state = state.before
    return path[::-1]


def _best_into(notes: HandNotes, i: int, hand: int, states: list[_State], settled_s: float) -> list[_State]:
    """The cheapest way into each state in which `hand` plays note `i`."""
    by_itself = sum(price.alone(notes, i, hand))
    after_own: dict[tuple[int, bool], tuple[float, bool]] = {}
    beside: dict[int, tuple[float, int, bool]] = {}
    best: dict[tuple[int, bool, bool], _State] = {}
    for state in states:
        own, other, bounced, others = _lasts(i, hand, state)
        if (own, bounced) not in after_own:
            after_own[own, bounced] = _after(notes, i, hand, own, bounced)
        if other not in beside:
            beside[other] = _beside(notes, i, hand, other, settled_s)
        own_cost, doubled = after_own[own, bounced]
        other_cost, where, is_fresh = beside[other]
        cost = state.cost + by_itself + own_cost + other_cost
        others = others and is_fresh
        known = best.get((where, doubled, others))
        if known is None or cost < known.cost:
            best[where, doubled, others] = _State(cost, hand, other, (doubled, others), state)
    if len(best) > MOST_STATES:
        return heapq.nsmallest(MOST_STATES, best.values(), key=_cost)
    return list(best.values())


def _lasts(i: int, hand: int, state: _State) -> tuple[int, int, bool, bool]:
    """The last notes of `hand` and of the other hand before note `i`, and whether each was a double."""
    if hand == state.hand or i == 0:
        return i - 1, state.other, *state.bounced
    return state.other, i - 1, state.bounced[1], state.bounced[0]


def _after(notes: HandNotes, i: int, hand: int, own: int, bounced: bool) -> tuple[float, bool]:
    """What note `i` costs `hand` after its last note, and whether it doubles that."""
    return sum(price.after_own(notes, i, hand, own, bounced)), price.is_double(notes, i, own)


def _beside(notes: HandNotes, i: int, hand: int, other: int, settled_s: float) -> tuple[float, int, bool]:
    """What it costs beside the other hand's last note, which that is, and whether a double of it is fresh.

    Long after it a note is as good as any on its spot, and an old double is forgotten.
    """
    cost = sum(price.beside(notes, i, hand, other))
    if other < 0:
        return cost, other, True
    gap_s = notes.time_s[i] - notes.time_s[other]
    return cost, other if gap_s < settled_s else -2 - notes.kind[other], gap_s < EASY_REPEAT_S


# --- the reason -------------------------------------------------------------------------------------------------------

_NAMES = (*price.ALONE, *price.AFTER_OWN, *price.BESIDE)
_DOUBLE = "a double stroke: the second is the rebound"
_MORE = "one more stroke of the same hand: every other way is harder"
_AHEAD = "so that the strokes after it fall well"
_FREE = "either hand"
_NOBODY = "impossible: both hands are busy elsewhere"
WORDS = (_DOUBLE, _MORE, _AHEAD, _FREE, _NOBODY)
"""Reasons beside the names of the terms."""
_SLIGHT = 0.02
"""A difference of cost below this decides nothing."""


def _terms(notes: HandNotes, i: int, hand: int, state: _State) -> tuple[float, ...]:
    """What note `i` costs `hand` in `state`: a price for each of `_NAMES`."""
    own, other, bounced, _ = _lasts(i, hand, state)
    beside = price.beside(notes, i, hand, other)
    return (*price.alone(notes, i, hand), *price.after_own(notes, i, hand, own, bounced), *beside)


def _reason(notes: HandNotes, i: int, state: _State) -> str:
    """The term that speaks most for the hand that was chosen."""
    assert state.before is not None
    chosen = _terms(notes, i, state.hand, state.before)
    if notes.written[i] == state.hand:
        return price.ALONE[0]
    if max(chosen) >= price.IMPOSSIBLE:
        return _NOBODY
    own, _, bounced, _ = _lasts(i, state.hand, state.before)
    if price.is_rebound(notes, i, own):
        return _MORE if bounced else _DOUBLE
    spared = [b - a for a, b in zip(chosen, _terms(notes, i, 1 - state.hand, state.before), strict=True)]
    if sum(spared) < -_SLIGHT:
        return _AHEAD
    most = max(range(len(spared)), key=spared.__getitem__)
    return _NAMES[most] if spared[most] > _SLIGHT else _FREE
