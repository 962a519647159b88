"""The look of the panels: the same night, ink and orange as the pictures, in the same typeface."""

from imgui_bundle import hello_imgui, imgui

from station.render import palette
from station.render.fonts import Face, font_path
from station.render.ink import Colour

FONT_SIZE = 17.0
LARGE_FONT_SIZE = 26.0
_ROUND, _LESS_ROUND = 10.0, 7.0


def load_fonts() -> None:
    """Make Roboto the panels' font; hello_imgui calls this once, when fonts may be loaded."""
    imgui.get_io().fonts.add_font_from_file_ttf(str(font_path(Face.REGULAR)), FONT_SIZE)


def _vec(colour: Colour) -> imgui.ImVec4:
    return imgui.ImVec4(*colour)


def apply() -> None:
    """Set colours and roundings; hello_imgui calls this once, when the style may be set."""
    style = imgui.get_style()
    style.window_rounding = style.child_rounding = style.popup_rounding = _ROUND
    style.frame_rounding = style.grab_rounding = style.tab_rounding = style.scrollbar_rounding = _LESS_ROUND
    style.window_padding = imgui.ImVec2(16, 14)
    style.frame_padding = imgui.ImVec2(12, 7)
    style.item_spacing = imgui.ImVec2(10, 9)
    style.window_border_size = 0.0
    style.scrollbar_size = 12.0
    brand, ink = palette.BRAND, palette.INK
    panel = (0.058, 0.066, 0.090, 0.97)
    colours: dict[imgui.Col_, Colour] = {
        imgui.Col_.text: ink,
        imgui.Col_.text_disabled: palette.INK_SOFT,
        imgui.Col_.window_bg: panel,
        imgui.Col_.child_bg: (0.0, 0.0, 0.0, 0.0),
        imgui.Col_.popup_bg: panel,
        imgui.Col_.border: palette.PANEL_EDGE,
        imgui.Col_.frame_bg: (1.0, 1.0, 1.0, 0.06),
        imgui.Col_.frame_bg_hovered: (1.0, 1.0, 1.0, 0.11),
        imgui.Col_.frame_bg_active: (1.0, 1.0, 1.0, 0.15),
        imgui.Col_.title_bg: panel,
        imgui.Col_.title_bg_active: panel,
        imgui.Col_.check_mark: brand,
        imgui.Col_.slider_grab: brand,
        imgui.Col_.slider_grab_active: palette.mixed(brand, ink, 0.4),
        imgui.Col_.button: (1.0, 1.0, 1.0, 0.08),
        imgui.Col_.button_hovered: (1.0, 1.0, 1.0, 0.15),
        imgui.Col_.button_active: (1.0, 1.0, 1.0, 0.22),
        imgui.Col_.header: palette.with_opacity(brand, 0.22),
        imgui.Col_.header_hovered: palette.with_opacity(brand, 0.30),
        imgui.Col_.header_active: palette.with_opacity(brand, 0.38),
        imgui.Col_.separator: palette.PANEL_EDGE,
        imgui.Col_.plot_histogram: brand,
        imgui.Col_.nav_cursor: brand,
    }
    for slot, colour in colours.items():
        style.set_color_(slot, _vec(colour))


def main_button(label: str, size: tuple[float, float], enabled: bool = True) -> bool:
    """The one button of a page that matters; returns whether it was pressed."""
    brand, night = palette.BRAND, palette.NIGHT
    lit = palette.mixed(brand, palette.INK, 0.25)
    slots = (imgui.Col_.button, imgui.Col_.button_hovered, imgui.Col_.button_active, imgui.Col_.text)
    for slot, colour in zip(slots, (brand, lit, lit, night), strict=True):
        imgui.push_style_color(slot, _vec(colour))
    imgui.begin_disabled(not enabled)
    pressed = imgui.button(label, imgui.ImVec2(*size))
    imgui.end_disabled()
    imgui.pop_style_color(len(slots))
    return bool(pressed)


def heading(text: str, size: float = LARGE_FONT_SIZE) -> None:
    """A line of large text."""
    imgui.push_font(None, size)
    imgui.text_wrapped(text)
    imgui.pop_font()


def soft(text: str) -> None:
    """A line of quiet text, broken where the panel ends."""
    imgui.push_style_color(imgui.Col_.text, _vec(palette.INK_SOFT))
    imgui.text_wrapped(text)
    imgui.pop_style_color()


def tooltip(text: str) -> None:
    """Explain the control that was drawn last."""
    if imgui.is_item_hovered(imgui.HoveredFlags_.delay_normal):
        imgui.set_tooltip(text)


def points(pixels: float) -> float:
    """Design pixels in the window's own, which grow with the screen's density."""
    return pixels * float(hello_imgui.dpi_window_size_factor())
