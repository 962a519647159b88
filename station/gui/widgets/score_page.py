"""An engraved page inside a panel: the part of it that the panel shows, drawn on a canvas."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from imgui_bundle import imgui
from numpy.typing import NDArray

from station.gui import theme
from station.gui.flat_canvas import FlatCanvas, Leaf
from station.render.gpu.shape_renderer import Transform
from station.render.notation.page.editable_page import EditablePage
from station.render.text.atlas import Atlas
from station.render.text.glyph_swap import on_atlas


@dataclass(frozen=True, slots=True)
class PagePlace:
    """Where on the screen a page begins, and how many pixels a staff space has."""

    corner: tuple[float, float]
    space: float


@dataclass(frozen=True, slots=True)
class OverPage:
    """What is drawn over a page, in staff spaces; `key` tells it from other things."""

    key: tuple[object, ...]
    shapes: Callable[[Atlas], NDArray[np.void]]


def paint_page(canvas: FlatCanvas, page: EditablePage, place: PagePlace, over: OverPage | None = None) -> None:
    """Fill the panel (or child) that is being drawn with the part of the page that lies in it."""
    scale = imgui.get_io().display_framebuffer_scale
    low, room = imgui.get_window_pos(), imgui.get_window_size()
    size = max(round(room.x * scale.x), 1), max(round(room.y * scale.y), 1)
    origin = (place.corner[0] - low.x) * scale.x, (place.corner[1] - low.y) * scale.y
    leaf = Leaf((page, over and over.key), Transform(size, origin, place.space * scale.x), theme.chosen())

    def shapes(atlas: Atlas) -> NDArray[np.void]:
        below = on_atlas(page.shapes, page.atlas, atlas)
        return below if over is None else np.concatenate([below, over.shapes(atlas)])

    texture = canvas.draw(leaf, shapes)
    corner = imgui.ImVec2(low.x + room.x, low.y + room.y)
    imgui.get_window_draw_list().add_image(texture, low, corner, imgui.ImVec2(0, 1), imgui.ImVec2(1, 0))
