"""Who plays: the button that says it, and the list that it or the kit brings up, large in the middle."""

from collections.abc import Callable

from imgui_bundle import icons_fontawesome_4 as icons
from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.settings_actions import AskWhoPlays, PlayAs
from station.app.sessions.who_plays import QUESTION, StudentLine, StudentsView
from station.app.settings.first_start import LONGEST_NAME
from station.gui import theme
from station.render import palette

WHO_LABEL = "###who"
NEW_NAME, ADD_STUDENT, STAY_LABEL = "##new-student", "Add##add-student", "###stay"
_WIDE, _LINE, _NAME_SIZE = 560, 58, 24.0
"""Design pixels of the list, of a line and its letters: read at two metres (our choice)."""
_ROUND_ABOUT, _BETWEEN = 190, 9
"""Design pixels above and below the lines, and between them, before they were drawn."""
_SHARE = 0.9
"""Of the window's height that the list takes at most."""


def who_button(students: StudentsView, width: float, dispatch: Callable[[Action], None]) -> None:
    """A button with the name of who plays, `width` pixels wide."""
    style = imgui.get_style()
    at = imgui.get_cursor_screen_pos()
    if imgui.button(WHO_LABEL, imgui.ImVec2(width, 0)):
        dispatch(AskWhoPlays(on=True))
    theme.tooltip(f"{students.now} plays: progress, levels and lesson book are theirs. Press, and another one plays")
    icon = f"{icons.ICON_FA_USER}  "
    name = theme.one_line(students.now, width - 2 * style.frame_padding.x - imgui.calc_text_size(icon).x)
    corner = imgui.ImVec2(at.x + style.frame_padding.x, at.y + style.frame_padding.y)
    imgui.get_window_draw_list().add_text(corner, imgui.get_color_u32(imgui.Col_.text), icon + name)


class WhoPlaysPage:
    """The list while it is open; `written` is the new name so far."""

    def __init__(self, dispatch: Callable[[Action], None]) -> None:
        self._dispatch = dispatch
        self._written = ""
        self._was_open = False
        self._high = 0.0  # pixels that it took in the last frame

    def gui(self, students: StudentsView) -> None:
        """Draw it over the window, if it is open, and do what the user does in it."""
        is_new, self._was_open = students.asks and not self._was_open, students.asks
        if not students.asks:
            self._written, self._high = "", 0.0
            return
        viewport = imgui.get_main_viewport()
        wide = min(theme.points(_WIDE), viewport.size.x)
        needed = self._high or theme.points(_ROUND_ABOUT + (_LINE + _BETWEEN) * len(students.lines))
        imgui.set_next_window_size(imgui.ImVec2(wide, min(needed, viewport.size.y * _SHARE)))
        imgui.set_next_window_pos(viewport.get_center(), imgui.Cond_.always, imgui.ImVec2(0.5, 0.5))
        flags = imgui.WindowFlags_.no_decoration | imgui.WindowFlags_.no_move | imgui.WindowFlags_.no_docking
        flags |= imgui.WindowFlags_.no_saved_settings
        flags &= ~imgui.WindowFlags_.no_scrollbar
        if is_new:
            imgui.set_next_window_focus()
        imgui.begin(QUESTION, None, flags)
        theme.heading(QUESTION, 30)
        theme.soft(_how(students))
        imgui.spacing()
        for number, line in enumerate(students.lines):
            self._line(number, line, line.name == students.now)
        self._new()
        words = theme.one_line(
            f"{students.now} plays on", imgui.get_content_region_avail().x - 2 * imgui.get_style().frame_padding.x
        )
        if imgui.button(f"{words}{STAY_LABEL}", imgui.ImVec2(-1, 0)):
            self._dispatch(AskWhoPlays(on=False))
        theme.tooltip(f"{students.now} goes on (Esc, or what brought the list up)")
        self._high = imgui.get_cursor_pos_y() + imgui.get_style().window_padding.y
        imgui.end()

    def _line(self, number: int, line: StudentLine, is_now: bool) -> None:
        """A student: the name, when they played, the pad that chooses them."""
        at, wide, high = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail().x, theme.points(_LINE)
        if is_now or line.is_meant:
            imgui.push_style_color(imgui.Col_.button, imgui.get_style_color_vec4(imgui.Col_.header))
        if imgui.button(f"###student-{number}", imgui.ImVec2(wide, high)):
            self._dispatch(PlayAs(line.name))
        if is_now or line.is_meant:
            imgui.pop_style_color()
        theme.tooltip(f"{line.name}: {line.played}")
        brush, pad, inset = imgui.get_window_draw_list(), theme.points(14), theme.points(6)
        ink, soft = imgui.get_color_u32(imgui.Col_.text), theme.packed(palette.INK_SOFT)
        imgui.push_font(None, _NAME_SIZE)
        words = imgui.calc_text_size(line.pad)
        right = at.x + wide - pad - words.x
        brush.add_text(imgui.ImVec2(right, at.y + (high - words.y) / 2), theme.packed(palette.BRAND), line.pad)
        name = theme.one_line(line.name, right - at.x - 2 * pad)
        brush.add_text(imgui.ImVec2(at.x + pad, at.y + inset), ink, name)
        below = at.y + inset + imgui.get_text_line_height()
        imgui.pop_font()
        brush.add_text(imgui.ImVec2(at.x + pad, below), soft, "plays now" if is_now else line.played)

    def _new(self) -> None:
        """A name that is not in the list yet."""
        style = imgui.get_style()
        beside = imgui.calc_text_size(ADD_STUDENT, True).x + 2 * style.frame_padding.x
        imgui.set_next_item_width(-(beside + style.item_spacing.x))
        entered, self._written = imgui.input_text_with_hint(
            NEW_NAME, "Somebody new: a name", self._written, imgui.InputTextFlags_.enter_returns_true
        )
        theme.tooltip(f"Up to {LONGEST_NAME} letters; progress is kept under it")
        imgui.same_line()
        imgui.begin_disabled(not self._written.strip())
        pressed = imgui.button(ADD_STUDENT)
        imgui.end_disabled()
        theme.tooltip("They play at once")
        if (entered or pressed) and self._written.strip():
            self._dispatch(PlayAs(self._written))


def _how(students: StudentsView) -> str:
    if not any(line.pad for line in students.lines):
        return "Choose with the mouse."
    if students.hears:
        return "Strike the pad beside a name once, or click."
    return "Be still for a second, then strike a pad, or click."
