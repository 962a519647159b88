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
        self,
        target: moderngl.Framebuffer,
        key: tuple[object, ...],
        draw: Callable[[moderngl.Framebuffer], None],
        samples: int = 0,
    ) -> None:
        """Fill `target`, which is as deep as a `RenderTarget` of one sample a pixel, with what `draw` draws.

        `draw` is called only when `key`, all that its picture depends on, or the size has changed; it draws with so
        many `samples` a pixel.
        """
        self._ctx.copy_framebuffer(target, self._kept(target.size, key, draw, samples).framebuffer)

    def picture(
        self,
        size: tuple[int, int],
        key: tuple[object, ...],
        draw: Callable[[moderngl.Framebuffer], None],
        samples: int = 0,
    ) -> moderngl.Texture:
        """The same as a texture of `size`."""
        return self._kept(size, key, draw, samples).resolved()

    def _kept(
        self,
        size: tuple[int, int],
        key: tuple[object, ...],
        draw: Callable[[moderngl.Framebuffer], None],
        samples: int,
    ) -> RenderTarget:
        if self._target is None or self._target.size != size:
            self.release()
            self._target = RenderTarget(self._ctx, size)
        if key != self._key:
            self._draw(self._target.framebuffer, draw, samples)
            self._key = key
        return self._target

    def _draw(
        self, framebuffer: moderngl.Framebuffer, draw: Callable[[moderngl.Framebuffer], None], samples: int
    ) -> None:
        if not samples:
            framebuffer.use()
            draw(framebuffer)
            return
        fine = RenderTarget(self._ctx, framebuffer.size, samples)
        fine.framebuffer.use()
        draw(fine.framebuffer)
        self._ctx.copy_framebuffer(framebuffer, fine.framebuffer)
        fine.release()

    def release(self) -> None:
        """Give the memory back."""
        if self._target is not None:
            self._target.release()
        self._target, self._key = None, ()
