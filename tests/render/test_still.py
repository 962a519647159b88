"""Pictures in two layers, the still one kept: they show what a picture drawn whole shows, and follow every change."""

from dataclasses import dataclass

import moderngl
import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.named_view import NamedView
from station.core.pieces import Piece
from station.motion.drummer import Drummer
from station.motion.kinematics.figure import figure_of
from station.motion.kit.kit import load_kit
from station.render.framing import named
from station.render.gpu.bone_palette import BoneFrame
from station.render.gpu.cached_layer import CachedLayer
from station.render.gpu.gl import RenderTarget, standalone_context
from station.render.painter import Painter
from station.render.quality import QUALITIES
from station.render.scene import Scene
from station.scenes.pictures import picture_of
from tests.unit.render.scores import rock

pytestmark = pytest.mark.gl

SIZE = (320, 180)
WHOLE = (0, 0, *SIZE)
DRUMMER = Drummer(rock(2), load_kit(), figure_of())


def test_a_still_is_drawn_anew_when_its_key_or_its_size_changes_and_only_then() -> None:
    ctx = standalone_context()
    with ctx:
        still, drawn = CachedLayer(ctx), list[int]()

        def shade(into: moderngl.Framebuffer) -> None:
            drawn.append(len(drawn))
            into.clear(red=0.2 * len(drawn))

        def red(key: str, target: RenderTarget) -> int:
            still.under(target.framebuffer, (key,), shade)
            return int(target.read()[0, 0, 0])

        one, other = RenderTarget(ctx, SIZE), RenderTarget(ctx, (64, 32))
        assert [red("a", one), red("a", one), red("b", one), red("b", other)] == [51, 51, 102, 153]
        assert drawn == [0, 1, 2]


@dataclass
class Both:
    """A scene, and where its pictures go: drawn whole and in layers."""

    ctx: moderngl.Context
    scene: Scene
    whole: RenderTarget
    layered: RenderTarget

    def apart(self) -> NDArray[np.int64]:
        """By how many of 255 steps the pixels of the two pictures differ."""
        return np.asarray(np.abs(self.whole.read().astype(np.int64) - self.layered.read()).max(axis=2))


@pytest.fixture(scope="module")
def both() -> Both:
    ctx = standalone_context()
    with ctx:
        scene = Scene(ctx, DRUMMER.kit, DRUMMER.figure, QUALITIES[0])
        return Both(ctx, scene, RenderTarget(ctx, SIZE), RenderTarget(ctx, SIZE))


@pytest.mark.parametrize("view", [NamedView.SHOULDER, NamedView.FRONT, NamedView.EYES])
@pytest.mark.parametrize("is_rough", [False, True])
def test_two_layers_show_what_one_picture_shows(both: Both, view: NamedView, is_rough: bool) -> None:
    """All but shadows and fine light agree: most pixels within a few steps of 255, hardly one far off."""
    scene, camera, layered = both.scene, named(view), both.layered.framebuffer
    with both.ctx:
        scene.set(BoneFrame(DRUMMER.pose(1.3), {Piece.SNARE: np.array([0.2, 0.1, 0.0])}))
        scene.draw(both.whole.framebuffer, camera, WHOLE)
        scene.draw_still(layered, camera, WHOLE, is_rough)
        scene.draw_moving(layered, camera, WHOLE)
        assert both.whole.read().max() > 200
        assert np.median(both.apart()) <= 2
        assert (both.apart() > 60).mean() < 0.06, "shadows on and of the arms are left out"
        scene.set(BoneFrame(None))
        scene.draw_still(layered, camera, WHOLE, is_rough)
        scene.draw_moving(layered, camera, WHOLE)
        assert (both.apart() > 60).mean() > 0.02, "the figure is gone"


def test_a_painter_goes_from_one_kit_to_another() -> None:
    ctx = standalone_context()
    with ctx:
        painter, target = Painter(ctx, QUALITIES[0]), RenderTarget(ctx, SIZE)
        pictures = []
        for drummer in (DRUMMER, Drummer(rock(2), load_kit().mirrored, figure_of())):
            for _ in range(2):  # the second is drawn over what the first kept
                painter.draw(picture_of(drummer, 0.5), target.framebuffer, WHOLE, named(NamedView.FRONT))
            pictures.append(target.read().astype(np.int64))
        assert np.abs(pictures[0] - pictures[1]).mean() > 1.0, "the kit is another"
