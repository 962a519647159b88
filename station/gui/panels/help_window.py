"""The window that F1 opens: what the open page is, the tools that are open, and what the keys play and do."""

from collections.abc import Sequence

from imgui_bundle import imgui

from station.app.help_topics import HELP, Topic
from station.gui import theme
from station.gui.keyboard_kit import COMMANDS, KEYS
from station.gui.panels.editor.editor_keys import EDITOR_HELP
from station.gui.panels.panel import Panel

_WIDE, _HIGH = 680, 500
"""Design pixels; what is longer scrolls."""
_SIDE_BY_SIDE = 560
"""Design pixels in which the keys of the kit and the others stand beside each other; in fewer below (our choice)."""
_NAME_SHARE, _CAP_SHARE = 0.27, 0.36
"""The first column's share: of parts of a page, and of keys."""

Rows = Sequence[tuple[str, str]]


class HelpWindow:
    """The window; it is put into the middle again whenever the station's window or the panels have another size."""

    def __init__(self) -> None:
        self._fitted = 0.0, 0.0, 0.0

    def gui(self, topic: Topic, tools: Sequence[Panel], frame_ms: float) -> bool:
        """Explain the page and the open `tools`, with the keys on a second leaf; returns whether it stays open."""
        self._fit()
        _, stays = imgui.begin("Help", True, imgui.WindowFlags_.no_collapse | imgui.WindowFlags_.no_docking)
        if imgui.begin_tab_bar("##leaves"):
            if imgui.begin_tab_item("This page")[0]:
                _page(topic, tools)
                imgui.end_tab_item()
            if imgui.begin_tab_item("Keys")[0]:
                _table("##keys", EDITOR_HELP, _CAP_SHARE) if topic is Topic.EDITOR else _keys(frame_ms)
                imgui.end_tab_item()
            imgui.end_tab_bar()
        imgui.end()
        return bool(stays)

    def _fit(self) -> None:
        screen = imgui.get_main_viewport()
        fitted = screen.size.x, screen.size.y, theme.points(1.0)
        when = imgui.Cond_.appearing if fitted == self._fitted else imgui.Cond_.always
        self._fitted = fitted
        size = imgui.ImVec2(min(theme.points(_WIDE), screen.size.x), min(theme.points(_HIGH), screen.size.y))
        imgui.set_next_window_size_constraints(imgui.ImVec2(1.0, 1.0), screen.size)
        imgui.set_next_window_size(size, when)
        imgui.set_next_window_pos(screen.get_center(), when, imgui.ImVec2(0.5, 0.5))


def _page(topic: Topic, tools: Sequence[Panel]) -> None:
    page = HELP[topic]
    theme.heading(topic.value, 22)
    imgui.text_wrapped(page.head)
    imgui.spacing()
    _table("##parts", page.parts, _NAME_SHARE)
    for tool in tools:
        imgui.separator()
        theme.heading(tool.name, 22)
        imgui.text_wrapped(tool.help or tool.about)


def _table(label: str, rows: Rows, share: float) -> None:
    """What something is called and what it does, a row each; both are broken where their column ends."""
    if not imgui.begin_table(label, 2, imgui.TableFlags_.sizing_stretch_prop):
        return
    imgui.table_setup_column("name", imgui.TableColumnFlags_.width_stretch, share)
    imgui.table_setup_column("about", imgui.TableColumnFlags_.width_stretch, 1.0 - share)
    for name, words in rows:
        imgui.table_next_row()
        imgui.table_next_column()
        imgui.text_wrapped(name)
        imgui.table_next_column()
        theme.soft(words)
    imgui.end_table()


def _keys(frame_ms: float) -> None:
    theme.soft(
        f"Without a kit, play on these keys. They are looked at once a frame, now every {frame_ms:.0f} ms,"
        " so their timing is that coarse: a kit is measured far better."
    )
    strokes = [(stroke.cap, stroke.words) for stroke in KEYS.values()]
    if imgui.get_content_region_avail().x < theme.points(_SIDE_BY_SIDE):
        _table("##commands", COMMANDS, _CAP_SHARE)
        imgui.separator()
        _table("##strokes", strokes, _CAP_SHARE)
    elif imgui.begin_table("##keys", 2, imgui.TableFlags_.sizing_stretch_prop):
        imgui.table_setup_column("kit", imgui.TableColumnFlags_.width_stretch, 0.36)
        imgui.table_setup_column("window", imgui.TableColumnFlags_.width_stretch, 0.64)
        imgui.table_next_column()
        _table("##strokes", strokes, _CAP_SHARE)
        imgui.table_next_column()
        _table("##commands", COMMANDS, _CAP_SHARE)
        imgui.end_table()
