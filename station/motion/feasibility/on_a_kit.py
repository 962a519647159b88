"""What a score asks that no human can play: too many strokes of one limb, or a hand in two far places too soon.

The motion still strikes everything in time, so there a joint turns faster than any joint does; the assignment carries
what is found, and the commands say it. Times in seconds from tick 0.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb
from station.motion.feasibility.limb_speeds import RUNS, fastest_hz
from station.motion.kinematics.foot_path import Visits
from station.motion.kit.kit import Kit
from station.motion.strokes.bounces import bounces_on
from station.motion.strokes.hand_events import SAME_STROKE_S
from station.motion.strokes.targets import strike_points
from station.motion.strokes.travel import MINIMUM_JERK_PEAK, MOST_TRAVEL
from station.music.score import Score

Array = NDArray[np.float64]

_GRAIN_HZ = 1e-5
"""What a few nanoseconds, the grain of the music's times, make of a rate."""
BOUNCE_S = 0.04
"""The second stroke of a double may come this soon: it is a rebound (HUMANS has 50–90 ms)."""
FASTEST_HAND_M_S = 9.1
"""An Olympic boxer's fist in a straight punch (Walilko and others 2005, British Journal of Sports Medicine 39, 710)."""
_NEAR_M = 0.10
"""So near together two contacts need no way: fingers and wrist reach both (our choice)."""


@dataclass(frozen=True, slots=True)
class InfeasibleDemand:
    """One bar's demand on one limb that is beyond a human, at its worst.

    `bar` from 0; `start_s` and `end_s` the strokes that ask it, first and last in the bar; `text` says it.
    """

    bar: int
    limb: Limb
    start_s: float
    end_s: float
    text: str


def infeasible_demands(score: Score, kit: Kit, limbs: NDArray[np.int8]) -> tuple[InfeasibleDemand, ...]:
    """Every bar and limb in which strokes of `score` on `kit` come faster than any human's, in order."""
    score = score.on_the_grid
    points = strike_points(score, kit, limbs)
    found: list[InfeasibleDemand] = []
    for limb in (Limb.RIGHT_HAND, Limb.LEFT_HAND, Limb.RIGHT_FOOT, Limb.LEFT_FOOT):
        rows = np.flatnonzero(limbs == limb)
        rows = rows[np.argsort(score.onset_ns[rows], kind="stable")]
        if len(rows) < 2:
            continue
        times = score.onset_s[rows]
        found += _sundered(limb, times, score.bar[rows], points[rows]) if limb.is_hand else []
        rows = rows[np.diff(times, prepend=-np.inf) > SAME_STROKE_S]
        times = score.onset_s[rows]
        on = bounces_on(times, score.notes["piece"][rows], score.notes["velocity"][rows]) & limb.is_hand
        found += _repeated(limb, times, score.bar[rows], on)
    found += _two_boards(score, kit, limbs)
    return tuple(sorted(found, key=lambda b: (b.bar, b.limb, b.start_s)))


def _repeated(limb: Limb, times: Array, bars: NDArray[np.int64], on: NDArray[np.bool_]) -> list[InfeasibleDemand]:
    """Bars in which three strokes of the limb come too soon after one another, or a run is faster than champions'.

    Strokes that a stick bounces `on` to are not struck: they count only for how soon a stroke comes after them.
    """
    word = "hand" if limb.is_hand else "foot"
    worst: dict[int, tuple[float, float, float]] = {}  # of each bar: rate, first and last stroke
    for strokes, counted in zip(RUNS, (np.ones(len(on), bool), ~on), strict=True):
        last, at_s, in_bar, free = strokes - 1, times[counted], bars[counted], on[counted]
        rate = last / (at_s[last:] - at_s[: max(len(at_s) - last, 0)])
        fast = np.flatnonzero((rate > fastest_hz(limb.is_hand, strokes) + _GRAIN_HZ) & ~free[last:])
        for bar in np.unique(in_bar[fast + 1]).tolist():
            at = fast[in_bar[fast + 1] == bar]
            fastest, start, end = worst.get(bar, (0.0, np.inf, -np.inf))
            found = float(rate[at].max()), float(at_s[at[0]]), float(at_s[at[-1] + last])
            worst[bar] = max(fastest, found[0]), min(start, found[1]), max(end, found[2])
    return [
        InfeasibleDemand(bar, limb, start, end, f"bar {bar + 1} needs {rate:.0f} strokes a second of one {word}")
        for bar, (rate, start, end) in worst.items()
    ]


def _two_boards(score: Score, kit: Kit, limbs: NDArray[np.int8]) -> list[InfeasibleDemand]:
    """Bars in which the hi-hat's foot must be on the slave board and on its own too soon after each other."""
    visits, foot = Visits.of(score, limbs, kit.feet[1]), kit.feet[1]
    late, bars = visits.too_soon, score.bar[visits.row]
    result = []
    for bar in np.unique(bars[late]).tolist():
        at = late[bars[late] == bar]
        gap_s = float((visits.time_s[at] - visits.time_s[at - 1]).min())
        asked = f"within {1000 * gap_s:.0f} ms" if gap_s > SAME_STROKE_S else "at once"
        text = f"bar {bar + 1} needs one foot on the hi-hat's pedal and on the double pedal {asked}"
        result.append(InfeasibleDemand(bar, foot, float(visits.time_s[at[0] - 1]), float(visits.time_s[at[-1]]), text))
    return result


def _sundered(limb: Limb, times: Array, bars: NDArray[np.int64], points: Array) -> list[InfeasibleDemand]:
    """Bars in which the hand must be at places too far from each other for the time between, or strike twice at once.

    Of that time a stroke's rebound and the next one's whip have their share: only the rest is for the way.
    """
    gap, way = np.diff(times), np.linalg.norm(np.diff(points, axis=0), axis=1)
    quickest = MINIMUM_JERK_PEAK * way / FASTEST_HAND_M_S / MOST_TRAVEL
    far = way > _NEAR_M
    late = np.flatnonzero((far & (gap < np.maximum(quickest, BOUNCE_S))) | (gap <= SAME_STROKE_S))
    result = []
    for bar in np.unique(bars[late + 1]).tolist():
        at = late[bars[late + 1] == bar]
        worst = at[np.argmax(quickest[at] - gap[at])]
        asked = f"to go {100 * way[worst]:.0f} cm in {1000 * gap[worst]:.0f} ms"
        if gap[worst] <= SAME_STROKE_S:
            places = f"to be in two places at once, {100 * way[worst]:.0f} cm apart"
            asked = places if far[worst] else "to strike twice at once"
        text = f"bar {bar + 1} needs one hand {asked}"
        result.append(InfeasibleDemand(bar, limb, float(times[at[0]]), float(times[at[-1] + 1]), text))
    return result
