"""The look of the panels: the same night, ink and orange as the pictures, in the same typeface.

A theme dyes them as it dyes the pictures (`render.palette`); sizes are design pixels, grown by the screen's density and
by the factor that the window's size and the user ask for (`panel_size`).
"""

from bisect import bisect_left
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from imgui_bundle import hello_imgui, imgui, implot

from station.gui.tooltip_place import tooltip_place
from station.render import palette
from station.render.palette import Theme
from station.render.text.draw_list import Colour
from station.render.text.fonts import Face, font_path

FONT_SIZE = 17.0
LARGE_FONT_SIZE = 26.0
_ICONS, _ICON_SIZE = "fonts/fontawesome-webfont.ttf", 15.0
"""The signs' file among imgui-bundle's, and their size beside letters."""
_TOOLTIP_WIDTH, _TOOLTIP_GAP, _TOOLTIP_FAR = 420.0, 6.0, 330.0
"""Design pixels; our choice: some sixty letters, a good line to read; a finger's breadth from what it explains; and how
far a panel's edge may be for it to stand outside, the width of the lessons' list."""
_ROUND, _LESS_ROUND = 10.0, 7.0
_WHOLE_TAB = 170.0
"""Design pixels of the longest tab with its cross: tabs that have no room are scrolled, not shortened."""
_NARROW = 300.0
"""Design pixels: a slider beside a label and two buttons would have less than a hundred (our choice)."""
_PANEL = palette.PAPER
_GRAB, _GRAB_ACTIVE = 0.55, 0.7
"""Opacity of a slider's grab, where it has one."""
_MARK_HIGH = 4.0
"""Design pixels of the line that shows a slider's place under its words (our choice: seen from two metres)."""


def load_fonts() -> None:
    """Make Roboto, and the signs of Font Awesome, the panels' font; hello_imgui calls this once, when it may be loaded.

    Both come with imgui-bundle; Font Awesome Free is under the SIL Open Font License.
    """
    imgui.get_io().fonts.add_font_from_file_ttf(str(font_path(Face.REGULAR)), FONT_SIZE)
    hello_imgui.load_font(_ICONS, _ICON_SIZE, hello_imgui.FontLoadingParams(merge_to_last_font=True))


class _Current:
    """What the panels wear now; one for the process, as imgui's own style is."""

    theme = Theme.NIGHT
    scale = 1.0
    times_docked = 0


def choose(theme: Theme, scale: float) -> None:
    """What `apply` shall show: the colours of `theme`, panels `scale` times as large as designed."""
    _Current.theme, _Current.scale = theme, scale


def docked_anew() -> None:
    """The panels get their first places again: what has fitted itself into one does so once more."""
    _Current.times_docked += 1


def times_docked() -> int:
    """How often the panels got their first places again."""
    return _Current.times_docked


def chosen() -> Theme:
    """The colours that are shown."""
    return _Current.theme


def themed(colour: Colour) -> Colour:
    """What the present theme shows for a colour of the night."""
    return palette.themed(colour, _Current.theme)


def _vec(colour: Colour) -> imgui.ImVec4:
    return imgui.ImVec4(*colour)


def packed(colour: Colour) -> int:
    """What the present theme shows for a colour of the night, as draw lists take it."""
    return int(imgui.color_convert_float4_to_u32(_vec(themed(colour))))


def apply() -> None:
    """Set colours, roundings and sizes as chosen; hello_imgui calls this when the style may first be set."""
    style = imgui.get_style()
    style.font_scale_main = _Current.scale
    style.window_rounding = style.child_rounding = style.popup_rounding = points(_ROUND)
    style.frame_rounding = style.grab_rounding = style.tab_rounding = style.scrollbar_rounding = points(_LESS_ROUND)
    style.window_padding = imgui.ImVec2(points(16), points(14))
    style.frame_padding = imgui.ImVec2(points(12), points(7))
    style.item_spacing = imgui.ImVec2(points(10), points(9))
    style.item_inner_spacing = imgui.ImVec2(points(6), points(5))
    style.window_border_size = 0.0
    style.scrollbar_size = points(12)
    style.grab_min_size = points(12)
    style.tab_min_width_shrink = points(_WHOLE_TAB)
    for slot, colour in _colours().items():
        style.set_color_(slot, _vec(colour))
    _apply_to_plots()


def _apply_to_plots() -> None:
    """The same for ImPlot. Named lines are all minor ones to it, the panel is behind its plots."""
    style, ink = implot.get_style(), themed(palette.INK)
    style.plot_padding = imgui.ImVec2(points(4), points(2))
    style.plot_min_size = imgui.ImVec2(points(10), points(10))
    style.legend_spacing = imgui.ImVec2(points(14), 0)
    style.minor_alpha = 0.7
    for slot, opacity in (
        (implot.Col_.plot_bg, 0.04),
        (implot.Col_.plot_border, 0.0),
        (implot.Col_.legend_bg, 0.0),
        (implot.Col_.legend_border, 0.0),
        (implot.Col_.inlay_text, 0.66),
        (implot.Col_.axis_text, 0.66),
        (implot.Col_.axis_grid, 0.30),
    ):
        style.set_color_(slot, _vec(palette.with_opacity(ink, opacity)))


def _colours() -> dict[imgui.Col_, Colour]:
    """The colour of each part of a panel."""
    brand, ink, panel = themed(palette.BRAND), themed(palette.INK), themed(_PANEL)
    return {
        imgui.Col_.text: ink,
        imgui.Col_.text_disabled: themed(palette.INK_SOFT),
        imgui.Col_.window_bg: panel,
        imgui.Col_.child_bg: (0.0, 0.0, 0.0, 0.0),
        imgui.Col_.popup_bg: themed(_PANEL),
        imgui.Col_.border: themed(palette.PANEL_EDGE),
        imgui.Col_.frame_bg: palette.with_opacity(ink, 0.07),
        imgui.Col_.frame_bg_hovered: palette.with_opacity(ink, 0.12),
        imgui.Col_.frame_bg_active: palette.with_opacity(ink, 0.16),
        imgui.Col_.title_bg: panel,
        imgui.Col_.title_bg_active: panel,
        imgui.Col_.title_bg_collapsed: panel,
        imgui.Col_.tab: panel,
        imgui.Col_.tab_hovered: palette.with_opacity(brand, 0.30),
        imgui.Col_.tab_selected: palette.with_opacity(brand, 0.22),
        imgui.Col_.tab_dimmed: panel,
        imgui.Col_.tab_dimmed_selected: palette.with_opacity(ink, 0.10),
        imgui.Col_.scrollbar_bg: (0.0, 0.0, 0.0, 0.0),
        imgui.Col_.scrollbar_grab: palette.with_opacity(ink, 0.25),
        imgui.Col_.table_header_bg: palette.with_opacity(ink, 0.07),
        imgui.Col_.check_mark: brand,
        imgui.Col_.checkbox_selected_bg: palette.with_opacity(ink, 0.07),
        imgui.Col_.input_text_cursor: ink,
        imgui.Col_.text_selected_bg: palette.with_opacity(brand, 0.35),
        imgui.Col_.slider_grab: palette.with_opacity(brand, _GRAB),
        imgui.Col_.slider_grab_active: palette.with_opacity(brand, _GRAB_ACTIVE),
        imgui.Col_.button: palette.with_opacity(ink, 0.09),
        imgui.Col_.button_hovered: palette.with_opacity(ink, 0.16),
        imgui.Col_.button_active: palette.with_opacity(ink, 0.23),
        imgui.Col_.header: palette.with_opacity(brand, 0.22),
        imgui.Col_.header_hovered: palette.with_opacity(brand, 0.30),
        imgui.Col_.header_active: palette.with_opacity(brand, 0.38),
        imgui.Col_.separator: themed(palette.PANEL_EDGE),
        imgui.Col_.plot_histogram: brand,
        imgui.Col_.nav_cursor: brand,
        imgui.Col_.docking_empty_bg: themed(palette.NIGHT),
    }


def main_button(label: str, size: tuple[float, float], enabled: bool = True) -> bool:
    """The one button of a page that matters; returns whether it was pressed."""
    brand, night = themed(palette.BRAND), themed(palette.NIGHT)
    highlighted = palette.mixed(brand, themed(palette.INK), 0.25)
    slots = (imgui.Col_.button, imgui.Col_.button_hovered, imgui.Col_.button_active, imgui.Col_.text)
    for slot, colour in zip(slots, (brand, highlighted, highlighted, night), strict=True):
        imgui.push_style_color(slot, _vec(colour))
    imgui.begin_disabled(not enabled)
    pressed = imgui.button(label, imgui.ImVec2(*size))
    imgui.end_disabled()
    imgui.pop_style_color(len(slots))
    return bool(pressed)


def icon_button(label: str, size: tuple[float, float], highlighted: bool = False) -> bool:
    """A button that bears a sign of the icon font; returns whether it was pressed. `highlighted`: it is on."""
    is_on = _vec(palette.with_opacity(themed(palette.BRAND), 0.55))
    imgui.push_style_color(imgui.Col_.button, is_on if highlighted else imgui.get_style_color_vec4(imgui.Col_.button))
    imgui.push_style_var(imgui.StyleVar_.frame_padding, imgui.ImVec2(0.0, imgui.get_style().frame_padding.y))
    pressed = imgui.button(label, imgui.ImVec2(*size))
    imgui.pop_style_var()
    imgui.pop_style_color()
    return bool(pressed)


def heading(text: str, size: float = LARGE_FONT_SIZE) -> None:
    """A line of large text."""
    imgui.push_font(None, size)
    imgui.text_wrapped(text)
    imgui.pop_font()


def soft(text: str) -> None:
    """A line of quiet text, broken where the panel ends."""
    imgui.push_style_color(imgui.Col_.text, _vec(themed(palette.INK_SOFT)))
    imgui.text_wrapped(text)
    imgui.pop_style_color()


def warning(text: str) -> None:
    """A line that says what went wrong, broken where the panel ends."""
    imgui.push_style_color(imgui.Col_.text, _vec(themed(palette.BRAND)))
    imgui.text_wrapped(text)
    imgui.pop_style_color()


def part(title: str) -> None:
    """A line with a title, where a part of a panel begins; one that has no room for it is broken."""
    room = imgui.get_content_region_avail().x - 4 * imgui.get_style().item_spacing.x - points(20)
    if imgui.calc_text_size(title).x <= room:
        imgui.separator_text(title)
        return
    imgui.separator()
    imgui.text_wrapped(title)


def checkbox(label: str, value: bool) -> tuple[bool, bool]:
    """A box to tick; its words are broken where the panel ends, and tick it too. Returns whether it changed, and it."""
    inner, words = imgui.get_style().item_inner_spacing.x, label.partition("##")[0]
    if imgui.get_frame_height() + inner + imgui.calc_text_size(words).x <= imgui.get_content_region_avail().x:
        changed, value = imgui.checkbox(label, value)
        return bool(changed), bool(value)
    changed, value = imgui.checkbox(f"##{label}", value)
    imgui.same_line(0.0, inner)
    imgui.text_wrapped(words)
    if imgui.is_item_clicked():
        changed, value = True, not value
    return bool(changed), bool(value)


def radio_button(label: str, is_on: bool) -> bool:
    """One choice of several; its words are broken where the panel ends, and choose it too. Returns whether it was."""
    inner, words = imgui.get_style().item_inner_spacing.x, label.partition("##")[0]
    if imgui.get_frame_height() + inner + imgui.calc_text_size(words).x <= imgui.get_content_region_avail().x:
        return bool(imgui.radio_button(label, is_on))
    pressed = bool(imgui.radio_button(f"##{label}", is_on))
    imgui.same_line(0.0, inner)
    imgui.text_wrapped(words)
    return pressed or bool(imgui.is_item_clicked())


def first_lines(text: str, lines: int) -> str:
    """As much of `text` as so many lines of the panel's width hold, with dots where it goes on."""
    wrap = imgui.get_content_region_avail().x
    room = (lines + 0.5) * imgui.get_text_line_height()

    def fits(words: str) -> bool:
        return bool(imgui.calc_text_size(words, False, wrap).y <= room)

    if fits(text):
        return text
    words = text.split()
    longest = bisect_left(range(len(words)), True, key=lambda count: not fits(" ".join(words[: count + 1]) + " …"))
    return " ".join(words[:longest]) + " …"


def one_line(text: str, width: float) -> str:
    """As much of `text` as `width` pixels hold, with dots where it goes on."""

    def fits(words: str) -> bool:
        return bool(imgui.calc_text_size(words).x <= width)

    if fits(text):
        return text
    longest = bisect_left(range(len(text)), True, key=lambda count: not fits(f"{text[: count + 1].rstrip()} …"))
    return f"{text[:longest].rstrip()} …"


def tooltip(text: str) -> None:
    """Explain the control that was drawn last, while it is looked at; one that is typed or dragged in is understood."""
    hovered = imgui.HoveredFlags_.delay_normal | imgui.HoveredFlags_.allow_when_disabled
    if not imgui.is_item_hovered(hovered) or imgui.is_item_active():
        return
    low, high, screen = imgui.get_item_rect_min(), imgui.get_item_rect_max(), imgui.get_io().display_size
    padding = imgui.get_style().window_padding
    width = min(points(_TOOLTIP_WIDTH), screen.x - 2 * padding.x)
    words = imgui.calc_text_size(text, False, width)
    size = words.x + 2 * padding.x, words.y + 2 * padding.y
    panel = imgui.internal.get_current_window().root_window.rect()
    place = tooltip_place(
        (low.x, low.y, high.x, high.y),
        (panel.min.x, panel.min.y, panel.max.x, panel.max.y),
        size,
        (screen.x, screen.y),
        points(_TOOLTIP_GAP),
        points(_TOOLTIP_FAR),
    )
    imgui.set_next_window_pos(imgui.ImVec2(*place))
    if imgui.begin_tooltip():
        imgui.push_text_wrap_pos(padding.x + width)
        imgui.text(text)
        imgui.pop_text_wrap_pos()
        imgui.end_tooltip()


def slider_int(label: str, value: int, low: int, high: int, words: str = "%d") -> tuple[bool, int]:
    """A slider with words on it: a line under them shows its place, for a grab would lie over them."""
    with _no_grab(label, lambda: (value - low) / max(high - low, 1)):
        moved, value = imgui.slider_int(label, value, low, high, words)
    return bool(moved), int(value)


def slider_float(label: str, value: float, low: float, high: float, words: str = "%.1f") -> tuple[bool, float]:
    """As `slider_int`, of real numbers."""
    with _no_grab(label, lambda: (value - low) / (high - low)):
        moved, value = imgui.slider_float(label, value, low, high, words)
    return bool(moved), float(value)


@contextmanager
def _no_grab(label: str, place: Callable[[], float]) -> Iterator[None]:
    """Draw a slider without its grab, then the line up to `place`, 0 to 1, of its frame, left of its `label`."""
    for slot in (imgui.Col_.slider_grab, imgui.Col_.slider_grab_active):
        imgui.push_style_color(slot, imgui.ImVec4(0.0, 0.0, 0.0, 0.0))
    yield
    imgui.pop_style_color(2)
    low, high = imgui.get_item_rect_min(), imgui.get_item_rect_max()
    words = imgui.calc_text_size(label, True).x
    right = high.x - (words + imgui.get_style().item_inner_spacing.x if words else 0.0)
    bottom, thick = low.y + imgui.get_frame_height(), points(_MARK_HIGH)
    at = low.x + min(max(place(), 0.0), 1.0) * (right - low.x)
    line, brush = thick / 2, imgui.get_window_draw_list()
    brush.push_clip_rect(low, imgui.ImVec2(right, bottom), True)
    ink = imgui.color_convert_float4_to_u32(_vec(themed(palette.BRAND)))
    brush.add_rect_filled(imgui.ImVec2(low.x, bottom - thick), imgui.ImVec2(max(at, low.x + thick), bottom), ink, line)
    brush.pop_clip_rect()


def fit_height(height: float) -> None:
    """Make the docked panel that is being drawn as high as it needs to be."""
    node = imgui.internal.dock_builder_get_node(imgui.get_window_dock_id()) if imgui.is_window_docked() else None
    if node is not None and abs(node.size.y - height) > 1.0:
        imgui.internal.dock_builder_set_node_size(node.id_, imgui.ImVec2(node.size.x, height))


def points(pixels: float) -> float:
    """Design pixels in the window's own, which grow with the screen's density and with the panels (`panel_size`)."""
    return pixels * float(hello_imgui.dpi_window_size_factor()) * _Current.scale


def is_narrow() -> bool:
    """Whether the panel is too narrow for a label, a slider and buttons in one line."""
    return bool(imgui.get_content_region_avail().x < points(_NARROW))
