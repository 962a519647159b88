"""OpenGL contexts and pictures without a window.

Everything is drawn with OpenGL 3.3 core, which every computer of the last twelve years has, in hardware or in software.
"""

import sys
from typing import Any

import moderngl
import numpy as np
from numpy.typing import NDArray

from station.core.errors import DeviceError

GL_VERSION = 330

_HELP = {
    "linux": "install libegl1, libgl1 and libgl1-mesa-dri (Debian, Ubuntu), or mesa-dri-drivers (Fedora)",
    "darwin": "OpenGL 3.3 comes with macOS; without a screen it needs a logged-in user",
    "win32": "install the graphics card's driver, or put Mesa's opengl32.dll beside python.exe",
}


def standalone_context() -> moderngl.Context:
    """A context that draws without any window; raises `DeviceError` that says what to install."""
    backends: tuple[dict[str, Any], ...] = ({"backend": "egl"}, {}) if sys.platform == "linux" else ({},)
    faults: list[str] = []
    for options in backends:
        try:
            return moderngl.create_context(standalone=True, require=GL_VERSION, **options)
        except Exception as fault:
            faults.append(str(fault))
    raise DeviceError(f"OpenGL 3.3 cannot be had ({'; '.join(faults)}): {_HELP.get(sys.platform, 'install a driver')}")


def give_back(ctx: moderngl.Context) -> None:
    """Release what was dropped and not yet released; moderngl's own `gc` stumbles over what was released by hand."""
    while ctx.objects:
        dropped = ctx.objects.popleft()
        if not isinstance(dropped, moderngl.InvalidObject):
            dropped.release()


class RenderTarget:
    """An off-screen picture of `size` (width, height) with depth, `samples` a pixel where the driver can."""

    def __init__(self, ctx: moderngl.Context, size: tuple[int, int], samples: int = 0) -> None:
        self.size = size
        samples = min(samples, ctx.max_samples)
        self._plain = ctx.framebuffer([ctx.texture(size, 4)], ctx.depth_renderbuffer(size))
        self._colours = ctx.framebuffer(self._plain.color_attachments)
        self.framebuffer = self._plain
        if samples > 1:
            self.framebuffer = ctx.framebuffer(
                [ctx.renderbuffer(size, 4, samples=samples)], ctx.depth_renderbuffer(size, samples=samples)
            )
        self._ctx = ctx

    def resolved(self) -> moderngl.Texture:
        """The picture as a texture with one sample a pixel, bottom row first."""
        if self.framebuffer is not self._plain:
            self._ctx.copy_framebuffer(self._plain, self.framebuffer)
        texture = self._plain.color_attachments[0]
        assert isinstance(texture, moderngl.Texture)
        return texture

    def show(self, screen: moderngl.Framebuffer) -> None:
        """Copy the picture to a framebuffer of the same size, its colours alone: screens have depths of many kinds."""
        self.resolved()
        self._ctx.copy_framebuffer(screen, self._colours)

    def read(self) -> NDArray[np.uint8]:
        """The picture, shape (height, width, 3), top row first, read only."""
        self.resolved()
        width, height = self.size
        rgba = np.frombuffer(self._plain.read(components=4, alignment=1), np.uint8).reshape(height, width, 4)
        return rgba[::-1, :, :3]  # a view: to pack the bytes takes as long as to draw half of them

    def release(self) -> None:
        """Give the memory back."""
        self._colours.release()
        for buffer in {id(b): b for b in (self.framebuffer, self._plain)}.values():
            for attachment in (*buffer.color_attachments, buffer.depth_attachment):
                attachment.release()
            buffer.release()
