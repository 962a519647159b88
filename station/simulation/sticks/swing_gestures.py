"""Motions that are no strokes, as additions to a stick's path: lifts, twitches, waves, scratches, twirls, rests.

Speeds and sizes are our choice from everyday life; each begins and ends at rest, where the strokes left the stick.
"""

import math
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from station.simulation.sticks.swing_path import Knot, along
from station.simulation.sticks.swing_places import LAP
from station.simulation.sticks.swing_spec import GestureKind, StickGesture

Floats = NDArray[np.float64]

ADDED = ("x_m", "y_m", "z_m", "turn_rad", "rise_rad", "roll_rad", "calm")
"""What a gesture adds to: the fulcrum's place, the stick's heading, elevation and roll; `calm` 1 stops the tremor."""

_LASTING = (GestureKind.REGRIP, GestureKind.TWIRL)
"""A stick that was turned stays turned."""

EASE_S = 0.4
"""How long a gesture takes to begin and to end, where it lasts long enough: a hand in a hurry reaches 40 cm in 0.25 s
(`shared/HUMANS.md`), one at ease takes half as long again (our choice)."""


def added_motion(gestures: Sequence[StickGesture], times_s: Floats, base: Floats) -> dict[str, Floats]:
    """What `gestures` of one hand add at `times_s` (n,); `base` (n, 3) is where the fulcrum would be without them."""
    added = {name: np.zeros(len(times_s)) for name in ADDED}
    for gesture in gestures:
        inside = (times_s >= gesture.at_s - 0.01) & (times_s <= gesture.at_s + gesture.lasts_s + 0.01)
        part = slice(int(inside.argmax()), int(inside.argmax() + inside.sum()))
        if gesture.kind in _LASTING:
            part = slice(part.start, len(times_s))
        for name, values in _MOTIONS[gesture.kind](gesture, times_s[part], base[part]).items():
            added[name][part] += values
    return added


def _envelope(gesture: StickGesture, times_s: Floats) -> Floats:
    """From 0 to 1 and back to 0, both by minimum jerk."""
    ease = min(EASE_S, gesture.lasts_s / 2 - 1e-3)
    end = gesture.at_s + gesture.lasts_s
    return along(
        [Knot(gesture.at_s, 0.0), Knot(gesture.at_s + ease, 1.0), Knot(end - ease, 1.0), Knot(end, 0.0)], times_s
    )


def _lift(gesture: StickGesture, times_s: Floats, base: Floats) -> dict[str, Floats]:
    """Raised by 20 cm and half a right angle, held, and lowered again without touching."""
    shape = gesture.size * _envelope(gesture, times_s)
    return {"z_m": 0.20 * shape, "rise_rad": math.radians(40) * shape}


def _twitch(gesture: StickGesture, times_s: Floats, base: Floats) -> dict[str, Floats]:
    """A jerk of the wrist by 15° and back."""
    return {"rise_rad": math.radians(15) * gesture.size * _envelope(gesture, times_s)}


def _wave(gesture: StickGesture, times_s: Floats, base: Floats) -> dict[str, Floats]:
    """The stick raised and waved to and fro twice a second."""
    shape = gesture.size * _envelope(gesture, times_s)
    swing = np.sin(2 * math.pi * 2.0 * (times_s - gesture.at_s)) * shape
    return {"z_m": 0.25 * shape, "rise_rad": math.radians(35) * shape, "turn_rad": math.radians(30) * swing}


def _scratch(gesture: StickGesture, times_s: Floats, base: Floats) -> dict[str, Floats]:
    """The hand at the head, scratching five times a second."""
    shape = _envelope(gesture, times_s)
    swing = np.sin(2 * math.pi * 5.0 * (times_s - gesture.at_s)) * shape * gesture.size
    return {"z_m": 0.45 * shape, "y_m": -0.2 * shape + 0.02 * swing, "rise_rad": 0.9 * shape + 0.08 * swing}


def _twirl(gesture: StickGesture, times_s: Floats, base: Floats) -> dict[str, Floats]:
    """Raised, spun through the fingers (a whole turn for each `size`), and brought back."""
    shape = _envelope(gesture, times_s)
    quarter = gesture.lasts_s / 4
    turns = max(1, round(gesture.size))
    spin = along([Knot(gesture.at_s + quarter, 0.0), Knot(gesture.at_s + 3 * quarter, 2 * math.pi * turns)], times_s)
    return {"z_m": 0.15 * shape, "rise_rad": spin, "turn_rad": 0.3 * shape}


def _rest(gesture: StickGesture, times_s: Floats, base: Floats) -> dict[str, Floats]:
    """Laid on the lap, still, and taken up again; it lands softly, at a few tenths of a metre a second."""
    ease, settles = min(0.5, gesture.lasts_s / 4), min(0.2, gesture.lasts_s / 8)
    start, end = gesture.at_s, gesture.at_s + gesture.lasts_s
    landing = 0.004
    shape = along(
        [
            Knot(start, 0.0),
            Knot(start + ease, 1 - landing, 0.5),
            Knot(start + ease + min(0.03, settles), 1.0),
            Knot(end - ease, 1.0),
            Knot(end, 0.0),
        ],
        times_s,
    )
    side = 1.0 if len(base) and base[0, 0] > 0 else -1.0
    lap = np.array([side * LAP[0], LAP[1] - 0.25, LAP[2]]) - base
    still = along(
        [Knot(start + ease, 0.0), Knot(start + ease + settles, 1.0), Knot(end - ease, 1.0), Knot(end, 0.0)], times_s
    )
    return {"x_m": lap[:, 0] * shape, "y_m": lap[:, 1] * shape, "z_m": lap[:, 2] * shape, "calm": still}


def _regrip(gesture: StickGesture, times_s: Floats, base: Floats) -> dict[str, Floats]:
    """The stick rolled in the fingers by 50°, for good."""
    end = gesture.at_s + gesture.lasts_s
    return {"roll_rad": math.radians(50) * gesture.size * along([Knot(gesture.at_s, 0.0), Knot(end, 1.0)], times_s)}


_MOTIONS: dict[GestureKind, Callable[[StickGesture, Floats, Floats], dict[str, Floats]]] = {
    GestureKind.LIFT: _lift,
    GestureKind.TWITCH: _twitch,
    GestureKind.WAVE: _wave,
    GestureKind.SCRATCH: _scratch,
    GestureKind.TWIRL: _twirl,
    GestureKind.REST: _rest,
    GestureKind.REGRIP: _regrip,
}
