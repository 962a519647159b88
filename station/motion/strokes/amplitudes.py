"""How far each joint goes so that the tip rises as a stroke needs: shares of the measured one (`stroke_template`).

Lower strokes are made by the distal joints, and the second strokes of doubles and a pressed stick's bounces by the
fingers alone. Radians and metres; joints in the order of `arm.Offsets`.
"""

import numpy as np
from numpy.typing import NDArray

from station.motion.kinematics.arm import ArmLengths
from station.motion.strokes.stroke_template import FULL_HEIGHT_M, PEAK_RAD, SHARE_AT_TOP, SHARES_NEAR_TOP, WRIST

Array = NDArray[np.float64]

_STILL_BELOW_M = np.array([[0.10], [0.06], [0.0], [0.0]])
"""Taps and ghost strokes are wrist and fingers: below these heights shoulder and elbow are still."""
_GROWTH = np.array([[0.8], [0.75], [0.8], [0.65]])
"""How each joint's part grows with the height over that: distal joints are used first (Altenmüller 2020)."""
_ACROSS = 0.8
"""A stick that lies across the hand keeps its slope but for the rest of this while the arm pitches the hand."""
_DIP_RAD, _DIP_SHARE = 0.03, 0.5
"""How far the wrist goes on down within a double, and at most in shares of the second stroke's angle (our choice)."""


def amplitudes(height_m: Array, contact_angles: Array, lengths: ArmLengths, parts: Array, turns: Array) -> Array:
    """How far each joint goes (4, n) so that the tip rises `height_m` (n,) over the contact.

    `contact_angles` (4, n) are those of upper arm, forearm, hand and stick from hanging straight down, at the contact;
    `parts` (4, 1) what the hold makes of each joint's part, 1 as measured; `turns` (n,) or (1,) as in `Contact`.
    """
    full = np.maximum(FULL_HEIGHT_M - _STILL_BELOW_M, 1e-9)
    part = np.clip((height_m - _STILL_BELOW_M) / full, 0.0, 1.5) ** _GROWTH * PEAK_RAD * parts
    scale = np.ones_like(height_m)
    for _ in range(4):  # Newton: the rise is nearly linear in the scale
        rise, slope = _rise(scale * part, contact_angles, lengths, turns)
        scale = np.clip(scale * (1 - (rise - height_m) / np.maximum(slope, 1e-3)), 0.2, 4.0)
    result: Array = scale * part
    return result


def _rise(amplitude: Array, contact_angles: Array, lengths: ArmLengths, turns: Array) -> tuple[Array, Array]:
    """How high the tip goes, (n,), and how that grows with a common factor on `amplitude` (4, n)."""
    segments = np.array([[lengths.upper], [lengths.fore], [lengths.hand], [lengths.ahead]])
    offsets = SHARES_NEAR_TOP[..., None] * amplitude  # (moments, 4, n)
    turn = np.cumsum(offsets, axis=1)
    turn[:, 2] -= (1 - turns) * offsets[:, WRIST]
    if lengths.across:
        turn[:, 3] -= _ACROSS * (offsets[:, 0] + offsets[:, 1])
    angles = contact_angles + turn
    rise = (segments * (np.cos(contact_angles) - np.cos(angles))).sum(1)
    slope = (segments * turn * np.sin(angles)).sum(1)
    highest = np.argmax(rise, axis=0)[None]
    return np.take_along_axis(rise, highest, 0)[0], np.take_along_axis(slope, highest, 0)[0]


def rebounds(
    amplitude: Array,
    height_m: Array,
    doubled: NDArray[np.bool_],
    bounced: NDArray[np.bool_],
    levers: tuple[float, Array],
) -> Array:
    """`amplitude` (4, n), but that the stick and the fingers alone raise `doubled` and `bounced` strokes (n,).

    Between the two strokes of a double the wrist goes on down a little, so that it makes one motion of both; it stays
    where it is while a pressed stick bounces. `levers` in metres: from the fulcrum to the tip, and (n,) what
    the wrist turns.
    """
    ahead, turned = levers
    dip = np.where(doubled, np.minimum(_DIP_RAD, _DIP_SHARE * height_m / ahead), 0.0)
    stick = (height_m + dip * turned) / ahead
    zero = np.zeros_like(dip)
    result: Array = np.where(doubled | bounced, np.stack([zero, zero, -dip, stick]) / SHARE_AT_TOP, amplitude)
    return result


def top(amplitude: Array) -> Array:
    """The offsets (4, n) of strokes with `amplitude` (4, n) about where the tip is highest."""
    result: Array = amplitude * SHARE_AT_TOP
    return result
