"""A body that walks, drawn into a panel by the window's own brush."""

from imgui_bundle import imgui

from station.core.pieces import Limb
from station.gui import theme
from station.gui.widgets import plots
from station.render.palette import PAPER
from station.render.phase.walker import draw_walker
from station.render.report.report_layout import ReportBox
from station.render.text.draw_list import Colour
from station.scenes.phase_view import WalkingScene


class PanelBrush:
    """Draws lines and ellipses into the present panel, in the theme's colours."""

    def __init__(self) -> None:
        self._brush = imgui.get_window_draw_list()

    def line(self, start: tuple[float, float], end: tuple[float, float], width: float, colour: Colour) -> None:
        """A straight line."""
        self._brush.add_line(imgui.ImVec2(*start), imgui.ImVec2(*end), _ink(colour), width)

    def ellipse(
        self,
        centre: tuple[float, float],
        half: tuple[float, float],
        colour: Colour,
        turn_rad: float = 0.0,
        style: tuple[float, float, float] = (0.0, 0.0, 0.0),
    ) -> None:
        """An ellipse; the second of `style` is the width of its line, 0 fills it."""
        middle, radii = imgui.ImVec2(*centre), imgui.ImVec2(*half)
        if style[1]:
            self._brush.add_ellipse(middle, radii, _ink(colour), turn_rad, 0, style[1])
        else:
            self._brush.add_ellipse_filled(middle, radii, _ink(colour), turn_rad)


def draw_body(scene: WalkingScene, at_s: float, size: tuple[float, float]) -> None:
    """Draw the body at a time into the next `size` pixels of the panel."""
    corner, brush = imgui.get_cursor_screen_pos(), imgui.get_window_draw_list()
    imgui.dummy(imgui.ImVec2(*size))
    far = imgui.ImVec2(corner.x + size[0], corner.y + size[1])
    brush.push_clip_rect(corner, far, True)
    brush.add_rect_filled(corner, far, _ink(PAPER), theme.points(6))
    box = ReportBox(corner.x, corner.y, *size)
    struck: dict[Limb, float] = scene.struck(at_s)
    draw_walker(PanelBrush(), scene.walker, scene.places_at(at_s), box, struck)
    brush.pop_clip_rect()


def _ink(colour: Colour) -> int:
    return imgui.color_convert_float4_to_u32(plots.vec(colour))
