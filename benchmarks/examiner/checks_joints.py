"""Ranges, speeds and continuity of the joints."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from benchmarks.examiner.anatomy import HAND_M_S, MEASURED, SLACK_DEG, STATED, TIP_M_S, Range, measured, turned_deg
from benchmarks.examiner.findings import Findings
from benchmarks.examiner.take import RATE_HZ, SIDES, Sampled, Take

Array = NDArray[np.float64]
Point = Callable[[Sampled], Array]
JUMP = 3.0
"""More than so many times the greatest speed within a millisecond is a jump."""
KINK_M_S = 0.35
"""A point whose velocity changes so much in a millisecond is looked at closely: 36 g, a stroke's own peak
(9.4 m/s in 25 ms, Pearl 2023)."""
_CLOSE_S = 1 / 16000
_KEPT = 0.5
"""Of a smooth change a sixteenth is left on a sixteenth of the time; of a kink all (between them, our choice)."""
NEAR_STRIKE_S = 0.004
_LOOKED_AT = 12


SAID = {"elbow": "elbow", "knee": "knee", "wrist extension": "wrist", "wrist to the thumb": "wrist_side"}
"""What is measured and what the file calls it."""
STATED_DEG = 15.0
"""The two wrist angles depend on their order, and the hand's bones on the fulcrum's place, by so much (our choice)."""
NO_SPEED = ("upper arm backward (measured)", "upper arm across the chest (measured)")
"""The upper arm's own speed is theirs."""


def ranges_and_speeds(take: Take, found: Findings) -> None:
    """Each joint against its range and its greatest speed, by positions and by the stated angles."""
    poses = take.poses
    for name, bound in STATED.items():
        _bounded(found, name, poses.angle(name), bound, poses.time_s)
    for side in SIDES:
        style = take.drummer.style
        angles, turning = measured(poses, side, style.grip_left if side == "left" else style.grip_right)
        for name, stated in SAID.items():
            off = np.abs(poses.angle(f"{side}_{stated}") - angles[name])
            found.note("stated", f"{side}_{stated} is not what is measured", off, STATED_DEG, "°", poses.time_s)
        for name, values in angles.items():
            _bounded(found, f"{side} {name} (measured)", values, MEASURED[name], poses.time_s)
        for name, directions in turning.items():
            _fast(found, f"{side} {name} (measured)", turned_deg(directions), MEASURED[name].speed, poses.time_s)
    for i, side in enumerate(SIDES):
        for name, points, most in (
            ("tip", poses.tip_m[:, i], TIP_M_S),
            ("hand", poses.point(f"{side}_hand"), HAND_M_S),
        ):
            speed = np.linalg.norm(np.diff(points, axis=0), axis=1) * RATE_HZ
            found.note("speed", f"{side} {name}", speed, most, "m/s", poses.time_s[1:])


def _bounded(found: Findings, name: str, values: Array, bound: Range, time_s: Array) -> None:
    shown = ~np.isnan(values)
    values = np.where(~shown, _held(values, bound), values)
    found.note("limit", f"{name} over {bound.most:g}", values - bound.most, SLACK_DEG, "°", time_s)
    found.note("limit", f"{name} under {bound.least:g}", bound.least - values, SLACK_DEG, "°", time_s)
    if name.partition(" ")[2] in NO_SPEED:
        return
    change = np.where(shown[1:] & shown[:-1], np.abs((np.diff(values) + 180) % 360 - 180), 0.0)
    _fast(found, name, change, bound.speed, time_s)


def _held(values: Array, bound: Range) -> Array:
    """The last value that is known, for instants where a straight arm shows none."""
    known = np.maximum.accumulate(np.where(np.isnan(values), 0, np.arange(len(values))))
    return np.nan_to_num(values[known], nan=float(np.clip(0.0, bound.least, bound.most)))


def numbers(take: Take, found: Findings) -> None:
    """No pose holds anything but numbers."""
    poses = take.poses
    for name in ("points_m", "tip_m", "butt_m", "back", "angles_deg", "boards_rad"):
        values = getattr(poses, name).reshape(len(poses.time_s), -1)
        found.note("number", name, np.where(np.isfinite(values).all(axis=1), 0.0, 1.0), 0.0, "n", poses.time_s)


def _fast(found: Findings, name: str, change_deg: Array, most: float, time_s: Array) -> None:
    """Note what turns by `change_deg` (n − 1,) in a millisecond too fast, or jumps."""
    speed = change_deg * RATE_HZ
    jumps = speed > JUMP * most
    found.note("jump", name, np.where(jumps, change_deg, 0.0), 0.0, "°", time_s[1:])
    found.note("speed", name, np.where(jumps, 0.0, speed), most, "°/s", time_s[1:])


def kinks(take: Take, found: Findings) -> None:
    """Points whose velocity jumps away from their own strikes."""
    time_s = take.poses.time_s
    for i, side in enumerate(SIDES):
        hand, foot = (~take.strikes.near(time_s, f"{side}_{x}", NEAR_STRIKE_S, NEAR_STRIKE_S) for x in ("hand", "foot"))
        _kinks(take, found, f"{side} tip", _tip(i), hand)
        for names, free in ((("elbow", "wrist", "hand"), hand), (("knee", "ankle", "toe"), foot)):
            for name in names:
                _kinks(take, found, f"{side} {name}", _joint(f"{side}_{name}"), free)
    for name in ("neck", "crown"):
        _kinks(take, found, name, _joint(name), np.ones(len(time_s), bool))


def _tip(index: int) -> Point:
    return lambda poses: poses.tip_m[:, index]


def _joint(name: str) -> Point:
    return lambda poses: poses.point(name)


def _kinks(take: Take, found: Findings, name: str, point: Point, free: NDArray[np.bool_]) -> None:
    time_s = take.poses.time_s
    velocity = np.diff(point(take.poses), axis=0) * RATE_HZ
    change: Array = np.asarray(np.linalg.norm(np.diff(velocity, axis=0), axis=1) * free[1:-1], np.float64)
    beside = np.maximum(np.roll(change, 2), np.roll(change, -2))  # a break touches two of them at most
    worst = np.argsort(change - beside)[::-1][:_LOOKED_AT]
    worst = worst[change[worst] > KINK_M_S]
    sharp = np.array([_sharpest(take, point, float(time_s[k + 1])) for k in worst])
    if len(sharp):
        kept = sharp > np.maximum(_KEPT * change[worst], KINK_M_S)
        found.note("kink", name, np.where(kept, sharp, 0.0), KINK_M_S, "m/s", time_s[worst + 1])


def _sharpest(take: Take, point: Point, time_s: float) -> float:
    """The greatest change of velocity within a sixteenth of a millisecond about `time_s`."""
    close = time_s + np.arange(-24, 25, dtype=np.float64) * _CLOSE_S
    velocity = np.diff(point(take.sample(close)), axis=0) / _CLOSE_S
    return float(np.linalg.norm(np.diff(velocity, axis=0), axis=1).max())
