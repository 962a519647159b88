"""A pair of sticks that plays: `play` is the simulator's front door.

Everything is drawn from one seed. Times are seconds of the session; the recording begins `LEAD_S` before the first
stroke or gesture, with the sticks hovering over the kit, and ends `TAIL_S` after the last.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from station.core.events import Hit
from station.core.pieces import Limb
from station.simulation.sticks.swing_body import LENGTH_M
from station.simulation.sticks.swing_contact import Contact, contacts
from station.simulation.sticks.swing_motion import FINE_HZ, GRIPS, StickPath, stick_motion
from station.simulation.sticks.swing_pads import ModuleSpec, pad_hits
from station.simulation.sticks.swing_sensor import SensorSpec, SimulatedStick, measure
from station.simulation.sticks.swing_spec import StickGesture, StickStrokeSpec, StrokeKind

HANDS = (Limb.RIGHT_HAND, Limb.LEFT_HAND)
LEAD_S, TAIL_S = 2.5, 1.5
"""Our choice: long enough for a sensor at rest to be told from one in use, and for a filter to settle."""

TRUTH_DTYPE = np.dtype(
    [
        ("at_s", np.float64),  # onset of the touch; in the air the peak of the tip's |acceleration|
        ("limb", np.int8),
        ("piece", np.uint8),
        ("zone", np.uint8),
        ("kind", "U6"),  # a StrokeKind
        ("speed_m_s", np.float64),  # of the tip just before
        ("height_m", np.float64),  # where the tip's last descent began, above the touch
        ("rebound", np.float64),  # speed of the tip after over before
        ("angle_rad", np.float64),  # of the stick above the horizontal, at the touch
        ("lasts_s", np.float64),  # of the touch
        ("spec", np.int64),  # row of the stroke in what was asked for
        ("bounce", np.int64),  # 0 the stroke, 1 … what a buzz adds
    ]
)


@dataclass(frozen=True, slots=True)
class StickPair:
    """Who holds what: a sensor for each hand and a grip (a key of `GRIPS`); the devices' names follow the limbs."""

    sensors: Mapping[Limb, SensorSpec] = field(default_factory=lambda: {hand: SensorSpec() for hand in HANDS})
    grips: Mapping[Limb, str] = field(default_factory=lambda: dict.fromkeys(HANDS, "american"))


@dataclass(frozen=True, slots=True)
class SimulatedSticks:
    """What two sticks and a kit reported, and the truth.

    `truth` (n,) of `TRUTH_DTYPE` by time; `pad_hits` in order of arrival and `pad_truth` (their number,) the row of
    `truth` each belongs to, −1 for a false one.
    """

    sticks: Mapping[Limb, SimulatedStick]
    truth: NDArray[np.void]
    pad_hits: tuple[Hit, ...]
    pad_truth: NDArray[np.int64]


def play(
    strokes: Sequence[StickStrokeSpec],
    gestures: Sequence[StickGesture] = (),
    *,
    pair: StickPair | None = None,
    module: ModuleSpec | None = None,
    seed: int = 0,
) -> SimulatedSticks:
    """The strokes and gestures, played and measured; the same seed gives the same bits.

    A stroke that begins while its hand still touches (within 12 ms of the last touch's end) is left out.
    """
    rng = np.random.default_rng(seed)
    pair = StickPair() if pair is None else pair
    touches = contacts(strokes, rng)
    span = _span(touches, gestures)
    sticks, motions = {}, {}
    for hand in HANDS:
        own = [t for t in touches if t.limb is hand]
        moved = stick_motion(own, [g for g in gestures if g.limb is hand], hand, span, GRIPS[pair.grips[hand]], rng)
        motions[hand] = moved
        sticks[hand] = measure(moved, pair.sensors[hand], f"stick-{hand.name.lower()}", rng)
    hits, rows = pad_hits(touches, ModuleSpec() if module is None else module, rng)
    return SimulatedSticks(sticks, _truth(touches, motions), hits, rows)


def _span(touches: Sequence[Contact], gestures: Sequence[StickGesture]) -> tuple[float, float]:
    starts = [t.onset_s for t in touches] + [g.at_s for g in gestures]
    ends = [t.end_s for t in touches] + [g.at_s + g.lasts_s for g in gestures]
    return min(starts, default=LEAD_S) - LEAD_S, max(ends, default=LEAD_S) + TAIL_S


def _truth(touches: Sequence[Contact], motions: Mapping[Limb, StickPath]) -> NDArray[np.void]:
    """What the sticks did at each touch, read off their paths."""
    truth = np.zeros(len(touches), TRUTH_DTYPE)
    tips = {limb: motion.point_m(LENGTH_M) for limb, motion in motions.items()}
    speeds = {limb: np.gradient(tip, 1 / FINE_HZ, axis=0) for limb, tip in tips.items()}
    for row, touch in enumerate(touches):
        motion, tip, speed = motions[touch.limb], tips[touch.limb], speeds[touch.limb]
        first, last = np.searchsorted(motion.time_s, [touch.onset_s, touch.end_s]).tolist()
        coming, going = (float(np.linalg.norm(speed[i])) for i in (first - 1, last + 1))
        height = float(tip[_descends_from(speed[:first, 2]), 2] - tip[first, 2])
        at_s = touch.onset_s
        if touch.kind is StrokeKind.AIR:
            push = np.linalg.norm(np.gradient(speed[first : last + 1], 1 / FINE_HZ, axis=0), axis=1)
            at_s = float(motion.time_s[first + int(push.argmax())])
        truth[row] = (
            at_s,
            touch.limb,
            touch.piece,
            touch.zone,
            touch.kind.value,
            coming,
            height,
            going / coming if coming else 0.0,
            float(np.arcsin(np.sin(motion.elevation_rad[first]))),
            touch.lasts_s,
            touch.spec,
            touch.bounce,
        )
    return truth


def _descends_from(speed_m_s: NDArray[np.float64]) -> int:
    """The index at which the last descent of `speed_m_s` (n,) began."""
    rising = np.flatnonzero(speed_m_s >= 0)
    return int(rising[-1]) if len(rising) else 0
