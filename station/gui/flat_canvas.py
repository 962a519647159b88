"""Flat shapes inside a panel: drawn by the pictures' own printer into a texture, anew only where something changed."""

from collections.abc import Callable
from dataclasses import dataclass

import moderngl
import numpy as np
from imgui_bundle import imgui
from numpy.typing import NDArray

from station.render.gpu.gl import RenderTarget
from station.render.gpu.shape_renderer import Transform
from station.render.painter import Painter
from station.render.palette import PAPER, Theme, themed
from station.render.text.atlas import Atlas


@dataclass(frozen=True, slots=True)
class Leaf:
    """What is drawn: `size` in pixels, where the shapes' units go, in which colours; `key` tells other shapes."""

    key: tuple[object, ...]
    sheet: Transform
    theme: Theme


class FlatCanvas:
    """One texture; `ready` gives the window's context and painter."""

    def __init__(self, ready: Callable[[], tuple[moderngl.Context, Painter]]) -> None:
        self._ready = ready
        self._target: RenderTarget | None = None
        self._drawn: Leaf | None = None

    def draw(self, leaf: Leaf, shapes: Callable[[Atlas], NDArray[np.void]]) -> imgui.ImTextureRef:
        """The texture with the shapes, top row last; they are asked for only where `leaf` is another than before."""
        ctx, painter = self._ready()
        target = self._target_of(ctx, leaf.sheet.size)
        if leaf != self._drawn:
            self._drawn = leaf
            table = shapes(painter.atlas)
            screen, viewport = ctx.detect_framebuffer(), ctx.viewport
            target.framebuffer.use()
            target.framebuffer.clear(*themed(PAPER, leaf.theme))
            before, painter.printer.theme = painter.printer.theme, leaf.theme
            painter.printer.draw(table, leaf.sheet)
            painter.printer.theme = before
            screen.use()
            ctx.viewport = viewport
        return imgui.ImTextureRef(target.resolved().glo)

    def _target_of(self, ctx: moderngl.Context, size: tuple[int, int]) -> RenderTarget:
        if self._target is None or self._target.size != size:
            self.release()
            self._target = RenderTarget(ctx, size)
        return self._target

    def release(self) -> None:
        """Give the memory back."""
        if self._target is not None:
            self._target.release()
        self._target = self._drawn = None
