"""The heat map beside a result: a row a bar, a column a limb; a click on a bar drills it."""

from imgui_bundle import imgui

from station.app import theme
from station.app.heat_map import HeatMap
from station.core.pieces import Limb
from station.render import palette

_NAMES = {
    Limb.LEFT_HAND: ("LH", "left hand"),
    Limb.RIGHT_HAND: ("RH", "right hand"),
    Limb.LEFT_FOOT: ("LF", "left foot"),
    Limb.RIGHT_FOOT: ("RF", "right foot"),
}
_BEST, _WORST = palette.with_opacity(palette.GOOD, 0.16), palette.with_opacity(palette.MISSED, 0.75)
"""Of the night; the theme dyes them."""


def heat_panel(heat: HeatMap) -> int | None:
    """Draw the map; returns the bar (from 1) that the user wants to drill, None for none."""
    theme.heading("Bar by bar", 20)
    theme.soft("Notes right, in percent. Click a bar to practise it alone.")
    chosen = None
    limbs = heat.limbs
    flags = imgui.TableFlags_.sizing_stretch_same | imgui.TableFlags_.scroll_y
    if limbs and imgui.begin_table("##heat", len(limbs) + 1, flags):
        imgui.table_setup_scroll_freeze(0, 1)
        imgui.table_setup_column("bar")
        for limb in limbs:
            imgui.table_setup_column(_NAMES[limb][0])
        imgui.table_headers_row()
        for bar in heat.bars:
            if _row(heat, bar, limbs):
                chosen = bar
        imgui.end_table()
    return chosen


def _row(heat: HeatMap, bar: int, limbs: list[Limb]) -> bool:
    """One bar; returns whether it was pressed."""
    imgui.table_next_row()
    imgui.table_next_column()
    pressed = imgui.button(f"{bar}##bar{bar}", imgui.ImVec2(-1, 0))
    theme.tooltip(f"Practise bar {bar} alone, at the same tempo")
    for limb in limbs:
        imgui.table_next_column()
        cell = heat.cells.get((bar, limb))
        if cell is None:
            continue
        colour = palette.mixed(theme.dyed(_WORST), theme.dyed(_BEST), cell.share)
        imgui.push_style_color(imgui.Col_.button, imgui.ImVec4(*colour))
        pressed |= imgui.button(f"{100 * cell.share:.0f}##{bar}-{limb.name}", imgui.ImVec2(-1, 0))
        imgui.pop_style_color()
        theme.tooltip(f"Bar {bar}, {_NAMES[limb][1]}: {cell.right} of {cell.notes} right. Click to practise the bar")
    return bool(pressed)
