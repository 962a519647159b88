"""A picture, with its depth, of what does not move: drawn once, then copied under every frame that moves over it."""

from collections.abc import Callable

import moderngl

from station.render.gpu.gl import RenderTarget


class CachedLayer:
    """Keeps one such picture."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self._ctx = ctx
        self._target: RenderTarget | None = None
        self._key: tuple[object, ...] = ()

    def under(
        self, target: moderngl.Framebuffer, key: tuple[object, ...], draw: Callable[[moderngl.Framebuffer], None]
    ) -> None:
        """Fill `target`, which is as deep as a `RenderTarget` of one sample a pixel, with what `draw` draws.

        `draw` is called only when `key`, all that its picture depends on, or the size has changed.
        """
        if self._target is None or self._target.size != target.size:
            self.release()
            self._target = RenderTarget(self._ctx, target.size)
        framebuffer = self._target.framebuffer
        if key != self._key:
            framebuffer.use()
            draw(framebuffer)
            self._key = key
        self._ctx.copy_framebuffer(target, framebuffer)

    def release(self) -> None:
        """Give the memory back."""
        if self._target is not None:
            self._target.release()
        self._target, self._key = None, ()
