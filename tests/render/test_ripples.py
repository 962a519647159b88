"""A struck head ripples: a ring that runs outward, nothing at the instant of the stroke, nothing on other drums."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.named_view import NamedView
from station.core.pieces import Limb, Piece
from station.core.units import PPQ
from station.motion.drummer import Drummer
from station.motion.kinematics import frame
from station.motion.kinematics.figure import figure_of
from station.motion.kinematics.pose import Pose
from station.motion.kit.instruments import NUMBERS
from station.motion.kit.kit import load_kit
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.render.framing import named
from station.render.gpu.bone_palette import BoneFrame
from station.render.gpu.gl import RenderTarget, standalone_context
from station.render.quality import QUALITIES
from station.render.scene import Scene

pytestmark = pytest.mark.gl

SIZE = (480, 270)
DRUMMER = Drummer(
    Score.from_notes([Note(PPQ, Piece.TOM_1, velocity=127, limb=Limb.RIGHT_HAND)], TempoMap.constant(60.0)),
    load_kit(),
    figure_of(),
)


def flat(pose: Pose) -> Pose:
    """The pose with heads that stay flat."""
    row = pose.row.copy()
    row[frame.PLAYED :].reshape(-1, NUMBERS)[:, 3] = 0.0
    return replace(pose, row=row)


def rippled(scene: Scene, target: RenderTarget, after_s: float) -> NDArray[np.intp]:
    """The pixels that a ripple changes so long after the stroke, (n, 2) down and across."""
    pictures = []
    for pose in (DRUMMER.pose(1.0 + after_s), flat(DRUMMER.pose(1.0 + after_s))):
        scene.set(BoneFrame(pose))
        scene.draw(target.framebuffer, named(NamedView.TOP), (0, 0, *SIZE))
        pictures.append(target.read().astype(np.int64))
    return np.argwhere(np.abs(pictures[0] - pictures[1]).max(axis=2) > 3)


def test_a_ring_runs_outward_over_the_struck_head_alone() -> None:
    ctx = standalone_context()
    with ctx:
        target, scene = RenderTarget(ctx, SIZE, 4), Scene(ctx, DRUMMER.kit, DRUMMER.figure, QUALITIES[1])
        at_once, soon, later = (rippled(scene, target, s) for s in (0.0, 0.012, 0.07))
        assert not len(at_once), "the tip is on the head"
        assert len(soon) > 10
        assert np.ptp(later[:, 1]) > 1.2 * np.ptp(soon[:, 1]), "it runs outward"
        assert np.ptp(later[:, 1]) < 0.35 * SIZE[0], "and stays on its drum"
        assert not len(rippled(scene, target, 1.5)), "and ends"
