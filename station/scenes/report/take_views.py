"""The places to look from that a take in a browser offers."""

from dataclasses import replace

import numpy as np

from station.core.named_view import NamedView
from station.core.pieces import Piece
from station.motion.drummer import Drummer
from station.motion.export.joint_tree import TURN
from station.render.camera import NARROW, Camera
from station.render.framing import Stage, named
from station.render.report.take.shown_take import Point, ShownView

_ASIDE_RAD, _ASIDE_HEIGHT_RAD = np.radians(168.0), np.radians(14.0)
"""From the hi-hat's side, a little from ahead (our choice)."""


def shown_views(drummer: Drummer) -> tuple[ShownView, ...]:
    """The views of a drummer, the first where the picture begins."""
    stage = Stage(drummer.kit, drummer.figure, drummer.style.stand)
    front = named(NamedView.FRONT, stage)
    x, _, _ = drummer.kit.pieces[drummer.kit.stand_in(Piece.HIHAT)].centre_m
    aside = _ASIDE_RAD if x < 0 else np.pi - _ASIDE_RAD
    cameras = {
        "Front": front,
        "Over the shoulder": named(NamedView.SHOULDER, stage),
        "Hi-hat side": replace(front, azimuth_rad=aside, height_rad=_ASIDE_HEIGHT_RAD),
        "From above": named(NamedView.TOP, stage),
    }
    return tuple(_view(name, camera) for name, camera in cameras.items())


def _view(name: str, camera: Camera) -> ShownView:
    return ShownView(name, _turned(camera.eye), _turned(camera.target), float(np.degrees(camera.fov_rad)), NARROW)


def _turned(point: Point) -> Point:
    x, y, z = (TURN @ np.array(point)).tolist()
    return x, y, z
