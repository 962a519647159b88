"""What stands beside a result: the heat map, a row a bar and a column a limb, and a bar to be compared."""

from imgui_bundle import imgui

from station.app.room_state import ShownResult
from station.core.pieces import Limb
from station.gui import theme
from station.gui.panels.playback_row import PlaybackRow
from station.gui.widgets.flow_row import FlowRow
from station.render import palette
from station.scenes.heat_map import HeatMap

_NAMES = {
    Limb.LEFT_HAND: ("LH", "left hand"),
    Limb.RIGHT_HAND: ("RH", "right hand"),
    Limb.LEFT_FOOT: ("LF", "left foot"),
    Limb.RIGHT_FOOT: ("RF", "right foot"),
}
_COMPARING, _HEADING, _LINE, _LEAST = 134.0, 34.0, 27.0, 90.0
"""Design pixels: the height of the part below the map, of the wrong pads' heading and lines, the least of the map."""
_CONFUSIONS = 3
"""So many confusions are named; our choice, the most frequent are worth a look."""
_BEST, _WORST = palette.with_opacity(palette.GOOD, 0.16), palette.with_opacity(palette.MISSED, 0.75)
"""Of the night; the theme dyes them."""


_PRACTISE = "Practise bar {bar} alone, at the same tempo"
_LOOK = "Hear and see bar {bar}"


def bars_panel(report: ShownResult, playback: PlaybackRow, can_drill: bool = True) -> int | None:
    """Draw both; returns the bar (from 1) that the user wants to drill, None for none.

    Where none can be, in an exam or in what a student sent, a bar is chosen to be heard.
    """
    can_drill = can_drill and not report.student
    confused = report.wrong_pads[:_CONFUSIONS]
    below = theme.points(_COMPARING + (_HEADING + _LINE * len(confused) if confused else 0.0))
    below = below if len(report.hits.dots) else 0.0
    chosen = _heat(report.heat, imgui.get_content_region_avail().y - below, _PRACTISE if can_drill else _LOOK)
    if not can_drill and chosen is not None:
        playback.bar, chosen = chosen, None
    if below:
        imgui.set_cursor_pos_y(max(imgui.get_cursor_pos_y(), imgui.get_window_height() - below))
        if confused:
            imgui.separator_text("Wrong pads")
        for pad in confused:
            if imgui.selectable(f"{pad.words}##wrong-{pad.words}", False)[0]:
                playback.show(report, pad.bar, pad.pass_number)
            theme.tooltip(f"Most in bar {pad.bar}. Click to see it: the drummer's arm goes to the right pad, and glows")
        imgui.separator_text("Hear and see a bar")
        playback.gui(report, FlowRow())
    return chosen


def _heat(heat: HeatMap, height: float, press: str) -> int | None:
    top = imgui.get_cursor_pos_y()
    theme.heading("Bar by bar", 20)
    what = "to hear and see it" if press is _LOOK else "to practise it alone"
    theme.soft(f"Notes right, in percent. Click a bar {what}.")
    chosen = None
    limbs = heat.limbs  # buttons in a table: no cell of ImPlot's heat map is empty, or reached by the keyboard
    flags = imgui.TableFlags_.sizing_stretch_same | imgui.TableFlags_.scroll_y
    room = max(height - (imgui.get_cursor_pos_y() - top), theme.points(_LEAST))
    if limbs and imgui.begin_table("##heat", len(limbs) + 1, flags, imgui.ImVec2(0, room)):
        imgui.table_setup_scroll_freeze(0, 1)
        imgui.table_setup_column("bar")
        for limb in limbs:
            imgui.table_setup_column(_NAMES[limb][0])
        imgui.table_headers_row()
        for bar in heat.bars:
            if _row(heat, bar, limbs, press):
                chosen = bar
        imgui.end_table()
    return chosen


def _row(heat: HeatMap, bar: int, limbs: list[Limb], press: str) -> bool:
    """One bar; returns whether it was pressed."""
    imgui.table_next_row()
    imgui.table_next_column()
    pressed = imgui.button(f"{bar}##bar{bar}", imgui.ImVec2(-1, 0))
    theme.tooltip(press.format(bar=bar))
    for limb in limbs:
        imgui.table_next_column()
        cell = heat.cells.get((bar, limb))
        if cell is None:
            continue
        colour = palette.mixed(theme.themed(_WORST), theme.themed(_BEST), cell.share)
        imgui.push_style_color(imgui.Col_.button, imgui.ImVec4(*colour))
        imgui.push_style_var(imgui.StyleVar_.frame_padding, imgui.ImVec2(0, imgui.get_style().frame_padding.y))
        pressed |= imgui.button(f"{100 * cell.share:.0f}##{bar}-{limb.name}", imgui.ImVec2(-1, 0))
        imgui.pop_style_var()
        imgui.pop_style_color()
        theme.tooltip(f"Bar {bar}, {_NAMES[limb][1]}: {cell.right} of {cell.notes} right. {press.format(bar=bar)}")
    return bool(pressed)
