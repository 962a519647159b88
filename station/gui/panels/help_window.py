"""The window that F1 opens: what the open page is, the tools that are open, and what the keys play and do."""

from collections.abc import Sequence
from itertools import zip_longest

from imgui_bundle import imgui

from station.app.help_topics import HELP, Topic
from station.gui import theme
from station.gui.keyboard_kit import COMMANDS, KEYS
from station.gui.panels.editor.editor_keys import EDITOR_HELP
from station.gui.panels.panel import Panel

_WIDE, _HIGH = 640, 470
"""Design pixels; what is longer scrolls."""


def help_window(topic: Topic, tools: Sequence[Panel], frame_ms: float) -> bool:
    """Explain the page and the open `tools`, with the keys on a second leaf; returns whether the window stays open."""
    viewport = imgui.get_main_viewport()
    wide, high = min(theme.points(_WIDE), viewport.size.x), min(theme.points(_HIGH), viewport.size.y)
    imgui.set_next_window_size(imgui.ImVec2(wide, high), imgui.Cond_.appearing)
    imgui.set_next_window_pos(viewport.get_center(), imgui.Cond_.appearing, imgui.ImVec2(0.5, 0.5))
    _, stays = imgui.begin("Help", True, imgui.WindowFlags_.no_collapse | imgui.WindowFlags_.no_docking)
    if imgui.begin_tab_bar("##leaves"):
        if imgui.begin_tab_item("This page")[0]:
            _page(topic, tools)
            imgui.end_tab_item()
        if imgui.begin_tab_item("Keys")[0]:
            _command_keys(EDITOR_HELP) if topic is Topic.EDITOR else _keys(frame_ms)
            imgui.end_tab_item()
        imgui.end_tab_bar()
    imgui.end()
    return bool(stays)


def _page(topic: Topic, tools: Sequence[Panel]) -> None:
    page = HELP[topic]
    theme.heading(topic.value, 22)
    imgui.text_wrapped(page.head)
    imgui.spacing()
    if imgui.begin_table("##parts", 2, imgui.TableFlags_.sizing_stretch_prop):
        imgui.table_setup_column("name", imgui.TableColumnFlags_.width_stretch, 0.27)
        imgui.table_setup_column("about", imgui.TableColumnFlags_.width_stretch, 0.73)
        for name, tip in page.parts:
            imgui.table_next_row()
            imgui.table_next_column()
            imgui.text_wrapped(name)
            imgui.table_next_column()
            theme.soft(tip)
        imgui.end_table()
    for tool in tools:
        imgui.separator()
        theme.heading(tool.name, 22)
        imgui.text_wrapped(tool.help or tool.about)


def _command_keys(commands: Sequence[tuple[str, str]]) -> None:
    """Keys and what they do, a line each."""
    if imgui.begin_table("##keys", 2, imgui.TableFlags_.sizing_fixed_fit):
        for cap, words in commands:
            imgui.table_next_row()
            imgui.table_next_column()
            imgui.text(cap)
            imgui.table_next_column()
            imgui.text_disabled(words)
        imgui.end_table()


def _keys(frame_ms: float) -> None:
    theme.soft(
        f"Without a kit, play on these keys. They are looked at once a frame, now every {frame_ms:.0f} ms,"
        " so their timing is that coarse: a kit is measured far better."
    )
    strokes = [(stroke.cap, stroke.words) for stroke in KEYS.values()]
    if imgui.begin_table("##keys", 4, imgui.TableFlags_.sizing_fixed_fit):
        for played, done in zip_longest(strokes, COMMANDS, fillvalue=("", "")):
            imgui.table_next_row()
            for cap, words in (played, done):
                imgui.table_next_column()
                imgui.text(cap)
                imgui.table_next_column()
                imgui.text_disabled(words)
        imgui.end_table()
