"""What of a snapshot moves or glows in the scene: the demonstrator, the pieces that are struck, the double."""

from collections.abc import Iterable
from dataclasses import replace
from enum import IntEnum

import numpy as np

from station.core.pieces import Piece
from station.motion.kinematics.pose import Pose
from station.motion.kit.kit import Kit
from station.render.gpu.bone_palette import BoneFrame, Colour
from station.render.palette import BRAND, EARLY, GOOD, LATE, MISSED, WRONG, Theme, over_picture, themed
from station.render.snapshot import OnStage, SeenStrike, Snapshot, TimingCue

_GLOW_FADE_S = 0.16
"""How fast a struck piece stops glowing (our choice)."""
_DEMONSTRATOR_GLOW, _STUDENT_GLOW = 0.35, 1.1


class DoublePlace(IntEnum):
    """Where the student's double is: nowhere, over the demonstrator, or in a picture of its own beside it."""

    NOWHERE = 0
    OVER = 1
    BESIDE = 2


def frames_of(snapshot: Snapshot, where: DoublePlace, theme: Theme) -> list[BoneFrame]:
    """What of the snapshot moves or glows in the scene: in one picture, or in the demonstrator's and the student's."""
    double = snapshot.double
    if snapshot.rival is not None:
        return [_of_two(snapshot, snapshot.rival)]
    if double is not None and double.is_compared and where is DoublePlace.NOWHERE:
        where = DoublePlace.OVER
    if double is None or where is DoublePlace.NOWHERE:
        return [BoneFrame(snapshot.pose, _glow(snapshot))]
    parted = {
        limb: parting.strength * np.array(themed(_PARTED[parting.cue], over_picture(theme))[:3])
        for limb, parting in double.partings.items()
    }
    if where is DoublePlace.OVER:
        return [BoneFrame(snapshot.pose, _glow(snapshot), double.pose, parted)]
    demonstrator = replace(snapshot, strikes=())
    own = replace(snapshot, pose=double.pose)
    return [BoneFrame(demonstrator.pose, _glow(demonstrator)), BoneFrame(own.pose, _glow(own), double.pose, parted)]


def _of_two(snapshot: Snapshot, rival: OnStage) -> BoneFrame:
    """Both drummers; what each of them struck glows in the colour of who they are."""
    other = BoneFrame(rival.pose, _glow(rival), light=rival.light)
    return BoneFrame(snapshot.pose, _glow(snapshot), light=snapshot.light, rival=other, crowd_beat=snapshot.crowd_beat)


_PARTED = {TimingCue.EARLY: EARLY, TimingCue.LATE: LATE, TimingCue.MISSED: MISSED, TimingCue.WRONG_PIECE: WRONG}
"""The colour of a limb of the student's double that parts from the demonstrator's: its judgement's in the score."""


def _glow(snapshot: Snapshot | OnStage) -> dict[Piece, Colour]:
    """How brightly each piece glows, in linear light: the demonstrator's strokes warm, the student's blue."""
    warm, blue = np.square(BRAND[:3]), np.square(GOOD[:3])
    glow: dict[Piece, Colour] = {}
    for piece, light in _demonstrated(snapshot.kit, snapshot.pose):
        glow[piece] = glow.get(piece, np.zeros(3)) + _DEMONSTRATOR_GLOW * light * warm
    for piece, light in _struck(snapshot.kit, snapshot.strikes):
        glow[piece] = glow.get(piece, np.zeros(3)) + _STUDENT_GLOW * light * blue
    return glow


def _demonstrated(kit: Kit, pose: Pose | None) -> Iterable[tuple[Piece, float]]:
    if pose is not None:
        yield from zip(kit.pieces, pose.flash.tolist(), strict=True)


def _struck(kit: Kit, strikes: Iterable[SeenStrike]) -> Iterable[tuple[Piece, float]]:
    for strike in strikes:
        if strike.student and strike.age_s >= 0:
            yield (
                kit.stand_in(strike.piece),
                float(np.exp(-strike.age_s / _GLOW_FADE_S)) * (0.35 + strike.velocity / 195),
            )
