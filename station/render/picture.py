"""Pictures without a window: a snapshot as pixels or as a PNG file."""

from pathlib import Path

import moderngl
import numpy as np
from numpy.typing import NDArray

from station.render.camera import Camera
from station.render.gl import Target, standalone_context
from station.render.painter import Painter
from station.render.png import write_png
from station.render.scene import QUALITIES, Quality
from station.render.snapshot import Snapshot


class PictureMaker:
    """Draws many snapshots of one size off screen; raises `DeviceError` where there is no OpenGL."""

    def __init__(
        self, size: tuple[int, int], quality: Quality = QUALITIES[1], ctx: moderngl.Context | None = None
    ) -> None:
        self.size = size
        self._ctx = ctx or standalone_context()
        with self._ctx:  # other makers may have contexts of their own
            self._target = Target(self._ctx, size, quality.samples)
            self._painter = Painter(self._ctx, quality)

    def draw(self, snapshot: Snapshot, camera: Camera | None = None, with_score: bool = True) -> NDArray[np.uint8]:
        """The picture, shape (height, width, 3), top row first."""
        with self._ctx:
            self._target.framebuffer.use()
            self._painter.draw(snapshot, self._target.framebuffer, (0, 0, *self.size), camera, with_score)
            return self._target.read()

    def release(self) -> None:
        """Give the driver its memory back."""
        with self._ctx:
            self._target.release()
        self._ctx.release()


def draw_png(snapshot: Snapshot, path: Path, size: tuple[int, int] = (1280, 720), camera: Camera | None = None) -> None:
    """Write the picture of `snapshot` to `path`; raises `DeviceError` without OpenGL or if the disk refuses."""
    maker = PictureMaker(size)
    try:
        write_png(maker.draw(snapshot, camera), path)
    finally:
        maker.release()


def renderer_name() -> str:
    """What draws on this computer, in the driver's words; raises `DeviceError` without OpenGL."""
    ctx = standalone_context()
    name = f"{ctx.info['GL_RENDERER']}, OpenGL {ctx.version_code / 100:.1f}"
    ctx.release()
    return name
