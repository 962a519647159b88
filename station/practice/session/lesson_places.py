"""Where in the lesson something of a session lies: bar, beat and pass, which count from 1."""

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb
from station.music.score import Score
from station.practice.session.session import SessionResult

PLACE_DTYPE = np.dtype(
    [
        ("place", np.float64),  # the lesson's bar from 1, and how much of it is over
        ("beat", np.float64),
        ("bar", np.int32),  # of the lesson
        ("row_bar", np.int32),  # of the result's score, from 0
        ("pass", np.int32),
    ]
)


def places_of(result: SessionResult, ticks: NDArray[np.int64]) -> NDArray[np.void]:
    """Where `ticks` (n,) of the result's score lie, (n,) of `PLACE_DTYPE`; what comes after the last bar is in it.

    So is the landing after the last pass: it is struck on the beat after the last of the bar that leads to it, with
    which it counts.
    """
    places = np.zeros(len(ticks), PLACE_DTYPE)
    if not len(ticks):
        return places
    tempo_map, plan = result.score.tempo_map, result.plan
    names = np.asarray(plan.bar_names)
    row = np.minimum(tempo_map.bars_at(ticks), len(names) - 1)
    starts = np.asarray([tempo_map.bar_start(bar) for bar in range(int(row.max()) + 2)])
    within = np.minimum((ticks - starts[row]) / np.diff(starts)[row], 1.0)
    of_bar = np.asarray([tempo_map.meter_at(int(start)).beats for start in starts[:-1]])
    beats = of_bar[row]
    practised = np.asarray(plan.practised_bars)[row]
    is_after = practised < names[row]
    places["row_bar"], places["bar"] = row, practised + 1
    places["beat"] = within * beats + 1 + np.where(is_after, of_bar[np.maximum(row - 1, 0)], 0)
    places["place"] = names[row] + 1 + within
    places["pass"] = np.searchsorted(np.asarray(plan.pass_starts), row, "right")
    return places


def written_hands(result: SessionResult) -> NDArray[np.bool_]:
    """The notes (n,) of the result's score whose hand the lesson writes; all others have the drummer's."""
    lesson = result.plan.lesson.score
    written = np.isin(lesson.notes["limb"], (Limb.RIGHT_HAND, Limb.LEFT_HAND))
    starts = np.asarray([lesson.tempo_map.bar_start(bar) for bar in range(lesson.bar_count + 1)])
    asked = set(zip(lesson.bar[written].tolist(), *_within(lesson, starts, written), strict=True))
    score, names = result.score, np.asarray(result.plan.bar_names)
    starts = np.asarray([score.tempo_map.bar_start(bar) for bar in range(int(score.bar.max(initial=0)) + 1)])
    row = np.minimum(score.bar, len(names) - 1)
    here = zip(names[row].tolist(), *_within(score, starts, np.ones(len(score), np.bool_)), strict=True)
    return np.fromiter((one in asked for one in here), np.bool_, len(score))


def _within(score: Score, starts: NDArray[np.int64], rows: NDArray[np.bool_]) -> tuple[list[int], list[int]]:
    """How many ticks after its bar's start each of the rows lies, and its piece."""
    ticks = score.notes["tick"][rows] - starts[score.bar[rows]]
    return ticks.tolist(), score.notes["piece"][rows].tolist()


def ticks_of_hits(result: SessionResult, at_ns: NDArray[np.int64]) -> NDArray[np.int64]:
    """The tick of the score at which each hit fell, shape (n,), within the score."""
    inside_ns = np.clip(at_ns, 0, max(result.score.length_ns - 1, 0))
    return np.asarray(result.score.tempo_map.ticks_at_ns(inside_ns), np.int64)
