"""Where the camera of a named view stands to show a kit and who plays it, whatever their size.

A wide view is a direction, and points that must be seen: of the pieces, and of the body with its sticks raised. The
camera goes back from them just so far that all lie within the picture. Titles have a band above it. How far follows in
closed form: that a point (x, y, z) in the camera's axes lies left of the picture's right edge, x − eₓ ≤ r t (e_z − z)
with t the tangent of half the angle of view, is linear in the place e of the eye, and so are the other edges. What fits
a picture of `NARROW` fits wider ones as it is, and narrower ones because they widen their angle.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from station.core.named_view import NamedView
from station.core.pieces import Piece
from station.motion.kinematics.figure import Figure, Joint, figure_of
from station.motion.kinematics.frame import STAND_M
from station.motion.kit.kit import Kit, load_kit
from station.motion.kit.piece import KitPiece
from station.render.camera import NARROW, Camera
from station.render.geometry.transforms import look_at
from station.render.place import Place
from station.render.snapshot import Snapshot

Points = NDArray[np.float64]
_DEG = np.pi / 180


@dataclass(frozen=True)
class Stage:
    """What is to be seen: a kit, who plays it, and how far they `stand` (0 sits … 1 stands)."""

    kit: Kit
    figure: Figure
    stand: float = 0.0

    def __hash__(self) -> int:
        return hash((self.kit.name, self.figure.stature_m, self.stand))


def stage_of(snapshot: Snapshot) -> Stage:
    """What a snapshot shows; whoever is half up or more stands, so that the camera does not move with them."""
    pose, seated = snapshot.pose, Stage(snapshot.kit, snapshot.figure)
    if pose is None or pose.joints_m[Joint.PELVIS][2] < _pelvis(seated)[2] + STAND_M[1] / 2:
        return seated
    return replace(seated, stand=1.0)


def named(view: NamedView, stage: Stage | None = None) -> Camera:
    """The camera of a named view of `stage`, on the other side for a kit that leads with the left hand.

    Without a stage it is that of the usual kit and a player of median stature.
    """
    return _of_stage(view, stage or _usual_stage())


@lru_cache(maxsize=16)
def _of_stage(view: NamedView, stage: Stage) -> Camera:
    if not stage.kit.left_handed:
        return _camera(view, stage)
    camera = _camera(_OTHER_HAND.get(view, view), replace(stage, kit=stage.kit.mirrored))
    x, y, z = camera.target
    return replace(camera, target=(-x, y, z), azimuth_rad=np.pi - camera.azimuth_rad)


_OTHER_HAND = {NamedView.LEFT_HAND: NamedView.RIGHT_HAND, NamedView.RIGHT_HAND: NamedView.LEFT_HAND}
"""A kit that leads with the left hand is the other one in a mirror: so are its hands."""


@lru_cache(maxsize=1)
def _usual_stage() -> Stage:
    return Stage(load_kit(), figure_of())


def _camera(view: NamedView, stage: Stage) -> Camera:
    if view in _WIDE:
        wide = _WIDE[view]
        points = _pieces(stage.kit, wide.is_whole), _body(stage)
        if view is not NamedView.FRONT:
            return _fitted(wide, *points)
        cameras = [_fitted(replace(wide, azimuth_rad=azimuth), *points) for azimuth in _FRONT_AZIMUTHS]
        return max(cameras, key=lambda camera: min(_clearance(camera, stage), _FREE))
    if view is NamedView.EYES:
        eye = _crown(stage) + np.array(_EYES_M)
        seen = {word: piece for word, piece in stage.kit.pieces.items() if _is_ahead(piece.centre - eye)}
        eye[2] = max(eye[2], _ABOVE_M + max(piece.centre[2] for piece in seen.values()))
        return _from_the_eyes(eye, _pieces(replace(stage.kit, pieces=seen), is_whole=False))
    close = _CLOSE[view]
    middle = _feet(stage.kit) if view is NamedView.FEET else _hands(stage)
    x, y, z = (middle + np.array(close.target)).tolist()
    return replace(close, target=(x, y, z))


# --- what there is to see ---------------------------------------------------------------------------------------------

_ROUND = np.linspace(0, 2 * np.pi, 16, endpoint=False)
_RAISED_M = ((0.34, 0.30, -0.02), (-0.34, 0.30, -0.02))
"""Tips of raised sticks from the crown: aside, forward, up (our choice: a full stroke on a crash)."""
_THICK_M = 0.16
"""Half of a trunk with its clothes, or of a head, from front to back (our choice)."""
_FLESH, _FORWARD_M, _HAIR_M = 0.051, 0.07, 0.04
"""The pelvis over the seat, of the stature; the head before the pelvis; the hair over the crown."""


def _pieces(kit: Kit, is_whole: bool) -> Points:
    """The rims of all pieces that are struck by hand, or of them all with their lower rims, (n, 3)."""
    pieces = [piece for piece in kit.pieces.values() if is_whole or piece.kind != "kick"]
    return np.concatenate([_rims(piece)[: None if is_whole else len(_ROUND)] for piece in pieces])


def _rims(piece: KitPiece) -> Points:
    right, away, normal = piece.axes
    rim = piece.centre + piece.radius_m * (np.cos(_ROUND)[:, None] * right + np.sin(_ROUND)[:, None] * away)
    return np.concatenate([rim, rim - piece.depth_m * normal])


def _body(stage: Stage) -> Points:
    """The player's back, elbows, head and raised sticks, (n, 3)."""
    figure = stage.figure
    pelvis = _pelvis(stage)
    neck, crown = pelvis + np.array([0, _FORWARD_M, figure.trunk_m]), _crown(stage)
    elbow = figure.shoulder_breadth_m / 2 + figure.upper_arm_m * 0.8
    arms = [neck + np.array([side * elbow, 0.05, -figure.upper_arm_m / 2]) for side in (-1, 1)]
    back = [pelvis + np.array([0, -_THICK_M, 0]), crown - np.array([0, _THICK_M, 0.10])]
    return np.array([*back, *arms, crown, *(crown + np.array(tip) for tip in _RAISED_M)])


def _pelvis(stage: Stage) -> Points:
    forward, up = (share * stage.stand for share in STAND_M)
    x, y, z = stage.kit.seat_m
    return np.array([x, y + forward, z + up + _FLESH * stage.figure.stature_m])


def _crown(stage: Stage) -> Points:
    figure = stage.figure
    up = figure.trunk_m + figure.neck_m + figure.head_m + _HAIR_M
    return np.asarray(_pelvis(stage) + np.array([0, _FORWARD_M, up]))


def _feet(kit: Kit) -> Points:
    """Between the pedals."""
    ends = [point for pedal in kit.pedals.values() for point in (pedal.heel_m, pedal.toe_m)]
    return np.asarray(np.mean(ends, axis=0))


def _hands(stage: Stage) -> Points:
    """The middle of the snare, a little higher for who stands: the wrists are."""
    return np.asarray(stage.kit.pieces[Piece.SNARE].centre + np.array([0, 0, 0.12 * stage.stand]))


# --- wide views -------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class _Wide:
    """A direction as `Camera` has it, and between which shares of the picture the pieces and the body lie (−1 … 1)."""

    azimuth_rad: float
    height_rad: float
    fov_rad: float
    pieces_top: float
    body_top: float
    is_whole: bool = False
    bottom: float = -0.95
    aside: float = 0.95


_WIDE = {
    NamedView.FRONT: _Wide(70 * _DEG, 16 * _DEG, 0.66, 0.95, 0.97, is_whole=True),
    NamedView.SHOULDER: _Wide(-56 * _DEG, 38 * _DEG, 0.78, 0.95, 0.97),
    NamedView.TOP: _Wide(-90 * _DEG, 88 * _DEG, 0.80, 0.95, 0.97),
}
_FRONT_AZIMUTHS = [angle * _DEG for angle in (70, 60, 80, 52, 90, 100)]
"""From where the front is seen: the first from which no piece is before the face, else where least of one is."""
_FREE = 1.5
"""A face is free so many radii from a piece's middle: the piece swings, the head moves (our choice)."""


def _clearance(camera: Camera, stage: Stage) -> float:
    """How many radii from a piece's middle the line from the eye to the player's face passes, of the nearest piece."""
    eye, least = np.array(camera.eye), np.inf
    for low_m in _FACE_LOW_M:
        way = _crown(stage) + np.array([0.0, _FACE_FORWARD_M, -low_m]) - eye
        for piece in stage.kit.pieces.values():
            across = way @ piece.axes[2]
            share = (piece.centre - eye) @ piece.axes[2] / across if across else 0.0
            if 0 < share < 1:
                least = min(least, float(np.linalg.norm(eye + share * way - piece.centre) / piece.radius_m))
    return least


def _fitted(view: _Wide, pieces: Points, body: Points, narrowest: float = NARROW) -> Camera:
    """The camera that sees all points from as near as can be, in pictures `narrowest` times as wide as high or more."""
    here = Camera((0.0, 0.0, 0.0), view.azimuth_rad, view.height_rad, 1.0, view.fov_rad)
    axes = look_at(here.eye, here.target)[:3, :3]
    up = np.tan(view.fov_rad / 2)
    x, _, z = axes @ np.concatenate([pieces, body]).T
    across = view.aside * narrowest * up
    right, left = np.max(x + across * z), np.max(-x + across * z)
    floors = np.max(-(axes[1] + view.bottom * up * axes[2]) @ np.concatenate([pieces, body]).T)
    tops = [
        (top * up, np.max((axes[1] + top * up * axes[2]) @ points.T))
        for top, points in ((view.pieces_top, pieces), (view.body_top, body))
    ]
    away = max((right + left) / (2 * across), *((roof + floors) / (t - view.bottom * up) for t, roof in tops))
    low, high = max(roof - t * away for t, roof in tops), -view.bottom * up * away - floors
    eye = np.array([(right - left) / 2, (low + high) / 2, away])
    distance = float(away - np.median(z))
    target = (eye - [0, 0, distance]) @ axes
    return Camera((*target.tolist(),), view.azimuth_rad, view.height_rad, distance, view.fov_rad)


def both(stages: Sequence[tuple[Stage, Place]]) -> Camera:
    """The camera before a stage of two that sees all of both; what is narrower than `_TWO_ASPECT` crops their sides."""
    pieces, bodies = (
        np.concatenate([points @ place.matrix[:3, :3].T + place.matrix[:3, 3] for points, place in of_each])
        for of_each in (
            [(_pieces(stage.kit, is_whole=True), place) for stage, place in stages],
            [(_body(stage), place) for stage, place in stages],
        )
    )
    return _fitted(_BOTH, pieces, bodies, _TWO_ASPECT)


def one_of_two(stage: Stage, place: Place) -> Camera:
    """The camera before one of two drummers, straight as the room is; the first from which no piece is before the face.

    Without one, where least of a piece is.
    """
    straight = 90 * _DEG - place.turn_rad
    aside = [straight + angle * _DEG for angle in (0, -9, 9, -18, 18)]
    cameras = [_fitted(replace(_WIDE[NamedView.FRONT], azimuth_rad=a), *_whole(stage)) for a in aside]
    return place.camera(max(cameras, key=lambda camera: min(_clearance(camera, stage), _FREE)))


def _whole(stage: Stage) -> tuple[Points, Points]:
    return _pieces(stage.kit, is_whole=True), _body(stage)


_TWO_ASPECT = 1.9
"""The narrowest picture of both: one of 1280x720 with its upper band."""
_BOTH = _Wide(90 * _DEG, 13 * _DEG, 0.62, 0.95, 0.97, is_whole=True)


_EYES_M = (0.0, 0.17, -0.15)
"""The eyes from the crown, and a little before them, so that no hair and no brow is in the way (our choice)."""
_OWN_HEAD_M = 0.14
"""What is nearer is the player's own head, which leans into the picture."""
_PITCHES = np.linspace(-70, -25, 31) * _DEG
_LEAST_RAD, _WIDEST_RAD = 0.9, 1.6
"""Angles of view between which a picture looks as eyes see (our choice)."""
_EYES_LOW, _EYES_HIGH = -1.1, 0.93
"""Between which shares of the picture the rims lie: those next to the player may be cropped."""
_ABOVE_M = 0.12
"""So high at least over the middle of the highest piece the camera is, that a small player's sees it (our choice)."""


_GAZE = np.array([0.0, np.cos(50 * _DEG), -np.sin(50 * _DEG)])
_ASIDE_RAD = 60 * _DEG
"""Where a player looks who sees the snare and the toms, and how far beside that eyes see without a turn of the head."""


def _is_ahead(way: Points) -> bool:
    """Whether one sees what lies that way from the eyes: not a drum at the hip nor a cymbal at the ear."""
    return bool(way @ _GAZE > np.cos(_ASIDE_RAD) * np.linalg.norm(way))


_FACE_FORWARD_M, _FACE_LOW_M = 0.10, (0.12, 0.22, 0.32)
"""Where a face may be, before and below the crown with its hair: upright, and bent over the drums."""


def _from_the_eyes(eye: Points, pieces: Points) -> Camera:
    """What the player sees of the pieces, looking so far down that the least angle shows them."""
    needed = []
    for pitch in _PITCHES:
        way = np.array([0.0, np.cos(pitch), np.sin(pitch)])
        x, y, z = look_at((0, 0, 0), way)[:3, :3] @ (pieces - eye).T
        up = y / np.maximum(-z, 0.05)
        across = np.abs(x) / np.maximum(-z, 0.05) / NARROW
        needed.append(max(up.max() / _EYES_HIGH, up.min() / _EYES_LOW, across.max()))
    best = int(np.argmin(needed))
    distance = float(np.linalg.norm(pieces.mean(axis=0) - eye))
    target = eye + distance * np.array([0.0, np.cos(_PITCHES[best]), np.sin(_PITCHES[best])])
    fov = float(np.clip(2 * np.arctan(needed[best]), _LEAST_RAD, _WIDEST_RAD))
    return Camera((*target.tolist(),), -90 * _DEG, float(-_PITCHES[best]), distance, fov, near_m=_OWN_HEAD_M)


# --- close views ------------------------------------------------------------------------------------------------------

_CLOSE = {
    NamedView.HANDS: Camera((0.04, -0.03, 0.12), 70 * _DEG, 44 * _DEG, 1.20, 0.62),
    NamedView.FEET: Camera((0.03, -0.02, 0.15), 222 * _DEG, 22 * _DEG, 1.50, 0.62),
    NamedView.LEFT_HAND: Camera((-0.05, -0.12, 0.08), 176 * _DEG, 46 * _DEG, 0.86, 0.60),
    NamedView.RIGHT_HAND: Camera((0.07, -0.03, 0.16), 38 * _DEG, 34 * _DEG, 0.86, 0.66),
}
"""Their targets count from the middle of the snare, those of the feet from the middle of the pedals."""
