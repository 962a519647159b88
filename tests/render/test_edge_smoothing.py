"""Edges of what moves, smoothed after drawing: a slanted edge gets steps between, and all else stays as it was."""

import moderngl
import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.named_view import NamedView
from station.motion.drummer import Drummer
from station.motion.kinematics.figure import figure_of
from station.motion.kit.kit import load_kit
from station.render.framing import named
from station.render.gpu.bone_palette import BoneFrame
from station.render.gpu.edge_smoothing import MOVING, TILE, EdgeSmoother, tiles_of
from station.render.gpu.gl import RenderTarget, standalone_context
from station.render.quality import QUALITIES
from station.render.scene import Scene
from tests.unit.render.scores import rock

pytestmark = pytest.mark.gl

SIZE = (64, 48)
_MARK = round(255 * MOVING)


def smoothed(mark: int, width: int = SIZE[0]) -> tuple[NDArray[np.uint8], NDArray[np.uint8]]:
    """A white wedge of that opacity on grey, as it was drawn and as its left side is smoothed, each (48, 64)."""
    picture = np.full((SIZE[1], SIZE[0], 4), (60, 60, 60, 255), np.uint8)
    x, y = np.meshgrid(np.arange(SIZE[0]), np.arange(SIZE[1]))
    picture[3 * y > x] = (250, 250, 250, mark)
    with standalone_context() as ctx:
        target = RenderTarget(ctx, SIZE)
        texture = target.framebuffer.color_attachments[0]
        assert isinstance(texture, moderngl.Texture)
        texture.write(picture.tobytes())
        area = (0, 0, width, SIZE[1])
        everywhere = tiles_of(np.array([[0.0, 0.0]]), np.array([100.0]), area)
        EdgeSmoother(ctx).smooth(target.framebuffer, everywhere, area)
        after = np.frombuffer(target.framebuffer.read(components=4), np.uint8).reshape(picture.shape)
    return picture[:, :, 0], after[:, :, 0]


def test_an_edge_gets_shades_between_and_the_flats_stay() -> None:
    before, after = smoothed(_MARK)
    between = (after > 70) & (after < 240)
    assert between.sum() > 40, "three of four pixels along a slope of one in three"
    x, y = np.meshgrid(np.arange(SIZE[0]), np.arange(SIZE[1]))
    assert np.array_equal(after[np.abs(3 * y - x) > 12], before[np.abs(3 * y - x) > 12])


def test_what_stands_still_is_left_alone() -> None:
    before, after = smoothed(255)
    assert np.array_equal(before, after)


def test_nothing_changes_beside_the_area() -> None:
    before, after = smoothed(_MARK, 32)
    assert np.array_equal(after[:, 32:], before[:, 32:])
    assert not np.array_equal(after[:, :32], before[:, :32])


def test_tiles_are_those_that_a_square_touches() -> None:
    nine = tiles_of(np.array([[2.5, 4.5]]) * TILE, np.array([0.6]) * TILE, (0, 0, 8 * TILE, 6 * TILE))
    assert (nine // TILE).tolist() == [[column, row] for row in (3, 4, 5) for column in (1, 2, 3)]
    assert not len(tiles_of(np.array([[400.0, 70.0]]), np.array([10.0]), (0, 0, 128, 96)))


@pytest.mark.parametrize("view", list(NamedView))
def test_all_that_moves_lies_in_its_tiles(view: NamedView) -> None:
    size = (1280, 504)
    drummer, camera = Drummer(rock(2), load_kit(), figure_of()), named(view)
    with standalone_context() as ctx:
        scene, target = Scene(ctx, drummer.kit, drummer.figure, QUALITIES[0]), RenderTarget(ctx, size)
        scene.set(BoneFrame(drummer.pose(1.3)))
        target.framebuffer.clear(alpha=1.0, depth=1.0)
        scene.draw_moving(target.framebuffer, camera, (0, 0, *size))
        opacity = np.frombuffer(target.framebuffer.read(components=4), np.uint8).reshape(size[1], size[0], 4)[:, :, 3]
        tiles = scene.moving_tiles(camera, (0, 0, *size))
    marked = opacity < 200
    assert marked.any()
    for x, y in tiles.tolist():
        marked[y : y + TILE, x : x + TILE] = False
    assert not marked.any()
