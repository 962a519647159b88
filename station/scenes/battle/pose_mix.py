"""A pose between two others: no limb, stick or pedal is anywhere that lies between neither.

Numbers are mixed in the plane; what must keep its length is then given it back. An elbow or knee goes where upper and
lower part meet between shoulder and wrist, hip and ankle, bent as it was; a stick turns about the hand that holds it.
What rings on after a stroke (`frame.PLAYED`) is counted from that stroke, so that a ripple is one of the two.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from station.motion.kinematics import frame
from station.motion.kinematics.figure import Joint
from station.motion.kinematics.pose import Pose
from station.motion.kit.instruments import NUMBERS

Row = NDArray[np.float64]

_BENT = (
    (Joint.RIGHT_SHOULDER, Joint.RIGHT_ELBOW, Joint.RIGHT_WRIST),
    (Joint.LEFT_SHOULDER, Joint.LEFT_ELBOW, Joint.LEFT_WRIST),
    (Joint.RIGHT_HIP, Joint.RIGHT_KNEE, Joint.RIGHT_ANKLE),
    (Joint.LEFT_HIP, Joint.LEFT_KNEE, Joint.LEFT_ANKLE),
)
_HANDS = (Joint.RIGHT_HAND, Joint.LEFT_HAND)
_WAYS = (*(slice(s, s + 3) for s in (frame.PALM.start, frame.PALM.start + 3)), frame.FACING, frame.HEAD_UP)
_RIPPLE = 3
"""Where an instrument's ripple begins in its numbers."""


def minimum_jerk(share: float) -> float:
    """How far a movement from rest to rest is after `share` of its time, 0 … 1 (Flash and Hogan 1985)."""
    s = min(max(share, 0.0), 1.0)
    return s * s * s * (10.0 - 15.0 * s + 6.0 * s * s)


def mixed(one: Pose, other: Pose, share: float) -> Pose:
    """`one` at share 0, `other` at 1, and whatever is between them; both of one kit and one figure."""
    if share <= 0.0:
        return one
    if share >= 1.0:
        return other
    row = one.row + share * (other.row - one.row)
    nearer = other if share >= 0.5 else one
    ripples = row[frame.PLAYED :].reshape(-1, NUMBERS)
    ripples[:, _RIPPLE:] = nearer.row[frame.PLAYED :].reshape(-1, NUMBERS)[:, _RIPPLE:]
    restore_lengths(row, one.row)
    return Pose(other.time_s, row, nearer.holds)


def restore_lengths(row: Row, like: Row, limbs: Sequence[int] = (0, 1, 2, 3)) -> None:
    """Give the limbs of `row` the lengths that they have in `like`: 0 and 1 the arms, 2 and 3 the legs."""
    joints, own = row[frame.JOINTS].reshape(21, 3), like[frame.JOINTS].reshape(21, 3)
    for limb in limbs:
        if limb < 2:
            _hold(row, like, limb)
        top, middle, end = _BENT[limb]
        upper, lower = np.linalg.norm(own[middle] - own[top]), np.linalg.norm(own[end] - own[middle])
        joints[middle] = _elbow(joints[top], joints[middle], joints[end], float(upper), float(lower))
    for way in _WAYS:
        length = np.linalg.norm(row[way])
        row[way] = row[way] / length if length > _NOTHING else like[way]


_NOTHING = 1e-6


def _elbow(top: Row, bent: Row, end: Row, upper_m: float, lower_m: float) -> Row:
    """Where the middle joint of two parts is whose ends are given, on the side to which it was `bent`."""
    line = end - top
    far = float(np.linalg.norm(line))
    if far < _NOTHING:
        return bent
    along = line / far
    reach = min(max(far, abs(upper_m - lower_m) + _NOTHING), upper_m + lower_m)
    at = (reach * reach + upper_m * upper_m - lower_m * lower_m) / (2.0 * reach)
    out = bent - top - along * float((bent - top) @ along)
    wide = float(np.linalg.norm(out))
    if wide < _NOTHING:
        return bent
    found: Row = top + along * at * far / reach + out / wide * np.sqrt(max(upper_m * upper_m - at * at, 0.0))
    return found


def _hold(row: Row, like: Row, side: int) -> None:
    """Let what a hand holds be as long as it is, on the line between its ends, at the hand as it was."""
    butt, tip = (
        slice(frame.BUTT.start + 3 * side, frame.BUTT.start + 3 * side + 3),
        slice(frame.TIP.start + 3 * side, frame.TIP.start + 3 * side + 3),
    )
    at = slice(frame.JOINTS.start + 3 * _HANDS[side], frame.JOINTS.start + 3 * _HANDS[side] + 3)
    way, own = row[tip] - row[butt], like[tip] - like[butt]
    length, own_length = np.linalg.norm(way), np.linalg.norm(own)
    if length < _NOTHING or own_length < _NOTHING:
        return
    behind = float((like[at] - like[butt]) @ own) / own_length
    along = way / length
    middle = row[butt] + along * float((row[at] - row[butt]) @ along)
    row[butt], row[tip] = middle - along * behind, middle + along * (own_length - behind)
