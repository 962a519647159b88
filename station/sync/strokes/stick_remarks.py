"""What the sensors show of how the sticks are used: figures of each hand, and the few things worth a sentence.

Heights, speeds and rebounds are those of `StickStroke`. A remark says how large the effect is, with its 95 % interval:
it is made only where that interval lies beyond what counts: the size in the table of faults, or the lesson's own.
Nothing is said of what no sensor told.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from statistics import fmean, median, stdev

from station.core.events import Hit, StickStroke
from station.core.imu import STANDARD_GRAVITY_M_S2
from station.core.pieces import Limb
from station.scoring.analysis.fault_table import Asked

FEWEST = 12
"""Strokes of a hand, at least, before anything is said of it; our choice, as for praise."""
Z_95 = 1.96
HELD_BACK = 0.9
"""A stick that reaches less than this share of the speed of a free fall from its height is held back. Pivoted at
a third of its length, its tip falls with g (rod of uniform mass: 0.27 m · g · 0.068 m / 0.0183 m² = 1.0 g)."""
VARIED = 0.25
"""Loudness must vary by so much (SD of log velocity) to show what makes it: a written accent is twice a tap."""


@dataclass(frozen=True, slots=True)
class StickFigures:
    """A hand's strokes: how many, medians of height (m), speed (m/s) and rebound, the share that clipped the gyro."""

    strokes: int
    height_m: float | None
    speed_m_s: float | None
    rebound: float | None
    clipped: float


@dataclass(frozen=True, slots=True)
class StickRemark:
    """One sentence: its word, the text, the effect and its 95 % interval in `unit`."""

    kind: str
    text: str
    effect: float
    ci: tuple[float, float]
    unit: str


@dataclass(frozen=True, slots=True)
class StickReport:
    """The figures of each hand that played with a sensor, and at most a handful of remarks."""

    hands: dict[Limb, StickFigures]
    remarks: tuple[StickRemark, ...]


Pair = tuple[Hit, StickStroke]


def stick_report(pairs: Sequence[Pair], asked: Asked | None = None) -> StickReport | None:
    """Of hits, each with the stroke that made it (`hand_naming.strokes_of_hits`); None where there are none.

    `asked` are the sizes from which a lesson minds what it says.
    """
    asked = asked or Asked()
    hands = {limb: [pair for pair in pairs if pair[1].limb is limb] for limb in (Limb.RIGHT_HAND, Limb.LEFT_HAND)}
    hands = {limb: own for limb, own in hands.items() if own}
    if not hands:
        return None
    remarks = [*_uneven(hands, asked)]
    for limb, own in hands.items():
        remarks += [*_held_back(limb, own, asked), *_by_height(limb, own, asked), *_turned(limb, own, asked)]
    figures = {limb: _figures([stroke for _, stroke in own]) for limb, own in hands.items()}
    return StickReport(figures, tuple(remarks))


def _figures(strokes: Sequence[StickStroke]) -> StickFigures:
    heights = [stroke.height_m for stroke in strokes if stroke.height_m is not None]
    speeds = [stroke.speed_m_s for stroke in strokes if stroke.speed_m_s is not None]
    rebounds = [stroke.rebound for stroke in strokes if stroke.rebound is not None]
    clipped = sum(stroke.clipped for stroke in strokes) / len(strokes)
    return StickFigures(len(strokes), _middle(heights), _middle(speeds), _middle(rebounds), clipped)


def _middle(values: Sequence[float]) -> float | None:
    return median(values) if values else None


# --- both hands -------------------------------------------------------------------------------------------------------


def _uneven(hands: dict[Limb, list[Pair]], asked: Asked) -> Iterator[StickRemark]:
    """Heights and rebounds that differ between the hands."""
    right, left = ([stroke for _, stroke in hands.get(limb, ())] for limb in (Limb.RIGHT_HAND, Limb.LEFT_HAND))
    higher = 1 + asked.least("uneven_heights") / 100
    heights = [_logs([stroke.height_m for stroke in own]) for own in (right, left)]
    if (apart := _difference(*heights)) is not None and _beyond(apart, math.log(higher)):
        means_cm = [100 * math.exp(fmean(each)) for each in heights]
        text = f"Your sticks rise unevenly: {means_cm[0]:.0f} cm right, {means_cm[1]:.0f} cm left"
        mean, low, high = (math.exp(each) for each in apart)
        yield StickRemark("uneven_heights", text, mean, (low, high), "right / left")
    rebounds = [[stroke.rebound for stroke in own if stroke.rebound is not None] for own in (right, left)]
    if (apart := _difference(*rebounds)) is not None and _beyond(apart, asked.least("uneven_rebound") / 100):
        name = "right" if apart[0] > 0 else "left"
        text = f"Your {name} stick rebounds more freely: {fmean(rebounds[0]):.0%} right, {fmean(rebounds[1]):.0%} left"
        yield StickRemark("uneven_rebound", text, apart[0], apart[1:], "of the speed")


# --- one hand ---------------------------------------------------------------------------------------------------------


def _held_back(limb: Limb, own: Sequence[Pair], asked: Asked) -> Iterator[StickRemark]:
    """Sticks that fall more slowly than by their own weight: lifted, then braked."""
    known = [(s.speed_m_s, s.height_m) for _, s in own if s.speed_m_s is not None and s.height_m and not s.clipped]
    if len(known) < FEWEST:
        return
    slow = sum(speed < HELD_BACK * math.sqrt(2 * STANDARD_GRAVITY_M_S2 * height) for speed, height in known)
    share = slow / len(known)
    error = Z_95 * math.sqrt(max(share * (1 - share), 1 / len(known)) / len(known))
    if share - error > asked.least("wasted_motion") / 100:
        text = (
            f"Your {_hand(limb)} stick is held back in {share:.0%} of its strokes: it falls slower than by its weight"
        )
        yield StickRemark("wasted_motion", text, share, (share - error, min(share + error, 1.0)), "of the strokes")


def _by_height(limb: Limb, own: Sequence[Pair], asked: Asked) -> Iterator[StickRemark]:
    """Loud and soft strokes from the same height."""
    known = [(math.log(hit.fine_velocity), math.log(s.height_m)) for hit, s in own if s.height_m]
    if len(known) < FEWEST or stdev(velocity for velocity, _ in known) < VARIED:
        return
    slope, error = _slope([velocity for velocity, _ in known], [height for _, height in known])
    if slope + Z_95 * error < 1 - asked.least("same_height") / 100:
        text = f"Your {_hand(limb)} hand makes loud and soft from the same height: let the height make the difference"
        yield StickRemark(
            "same_height", text, slope, (slope - Z_95 * error, slope + Z_95 * error), "log height / log velocity"
        )


def _turned(limb: Limb, own: Sequence[Pair], asked: Asked) -> Iterator[StickRemark]:
    """A stick that has turned in the hand, from the first third of its strokes to the last."""
    rolls = [stroke.roll_rad for _, stroke in own if stroke.roll_rad is not None]
    third = len(rolls) // 3
    if third < FEWEST:
        return
    start = _circular_mean(rolls[:third])
    near = [math.remainder(roll - start, math.tau) for roll in rolls]
    apart = _difference(near[-third:], near[:third])
    if apart is not None and _beyond(apart, math.radians(asked.least("grip_changed"))):
        degrees = [math.degrees(each) for each in apart]
        text = f"Your {_hand(limb)} stick has turned by {abs(degrees[0]):.0f}° in your hand: the grip has changed"
        yield StickRemark("grip_changed", text, degrees[0], (degrees[1], degrees[2]), "°")


# --- figures ----------------------------------------------------------------------------------------------------------


def _hand(limb: Limb) -> str:
    return "right" if limb is Limb.RIGHT_HAND else "left"


def _logs(values: Sequence[float | None]) -> list[float]:
    return [math.log(value) for value in values if value is not None and value > 0]


def _difference(a: Sequence[float], b: Sequence[float]) -> tuple[float, float, float] | None:
    """Mean of `a` less mean of `b`, and its 95 % interval (Welch); None where there are too few."""
    if min(len(a), len(b)) < FEWEST:
        return None
    error = Z_95 * math.sqrt(stdev(a) ** 2 / len(a) + stdev(b) ** 2 / len(b))
    mean = fmean(a) - fmean(b)
    return mean, mean - error, mean + error


def _beyond(apart: tuple[float, float, float], least: float) -> bool:
    return apart[1] > least or apart[2] < -least


def _slope(x: Sequence[float], y: Sequence[float]) -> tuple[float, float]:
    """Least squares slope of `y` over `x`, and its standard error; 0 with an infinite one where x does not vary."""
    mean_x, mean_y = fmean(x), fmean(y)
    spread = sum((each - mean_x) ** 2 for each in x)
    if spread < 1e-6 * len(x):
        return 0.0, math.inf
    slope = sum((a - mean_x) * (b - mean_y) for a, b in zip(x, y, strict=True)) / spread
    left = sum((b - mean_y - slope * (a - mean_x)) ** 2 for a, b in zip(x, y, strict=True))
    return slope, math.sqrt(left / (len(x) - 2) / spread)


def _circular_mean(angles: Sequence[float]) -> float:
    return math.atan2(sum(map(math.sin, angles)), sum(map(math.cos, angles)))
