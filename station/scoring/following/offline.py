"""The whole way of a performance through a score, when all of it is known.

A clock keeps the player's beat: the click, or a loop that follows their tempo hit by hit (`tempo_tracker`). Against it
the beats are found by which they are elsewhere (`beat_offsets`), with all that comes later in view; from a jump on the
clock runs anew at the new place. Without a click the clock must be set at the beginning and after every silence, and
where no beat fits any more: there the place and tempo are found from nothing (`anchors`). Times are seconds.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.scoring.following.anchors import Hits, found
from station.scoring.following.beat_blocks import AHEAD, MOST_JUMPS, SETTLED, Blocks
from station.scoring.following.beat_offsets import Offsets, best_way, end_cost, offsets_of
from station.scoring.following.click_sway import LOOK_BEATS, Sway, first_far
from station.scoring.following.free_run import LOST_HITS, FreeRun, RawWay, silences
from station.scoring.following.place_choice import EARLY_S, ENOUGH, SAME_TEMPO, PlaceChoice, possible
from station.scoring.following.tempo_tracker import Place
from station.scoring.following.written import PARTS, Written

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]

_LONG_LOOK = 256
"""Hits over which rival anchors are compared: bars that are alike part ways sooner or later."""

_RIVALS, _HOPELESS = 4, 30.0
"""So many anchors are followed over the long look; where one fits, those no more nats behind it in the window."""

_SURELY = 0.95
"""As `_ENOUGH`, without a look at tempi close to what is written, in a score short enough to be all alike: a long roll
shifted by one of its strokes fits to .9."""

_RATES = np.exp(np.arange(-37, 38) * 0.02)
"""Tempi tried at the beginning, half to twice as fast, in steps of 2 %."""

_CLOSE_RATES = 1.0 + 0.02 * np.array([-5, -4, -3, -2, -1, 1, 2, 3, 4, 5])
"""Tempi close to what is written."""

_SAME_BEAT = 0.1
"""Parts of a beat: two places so near within a beat are on one beat (our choice)."""


@dataclass(frozen=True, eq=False)
class ClickWay:
    """Score time of each hit (m,), how far each leans from the click there, late is positive, and where jumps end."""

    score_s: Floats
    lean_s: Floats
    jumps: Indices


def clicked_way(written: Written, hits: Hits, common_s: float) -> ClickWay:
    """Where the hits are by the click: their times are score time, but for a lean and where the player jumped.

    `common_s` is the lean that is common to most of them and was taken off their times.
    """
    common = round(common_s / written.quarter_s * PARTS)
    known: tuple[int, ...] = (0, common)
    offsets = offsets_of(written, slips=False)
    beats, shift, lean = written.beats.beat(hits.at_s), np.zeros(len(hits.at_s)), np.zeros(len(hits.at_s))
    jumps: list[int] = []
    start, now, leant = 0, 0.0, 0.0
    while start < len(beats):
        leg = _next_leg(written, hits, beats + (now + leant), start, offsets, known)
        here = slice(start, leg.end)
        shift[here], lean[here] = now, -leant - leg.leans / PARTS
        start = leg.end
        if len(leg.leans):
            known = ()
            leant += float(leg.leans[-1]) / PARTS
        if leg.parts:
            now += leg.parts / PARTS
            shift[start:], lean[start:] = now, -leant
            jumps.append(start)
            if len(jumps) == MOST_JUMPS:
                break
    there = beats + shift
    score_s = written.beats.time(there) if jumps else hits.at_s
    lean_s = written.beats.time(there) - written.beats.time(there - lean) if lean.any() else lean
    return ClickWay(score_s, lean_s, np.array([j for j in jumps if j], np.int64))


@dataclass(frozen=True, eq=False)
class _Leg:
    """From a hit to before `end` without a jump, and the `leans` of its hits; the next is `parts` of a beat away."""

    end: int
    parts: int
    leans: Indices


def _next_leg(
    written: Written, hits: Hits, beats: Floats, start: int, offsets: Offsets, known: tuple[int, ...]
) -> _Leg:
    """What is played from hit `start` on, which is at `beats` (m,) or elsewhere, until a jump or the clock runs anew.

    `known` are the leans that the first hit may have, or about so; none where it is at `beats`.
    """
    steady, ahead = _window(written, hits, beats, start, offsets, AHEAD)
    way = best_way(steady.gains, -offsets.price, offsets, written, ahead, steady.pauses)
    if way.worth > ENOUGH * possible(hits.part(start, start + len(steady.said))):
        none = np.zeros(len(way.states), np.int64)
        return _leg_of(steady, way.states, none, offsets.parts[way.states], start, len(beats))
    sway = Sway.of(offsets, known or (0,))
    near = int(np.searchsorted(np.maximum.accumulate(beats), beats[start] + LOOK_BEATS)) - start
    window, last = _window(written, hits, beats, start, sway.states, min(max(near, 1), AHEAD))
    first = sway.begin(-offsets.price, known or (0,), not known)
    swaying = sway.best_way(window.gains, first, written, last, window.pauses)
    return _leg_of(window, swaying.states, swaying.leans, offsets.parts[swaying.offsets], start, len(beats))


def _window(
    written: Written, hits: Hits, beats: Floats, start: int, offsets: Offsets, most: int
) -> tuple[Blocks, Floats | None]:
    """At `most` so many hits from `start` on, and what their end says of each offset; None where more follow."""
    end = min(start + most, len(beats))
    blocks = Blocks.of(written, hits, beats, start, end, offsets)
    return blocks, end_cost(written, float(beats[-1]), offsets) if end == len(beats) else None


def _leg_of(window: Blocks, states: Indices, leans: Indices, parts: Indices, start: int, count: int) -> _Leg:
    """The leg from hit `start` of `count`: until the way jumps, or leans so far that the clock must run anew.

    `states`, `leans` and `parts` of the offsets (b,) are those of the blocks of `window`.
    """
    size = len(window.said)
    settled = size if start + size == count else max(size * SETTLED // AHEAD, 1)
    far, left = first_far(leans), np.flatnonzero(parts)
    until = start + settled
    if far < len(leans):
        until = min(until, int(window.starts[far]))
    of_hits = np.repeat(leans, np.diff(window.starts, append=start + size))
    if len(left) and window.starts[left[0]] < until:
        at = window.split(int(left[0]), states)
        return _Leg(at, int(parts[left[0]]), of_hits[: at - start])
    return _Leg(until, 0, of_hits[: until - start])


def free_way(written: Written, hits: Hits, ends: bool = True) -> tuple[RawWay, float]:
    """The way of a player without a click, in score time at the second value, their tempo against what is written.

    `ends`: the score's end is an end, and not where it was laid out to.
    """
    begin, tempo = _beginning(written, hits)
    return FreeRun(written.at_tempo(tempo), hits, tempo, ends).run(begin), tempo


def _beginning(written: Written, hits: Hits) -> tuple[Place, float]:
    """Where the performance begins, in score time at the tempo that is the second value."""
    plain = FreeRun(written, hits)
    at_s = float(hits.at_s[0])
    gaps = silences(hits.at_s)
    end = int(gaps[gaps >= LOST_HITS][0]) if (gaps >= LOST_HITS).any() else len(hits.at_s)
    window = hits.window(0, end)
    rivals = sorted(_rivals(written, window, plain.choice), key=lambda rival: -rival[0])
    hopeless = -np.inf if rivals[0][0] < ENOUGH * possible(window) else rivals[0][0] - _HOPELESS
    likely = _unlike(written, [rival for rival in rivals if rival[0] > hopeless])[:_RIVALS]

    def long_look(place: Place) -> float:
        """What the first hits say for a beginning, followed for a while at its tempo."""
        start, tempo = _at_its_tempo(place)
        run = plain if tempo == 1.0 else FreeRun(written.at_tempo(tempo), hits, tempo)
        return run.worth(start, min(end, _LONG_LOOK))

    best = likely[0] if len(likely) == 1 else max(likely, key=long_look)
    here, tempo = _at_its_tempo(best)
    return here._replace(at_s=at_s), tempo


def _rivals(written: Written, window: Hits, choice: PlaceChoice) -> list[tuple[float, Place]]:
    """Where the hits of `window` may begin, and what speaks for each: usual places, and where none fits, others."""
    at_s, first_s = float(window.at_s[0]), float(written.at_s[0])
    usual = [Place(at_s, score_s, 1.0) for score_s in (at_s, first_s)]
    rivals = [choice.at_best(window, place) for place in usual + [choice.on_beat(window, p) for p in usual]]
    if written.is_short and max(value for value, _ in rivals) < _SURELY * possible(window):
        close = [choice.on_beat(window, Place(at_s, first_s, rate)) for rate in _CLOSE_RATES]
        rivals += [choice.at_best(window, place) for place in close]
    for among_s in ((first_s - 1.0, first_s + EARLY_S), (-np.inf, np.inf)):
        if max(value for value, _ in rivals) < ENOUGH * possible(window):
            places = found(written, choice.tracker, window, _RATES, among_s)
            rivals += [choice.at_best(window, place) for place in places]
    return rivals


def _at_its_tempo(place: Place) -> tuple[Place, float]:
    """`place` in the time of a score that is written at its tempo, and that tempo: 1 where it is about the score's."""
    tempo = 1.0 if abs(place.rate - 1.0) < SAME_TEMPO else place.rate
    return Place(place.at_s, place.score_s / tempo, place.rate / tempo), tempo


def _unlike(written: Written, rivals: list[tuple[float, Place]]) -> list[Place]:
    """The places of the rivals, best first, but for those of the tempo and beat of a better one."""
    kept: list[tuple[float, float]] = []
    places = []
    for _, place in rivals:
        beat = float(written.beats.beat(np.array([place.score_s]))[0])
        if not any(
            abs(place.rate / rate - 1) < SAME_TEMPO and abs(beat - other - round(beat - other)) < _SAME_BEAT
            for rate, other in kept
        ):
            kept.append((place.rate, beat))
            places.append(place)
    return places
