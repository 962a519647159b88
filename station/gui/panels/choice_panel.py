"""A choice that stands large over the picture: what each option is, why, and the pad and the key that choose it.

Letters grow with the picture, so that a drummer reads them from the throne. A question stands in the middle; what comes
after a result stands below it, the best one first and in the brand's colour.
"""

from collections.abc import Callable
from dataclasses import dataclass

from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.practice_actions import Leave
from station.app.sessions.screen_choice import Option, ScreenChoice
from station.core.labels import piece_name
from station.core.pieces import CYMBALS, Piece
from station.gui import theme
from station.gui.keyboard_kit import SLOT_KEYS
from station.gui.widgets.large_letters import MOST_LINES, broken, cut, draw_text, fitted, grown, width_of
from station.gui.widgets.picture_box import Box, bare_window, on_screen
from station.render import palette
from station.render.painter import Area

CHOICE = "Choice"
SKIP_LABEL = "Not now (Esc)##skip"
_LARGE, _LEAST = 0.052, 19.0
"""A label's height as a share of the picture's: at two metres as large as a book's print at half a metre on a screen of
22 inches (our choice); and the least, in design pixels."""
_BAND = 0.27
"""The share of the picture's height that what comes next takes below a result (our choice)."""
_QUESTION_WIDE, _QUESTION_HIGH, _QUESTION_TOP = 0.92, 0.84, 0.13
"""The shares of the picture that a question takes, and that lie above it: it covers the marks in the score, which would
answer it (our choice)."""
_ASKED = 1.6
"""A question's letters against those of what comes next: nothing else is on the screen to be read (our choice)."""
_HOW = 0.42
"""The letters of the line that says how one chooses, in heights of a label (our choice)."""
_PAD, _ANSWERED = 0.62, 0.30
"""A pad's drawn radius in heights of its name; the opacity of an option whose pad was just struck."""


def label_of(place: int) -> str:
    """What imgui calls the option at `place`, from 0."""
    return f"##choice{place}"


def band_height(choice: ScreenChoice | None, picture: Area) -> int:
    """The pixels below `picture` that belong to what comes next; none where nothing does."""
    if choice is None or choice.question:
        return 0
    least = round(theme.points(128) * imgui.get_io().display_framebuffer_scale.y)
    return min(max(round(_BAND * picture[3]), least), picture[3] // 2)


def choice_keys(choice: ScreenChoice, dispatch: Callable[[Action], None]) -> bool:
    """Choose by 1 to 4, and what comes next by Enter where no control has the keyboard; returns whether a key did."""
    chosen = next((option for key, option in zip(SLOT_KEYS, choice.options, strict=False) if _pressed(key)), None)
    if chosen is None and not choice.question and not imgui.get_io().nav_visible and _pressed(imgui.Key.enter):
        chosen = choice.options[0]
    if chosen is not None:
        dispatch(chosen.action)
    return chosen is not None


def _pressed(key: imgui.Key) -> bool:
    io = imgui.get_io()
    is_chord = io.key_ctrl or io.key_alt or io.key_super or io.key_shift
    return bool(not is_chord and imgui.is_key_pressed(key, repeat=False))


def draw_choice(choice: ScreenChoice, picture: Area, dispatch: Callable[[Action], None]) -> None:
    """Draw it over `picture`, the window's free middle, and dispatch what is clicked."""
    area = on_screen(picture)
    box = _question_box(area) if choice.question else _band_box(area, band_height(choice, picture))
    large = max(_LARGE * area.height, theme.points(_LEAST))
    with bare_window(CHOICE, box, is_square=not choice.question):
        _draw(choice, large * _ASKED if choice.question else large, dispatch)


def _question_box(area: Box) -> Box:
    width, height = _QUESTION_WIDE * area.width, max(_QUESTION_HIGH * area.height, theme.points(190))
    height = min(height, area.height)
    return Box(
        area.left + (area.width - width) / 2,
        area.top + min(_QUESTION_TOP, 1.0 - height / area.height) * area.height,
        width,
        height,
    )


def _band_box(area: Box, pixels: int) -> Box:
    height = pixels / imgui.get_io().display_framebuffer_scale.y
    return Box(area.left, area.top + area.height - height, area.width, height)


def _draw(choice: ScreenChoice, large: float, dispatch: Callable[[Action], None]) -> None:
    """The question, the options side by side, and a line that says how they are chosen."""
    if choice.question:
        imgui.push_font(None, large / grown())
        width = imgui.get_content_region_avail().x
        imgui.set_cursor_pos_x(imgui.get_cursor_pos_x() + max(width - imgui.calc_text_size(choice.question).x, 0.0) / 2)
        imgui.text_wrapped(choice.question)
        imgui.pop_font()
    room, gap = imgui.get_content_region_avail(), imgui.get_style().item_spacing.x
    how = max(1.3 * _HOW * large, imgui.get_frame_height() if choice.question else imgui.get_text_line_height())
    line = how + imgui.get_style().item_spacing.y
    shares = [1.0] * len(choice.options)
    if not choice.question and len(shares) > 1:
        shares[0] = 1.35  # the best one is the widest (our choice)
    left = room.x - gap * (len(shares) - 1)
    for place, option in enumerate(choice.options):
        if place:
            imgui.same_line(0, gap)
        size = imgui.ImVec2(left * shares[place] / sum(shares), max(room.y - line, theme.points(60)))
        if imgui.invisible_button(label_of(place), size):
            dispatch(option.action)
        low, high = imgui.get_item_rect_min(), imgui.get_item_rect_max()
        look = _look(choice, place, imgui.is_item_hovered())
        theme.tooltip(_tip(option, place))
        _draw_option(option, place, Box(low.x, low.y, high.x - low.x, high.y - low.y), look, large)
    _how(choice, large, dispatch)


@dataclass(frozen=True, slots=True)
class _Look:
    """How an option is drawn: its `ground`, `edge` (0 for none) and letters, `quiet` ones too."""

    ground: int
    edge: int
    ink: int
    quiet: int
    hears: bool


def _look(choice: ScreenChoice, place: int, is_hovered: bool) -> _Look:
    is_best = place == 0 and not choice.question
    is_meant = choice.meant == place
    edge = theme.packed(palette.BRAND if not is_best else palette.INK) if is_meant else 0
    if is_best:
        ground = palette.mixed(palette.BRAND, palette.INK, 0.25) if is_hovered or is_meant else palette.BRAND
        ink = theme.packed(palette.NIGHT)
        return _Look(theme.packed(ground), edge, ink, ink, choice.hears)
    opacity = _ANSWERED if is_meant else 0.16 if is_hovered else 0.09
    ground = palette.with_opacity(palette.BRAND if is_meant else palette.INK, opacity)
    return _Look(theme.packed(ground), edge, theme.packed(palette.INK), theme.packed(palette.INK_SOFT), choice.hears)


def _draw_option(option: Option, place: int, box: Box, look: _Look, large: float) -> None:
    brush, rounding = imgui.get_window_draw_list(), theme.points(10)
    low, high = imgui.ImVec2(box.left, box.top), imgui.ImVec2(box.left + box.width, box.top + box.height)
    brush.add_rect_filled(low, high, look.ground, rounding)
    if look.edge:
        brush.add_rect(low, high, look.edge, rounding, thickness=theme.points(4))
    inner = theme.points(12)
    left, width = box.left + inner, box.width - 2 * inner
    small = max(0.55 * large, theme.points(15))
    pad_top = box.top + box.height - inner - small
    _draw_pad(option, place, imgui.ImVec2(left, pad_top), width, small, look)
    lines, size = fitted(option.label, width, large, pad_top - box.top - 1.3 * inner)
    top = box.top + 0.8 * inner
    for text in lines:
        draw_text(text, imgui.ImVec2(left, top), size, look.ink)
        top += 1.12 * size
    room = int((pad_top - 0.4 * inner - top) / (1.15 * small))
    for text in broken(option.why, width, small)[: min(room, MOST_LINES)] if option.why and room > 0 else ():
        draw_text(text, imgui.ImVec2(left, top + 0.1 * small), small, look.quiet)
        top += 1.15 * small


def _draw_pad(option: Option, place: int, at: imgui.ImVec2, width: float, size: float, look: _Look) -> None:
    """The key's number, and the pads, each drawn as a drum or a cymbal; faint until they are heard."""
    brush = imgui.get_window_draw_list()
    ink = look.ink if look.hears else look.quiet
    number = f"{place + 1}"
    key_wide = 1.15 * size
    brush.add_rect(at, imgui.ImVec2(at.x + key_wide, at.y + 1.1 * size), look.quiet, 0.2 * size)
    draw_text(number, imgui.ImVec2(at.x + (key_wide - width_of(number, size)) / 2, at.y), size, look.quiet)
    if not option.pads:
        return
    x, radius = at.x + key_wide + size, _PAD * size
    middle = imgui.ImVec2(x + radius * 0.6, at.y + 0.55 * size)
    piece = min(option.pads)
    if piece in CYMBALS or piece is Piece.HIHAT:
        brush.add_ellipse_filled(middle, imgui.ImVec2(radius, 0.4 * radius), ink)
    else:
        draw = brush.add_circle_filled if look.hears else brush.add_circle
        draw(middle, radius * 0.8, ink)
    x += 2.4 * radius
    names = " or ".join(piece_name(each) for each in sorted(option.pads))
    left = at.x + width - x
    draw_text(cut(names, left, size), imgui.ImVec2(x, at.y), size, ink)


def _how(choice: ScreenChoice, large: float, dispatch: Callable[[Action], None]) -> None:
    """The line below the options."""
    has_pads = any(option.pads for option in choice.options)
    still = "a second" if choice.question else "two seconds"
    wait = "Strike the pad, once" if choice.hears else f"Be still for {still}, then strike the pad"
    parts = [wait] if has_pads else []
    if choice.question:
        parts.append(f"or press 1 to {len(choice.options)}")
    else:
        parts.append("Enter or two kicks: the first" if choice.kicks else "Enter: the first")
    text = ", ".join(parts) if choice.question else " · ".join(parts)
    skip = imgui.calc_text_size(SKIP_LABEL, True).x + 2 * imgui.get_style().frame_padding.x
    room = imgui.get_content_region_avail().x
    imgui.push_font(None, max(_HOW * large / grown(), theme.FONT_SIZE))
    imgui.text_disabled(theme.one_line(text, room - skip - theme.points(20) if choice.question else room))
    imgui.pop_font()
    if choice.question:
        imgui.same_line(imgui.get_cursor_pos_x() + room - skip)
        if imgui.button(SKIP_LABEL):
            dispatch(Leave())
        theme.tooltip("The result without an answer; Panels, Practice has a tick for the question")


def _tip(option: Option, place: int) -> str:
    pads = " or ".join(piece_name(piece) for piece in sorted(option.pads))
    return f"{option.label}: key {place + 1}{f', or the {pads}' if pads else ''}. {option.why}".strip()
