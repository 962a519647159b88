"""Pictures of flat shapes alone, without a scene: as pixels, or one after the other as planes for a film."""

from collections.abc import Iterable, Iterator
from contextlib import contextmanager

import moderngl
import numpy as np
from numpy.typing import NDArray

from station.render.gpu.gl import RenderTarget, standalone_context
from station.render.gpu.nv12 import Nv12Reader, Planes
from station.render.gpu.shape_renderer import ShapeRenderer, Transform
from station.render.palette import NIGHT
from station.render.text.atlas import Atlas


@contextmanager
def flat_pictures(size: tuple[int, int], unit: float = 1.0) -> "Iterator[FlatPictures]":
    """What draws shapes of `unit` pixels a unit on pictures of `size`; raises `DeviceError` without OpenGL."""
    ctx = standalone_context()
    try:
        with ctx:
            yield FlatPictures(ctx, size, unit)
    finally:
        ctx.release()


class FlatPictures:
    """Draws tables of shapes on an empty sheet; its `atlas` is that of their letters."""

    def __init__(self, ctx: moderngl.Context, size: tuple[int, int], unit: float) -> None:
        self.atlas = Atlas()
        self._ctx, self._sheet = ctx, Transform(size, unit=unit)
        self._target, self._printer = RenderTarget(ctx, size), ShapeRenderer(ctx, self.atlas)

    def picture(self, shapes: NDArray[np.void]) -> NDArray[np.uint8]:
        """The picture, shape (height, width, 3), top row first."""
        self._draw(shapes)
        return self._target.read()

    def film(self, pictures: Iterable[NDArray[np.void]]) -> Iterator[Planes]:
        """The pictures as planes for video, in order; the size must be even."""
        reader = Nv12Reader(self._ctx, self._target.resolved())
        for shapes in pictures:
            ready = reader.read() if reader.is_full else None
            self._draw(shapes)
            self._target.resolved()
            reader.put()
            if ready is not None:
                yield ready
        while (last := reader.read()) is not None:
            yield last
        reader.release()

    def _draw(self, shapes: NDArray[np.void]) -> None:
        self._target.framebuffer.use()
        self._target.framebuffer.clear(*NIGHT)
        self._printer.draw(shapes, self._sheet)
