"""Whether a performance is possible: what its poses pass through, bend too far or move too fast, and where.

For tests, benchmarks and whoever edits a kit or a style. Poses are looked at `RATE_HZ` times a second and at every
strike. What no human can play (`Assignment.infeasible`) is left out of the joints' speeds and limits, a little before
and after it, for there the strokes come first.
"""

import math
from dataclasses import dataclass, replace
from math import inf

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb, word
from station.motion.drummer import Drummer
from station.motion.kinematics import frame
from station.motion.kinematics.collisions import collisions
from station.motion.kinematics.joint_limits import FASTEST_RAD_S, Limits
from station.motion.kinematics.pose import ANGLE_NAMES
from station.motion.strokes.hand_events import SAME_STROKE_S
from station.motion.strokes.targets import Strike, target_of
from station.motion.strokes.variation import SPOT_M

Array = NDArray[np.float64]

RATE_HZ = 240.0
_BLOCK_S = 20.0
"""Poses are made for so long at once, which keeps a long score's memory small (our choice)."""
_AROUND_S = 0.5
"""So long before and after what no human can do the joints may still make up for it (our choice)."""
_LEAST_STEP_S = 1e-4
"""Nearer moments tell no speed."""

KINDS = ("kit_m", "hands_m", "body_m", "limit_rad", "speed", "strike_m")


@dataclass(frozen=True, slots=True)
class Worst:
    """The worst of one kind: how much, when, and of what."""

    value: float = 0.0
    time_s: float = 0.0
    what: str = ""


@dataclass(frozen=True, slots=True)
class Audit:
    """The worst of each of `KINDS`.

    `kit_m` how deep a stick is in a drum or cymbal, `hands_m` a stick, hand or arm in the other, `body_m` in trunk,
    head
    or thighs, and a hand or forearm in the kit, `limit_rad` how far a
    joint is beyond its limit, `speed` the share of the fastest that people turn it, `strike_m` how far a tip is from
    the spot of `SPOT_M` that it strikes.
    """

    kit_m: Worst = Worst()
    hands_m: Worst = Worst()
    body_m: Worst = Worst()
    limit_rad: Worst = Worst()
    speed: Worst = Worst()
    strike_m: Worst = Worst()

    def worse(self, other: "Audit", where: str = "") -> "Audit":
        """The worse of both, kind by kind; `where` is put before what `other` tells."""
        found = {}
        for kind in KINDS:
            mine, theirs = getattr(self, kind), getattr(other, kind)
            found[kind] = mine if mine.value >= theirs.value else replace(theirs, what=f"{where}{theirs.what}")
        return Audit(**found)


def audit(drummer: Drummer, until_s: float = inf) -> Audit:
    """The worst of all kinds in the performance of `drummer`, up to `until_s`."""
    onsets = drummer.score.onset_s
    end = min(until_s, float(onsets.max(initial=0.0)) + 1.0)
    result = Audit(strike_m=_strikes(drummer, end))
    low, high = _bounds(drummer.figure.limits)
    for start in np.arange(-1.0, end, _BLOCK_S).tolist():
        stop = min(start + _BLOCK_S, end)
        struck = onsets[(onsets >= start) & (onsets < stop)]
        times = np.union1d(np.arange(start, stop + 1 / RATE_HZ, 1 / RATE_HZ), struck)
        result = result.worse(_block(drummer, times, low, high))
    return result


def _block(drummer: Drummer, times: Array, low: Array, high: Array) -> Audit:
    rows = drummer.rows(times)
    found = collisions(rows, drummer.kit, drummer.figure.stature_m)
    sides = ("right", "left")
    kit = {f"{s} stick in {word(p)}": d[:, k] for p, d in found.pieces.items() for k, s in enumerate(sides)}
    angles = rows[:, frame.ANGLES]
    human = np.ones(len(times), bool)
    for demand in drummer.assignment.infeasible:
        human &= (times < demand.start_s - _AROUND_S) | (times > demand.end_s + _AROUND_S)
    step = np.diff(times)
    counted = (step > _LEAST_STEP_S) & human[1:]
    speed = np.abs(np.diff(angles, axis=0))[counted] / step[counted, None] / _FASTEST
    over = np.maximum(angles - high, low - angles)[human]
    return Audit(
        kit_m=_worst(kit, times),
        hands_m=_worst({what: d for what, d in found.limbs.items() if "other" in what}, times),
        body_m=_worst({what: d for what, d in found.limbs.items() if "other" not in what}, times),
        limit_rad=_worst(dict(zip(ANGLE_NAMES, over.T, strict=True)), times[human]),
        speed=_worst(dict(zip(ANGLE_NAMES, speed.T, strict=True)), times[1:][counted]),
    )


def _worst(found: dict[str, Array], times: Array) -> Worst:
    """The greatest of all, with its time and name."""
    if not len(times):
        return Worst()
    name = max(found, key=lambda key: float(found[key].max()))
    k = int(np.argmax(found[name]))
    return Worst(max(float(found[name][k]), 0.0), float(times[k]), name)


def _strikes(drummer: Drummer, end_s: float) -> Worst:
    """How far the part of the stick that touches is from what it aims at, at the hands' strokes."""
    score, limbs = drummer.score, drummer.assignment.limbs
    rows = np.flatnonzero(np.isin(limbs, (Limb.RIGHT_HAND, Limb.LEFT_HAND)) & (score.onset_s < end_s))
    tips = drummer.rows(score.onset_s[rows])[:, frame.TIP].reshape(-1, 2, 3)
    worst = Worst()
    moved = {Limb.RIGHT_HAND: -inf, Limb.LEFT_HAND: -inf}
    for k in np.argsort(score.onset_ns[rows], kind="stable").tolist():
        row = int(rows[k])
        limb, note = Limb(int(limbs[row])), score[row]
        before, moved[limb] = moved[limb], float(score.onset_s[row])
        if moved[limb] - before <= SAME_STROKE_S:
            continue  # one hand makes one movement of both; in far places the assignment says so
        target = target_of(drummer.kit, Strike(note.piece, note.zone, note.articulation, limb))
        if not target.shoulder:
            away = tips[k, limb] - target.point_m
            over = float(away @ target.normal)  # a spot has a size, but a head has no thickness
            aside = float(np.linalg.norm(away - over * target.normal))
            off = math.hypot(over, max(aside - SPOT_M, 0.0))
            if off > worst.value:
                worst = Worst(off, float(score.onset_s[row]), f"{word(limb)} on {word(note.piece)}")
    return worst


_FASTEST = np.array([FASTEST_RAD_S[name] for name in ANGLE_NAMES])


def _bounds(limits: Limits) -> tuple[Array, Array]:
    """The least and greatest of each angle; without bound where no limit is known."""
    arm = {
        "shoulder": (-limits.shoulder_extension, limits.shoulder_flexion),
        "elbow": (0.0, limits.elbow_flexion),
        "wrist": (-limits.wrist_flexion, limits.wrist_extension),
        "wrist_side": (-limits.wrist_ulnar, limits.wrist_radial),
        "stick": (-limits.fingers, limits.fingers),
        "hip": (-inf, limits.hip_flexion),
        "knee": (0.0, limits.knee_flexion),
        "ankle": (-limits.ankle_plantar, limits.ankle_dorsi),
    }
    bounds = {f"{side}_{joint}": pair for side in ("right", "left") for joint, pair in arm.items()}
    bounds["head_turn"] = (-limits.neck_rotation, limits.neck_rotation)
    low, high = np.array([bounds.get(name, (-inf, inf)) for name in ANGLE_NAMES]).T
    return low, high
