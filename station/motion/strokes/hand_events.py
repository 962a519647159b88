"""What one hand does, in order of time: its strikes, the presses of its buzz rolls, and the cymbals that it grabs.

A score has a buzz roll as one note with a duration and a choke as a delay after the stroke; here both become events of
hands. Times in seconds from tick 0.
"""

from bisect import bisect_left, bisect_right
from dataclasses import dataclass
from itertools import compress, zip_longest

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Articulation, Limb, Piece, Zone
from station.motion.strokes.bounces import bounces_on
from station.motion.strokes.stroke_heights import stroke_height_m
from station.music.score import Score

Array = NDArray[np.float64]

GRAB, WAIT, SHOW, LAP = (len(Articulation) + k for k in range(4))
"""Stand where an articulation stands: the hand grabs the cymbal's edge, waits on its own side over the snare, shows a
spin or toss above that, or rests on its thigh."""
SAME_STROKE_S = 0.004
"""Events of one hand nearer than this are one movement."""
GRACE_HEIGHT_M, LAID_HEIGHT_M, PRESS_HEIGHT_M, GRAB_HEIGHT_M = 0.045, 0.06, 0.02, 0.03
"""Grace strokes fall from no higher than this, a cross-stick's stick is lifted no higher, a press of a buzz roll is a
small stroke, and a hand that grabs comes from near (our choice)."""
BOUNCES = ((0.036, 0.010), (0.031, 0.007), (0.027, 0.005), (0.024, 0.004))
"""A stick that is pressed into the head bounces on: seconds after the strike before, and metres high (our choice)."""
REBOUND_S, REBOUND_AFTER, REBOUND_HEIGHT = 0.115, 0.7, 0.6
"""A stroke that comes so soon, in less than this share of the gaps before and after, is the second of a double: the
stick's own rebound, 50–90 ms after the first (HUMANS) and lower by this factor (our choice)."""
PRESS_S = 0.10
"""Each press of a buzz roll sounds this long before the other hand takes over (our choice)."""
BUSY_S = 0.12
"""A hand with an event this near cannot grab a cymbal (our choice)."""

REST_S, LEAVE_S = 1.1, 0.5
"""A hand with so long a rest that is not at home goes there, so long after its last stroke (our choice)."""
LONG_REST_S, OVER_SNARE_S, LIE_DOWN_S = 3.5, 0.7, 1.5
"""In so long a rest, a bar and a half of a middling tempo, it lies down on the thigh: it is over the snare so long
after its last stroke and before its next, and on the thigh so long after and before (our choice)."""

LONG_AGO_S = -60.0

Event = tuple[float, int, int, float, bool]
"""Time, row of the score, articulation, height, and whether it is a pressed stick's bounce."""


@dataclass(frozen=True, eq=False)
class HandEvents:
    """One hand's events.

    `time_s` (n,) rising; `row` (n,) of the score that each comes from; `key` (n, 3) piece, zone and articulation or
    `GRAB`; `height_m` (n,). `bounces` (n,) of a stick, and `rebounds` (n,), the second strokes of doubles, are
    not struck by the wrist. An idle hand has waited since long ago, and `row` is empty.
    """

    time_s: Array
    row: NDArray[np.int64]
    key: NDArray[np.int64]
    height_m: Array
    bounces: NDArray[np.bool_]
    rebounds: NDArray[np.bool_]


def hand_events(score: Score, limbs: NDArray[np.int8]) -> tuple[HandEvents, HandEvents]:
    """What the right and the left hand do in `score` when `limbs` (n,) play it."""
    onset, notes = score.onset_s, score.notes
    struck = [np.flatnonzero(limbs == limb) for limb in (Limb.RIGHT_HAND, Limb.LEFT_HAND)]
    found: list[list[Event]] = [[], []]
    height = heights(notes)
    for side, rows in enumerate(struck):
        found[side] = [
            (t, row, int(a), h, False)
            for t, row, a, h in zip(
                onset[rows].tolist(), rows.tolist(), notes["articulation"][rows], height[rows].tolist(), strict=True
            )
        ]
    for row in np.flatnonzero(notes["articulation"] == Articulation.BUZZ).tolist():
        _press(score, row, limbs, onset, found)
    for row in np.flatnonzero(score.is_choked).tolist():
        _grab(score, row, limbs, found)
    ordered = [_with_bounces(sorted(events)) for events in found]
    right, left = (_events(notes, _with_waits(notes, own, other)) for own, other in (ordered, reversed(ordered)))
    return right, left


_HOME = (Piece.SNARE,)
_STATIONS = (Piece.HIHAT, Piece.RIDE, Piece.RIDE_2)


def _with_waits(notes: NDArray[np.void], events: list[Event], others: list[Event]) -> list[Event]:
    """The same with a wait in every rest, but where the hand is at home or stationed at its cymbal.

    Nor does it go home past the other hand, which has come to where this one is. In long rests, before the first and
    after the last stroke it lies on its thigh.
    """
    result = [event for first in events[:1] for event in reversed(_lies_down(first, notes["piece"][first[1]], -1))]
    other_s = [other[0] for other in others]
    for event, after in zip_longest(events, events[1:]):
        result.append(event)
        at, row, *_ = event
        piece = notes["piece"][row]
        if after is None or after[0] - at >= LONG_REST_S:
            result += _lies_down(event, piece, 1)
        if after is None:
            continue
        if after[0] - at >= LONG_REST_S:
            result += reversed(_lies_down(after, notes["piece"][after[1]], -1))
            continue
        if piece in _HOME or after[0] - at < REST_S:
            continue
        if piece in _STATIONS and notes["piece"][after[1]] == piece:
            continue
        beside = others[bisect_left(other_s, at) : bisect_right(other_s, at + REST_S)]
        if any(notes["piece"][other[1]] == piece for other in beside):
            continue
        result.append((at + LEAVE_S, row, WAIT, 0.0, False))
    return result


def _lies_down(event: Event, piece: int, sign: int) -> list[Event]:
    """How a hand gets to its thigh after `event`, or from there to it if `sign` is −1: past the kit over the snare."""
    at, row, *_ = event
    home = [] if piece in _HOME else [(at + sign * OVER_SNARE_S, row, WAIT, 0.0, False)]
    return [*home, (at + sign * LIE_DOWN_S, row, LAP, 0.0, False)]


def _with_bounces(events: list[Event]) -> list[Event]:
    """The same with the bounces of every press, as far as there is time for them before the hand's next event."""
    result = []
    for event, after in zip_longest(events, events[1:]):
        result.append(event)
        at, row, articulation, *_ = event
        if articulation != Articulation.BUZZ:
            continue
        for later, height in BOUNCES:
            at += later
            if after is not None and after[0] - at < PRESS_S / 2:
                break
            result.append((at, row, articulation, height, True))
    return result


def heights(notes: NDArray[np.void]) -> Array:
    """How high the stick rises before each note."""
    height = stroke_height_m(notes["velocity"])
    height = np.where(notes["lead_ms"] > 0, np.minimum(height, GRACE_HEIGHT_M), height)
    laid = notes["articulation"] == Articulation.CROSS_STICK
    return np.where(laid, np.minimum(height, LAID_HEIGHT_M), height)


def _press(score: Score, row: int, limbs: NDArray[np.int8], onset: Array, found: list[list[Event]]) -> None:
    """The presses that carry a buzz roll on: by both hands in turn where the other is free, else by one."""
    if limbs[row] not in (Limb.RIGHT_HAND, Limb.LEFT_HAND):
        return
    start = float(onset[row])
    tick = int(score.notes["tick"][row])
    end = float(score.tempo_map.seconds_at(tick + int(score.notes["duration_ticks"][row])))
    other = Limb.LEFT_HAND if limbs[row] == Limb.RIGHT_HAND else Limb.RIGHT_HAND
    others = onset[limbs == other]
    free = not np.any((others > start - BUSY_S) & (others < end + BUSY_S))
    count = int((end - start) / PRESS_S)
    for k in range(1, count):
        side = int(limbs[row]) if k % 2 == 0 else int(other)
        if k % 2 == 0 or free:
            found[side].append((start + k * (end - start) / count, row, int(Articulation.BUZZ), PRESS_HEIGHT_M, False))


def _grab(score: Score, row: int, limbs: NDArray[np.int8], found: list[list[Event]]) -> None:
    """The hand that is freer grabs the cymbal; where both are busy nobody does."""
    tick = int(score.notes["tick"][row]) + int(score.notes["choke_ticks"][row])
    at = float(score.tempo_map.seconds_at(tick))
    room = [min((abs(t - at) for t, *_ in events), default=np.inf) for events in found]
    struck_by = int(limbs[row])
    side = struck_by if struck_by in (0, 1) and room[struck_by] > BUSY_S else int(np.argmax(room))
    if room[side] > BUSY_S:
        found[side].append((at, row, GRAB, GRAB_HEIGHT_M, False))


def _events(notes: NDArray[np.void], found: list[Event]) -> HandEvents:
    if not found:
        key = np.array([[Piece.SNARE, Zone.HEAD, LAP]], np.int64)
        ago, height, none = np.array([LONG_AGO_S]), np.zeros(1), np.zeros(1, bool)
        return HandEvents(ago, np.zeros(0, np.int64), key, height, none, none)
    keep = np.diff([event[0] for event in found], prepend=-np.inf) > SAME_STROKE_S
    kept = zip(*compress(found, keep), strict=True)
    time, row, articulation, height, bounces = (np.array(column) for column in kept)
    zone = np.where(articulation == GRAB, int(Zone.EDGE), notes["zone"][row])
    waits = np.isin(articulation, (WAIT, LAP))
    zone = np.where(waits, int(Zone.HEAD), zone)
    piece = np.where(waits, int(Piece.SNARE), notes["piece"][row])
    key = np.stack([piece, zone, articulation], 1).astype(np.int64)
    on = bounces_on(time, piece, notes["velocity"][row]) & (articulation < GRAB)
    rebounds = np.zeros(len(time), bool)
    rebounds[~on] = _rebounds(time[~on], piece[~on])
    rebounds &= ~bounces & (articulation < GRAB)
    bounces |= on
    for k in np.flatnonzero(rebounds | on).tolist():
        height[k] = min(height[k], REBOUND_HEIGHT * height[k - 1])
    return HandEvents(time, row, key, height, bounces, rebounds)


def _rebounds(time_s: Array, piece: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Which events (n,) are the second of two that stand apart from the others on one piece."""
    gaps = np.diff(time_s, prepend=-np.inf, append=np.inf)
    before, own, after = np.concatenate(([np.inf], gaps[:-2])), gaps[:-1], gaps[1:]
    apart = own < REBOUND_AFTER * np.minimum(before, after)
    found: NDArray[np.bool_] = (own < REBOUND_S) & apart & (np.diff(piece, prepend=-1) == 0)
    return found
