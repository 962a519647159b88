"""Weeks by limb or piece: a table of numbers with their intervals, shaded by how far they are from what is wanted."""

from dataclasses import replace
from datetime import date

from imgui_bundle import imgui

from station.app.actions.history_actions import Asked
from station.app.history.history_shown import HistoryPages
from station.app.history.part_names import full_name, short_name
from station.gui import theme
from station.gui.widgets.flow_row import FlowRow
from station.gui.widgets.long_combo import long_combo
from station.practice.progress.overview import Cell, WeekMeasure, WeekTable, cell_words
from station.render import palette
from station.store.rows import Part

PART_LABELS = {Part.LIMB: "by limb##weeks", Part.PIECE: "by piece##weeks"}
MEASURE_LABEL, LESSON_LABEL = "##weeks-measure", "##weeks-lesson"
_MEASURES = {
    WeekMeasure.LEAN: "Lean in ms: + late, − early",
    WeekMeasure.SPREAD: "Spread in ms",
    WeekMeasure.HIT: "Notes hit in %",
}
_FAR = {WeekMeasure.LEAN: 30.0, WeekMeasure.SPREAD: 50.0, WeekMeasure.HIT: 40.0}
"""How far from what is wanted is shaded most: milliseconds and percents (our choice: twice what a pass may have)."""
_WEEK = "Week of"
_MOST = 0.55
"""Opacity of the darkest cell."""
_ABOUT = (
    "A number is the mean of the week's days, ± how far the truth may lie, 19 times in 20; without ± it cannot be told."
    " Another lesson or tempo changes it too."
)
_COLUMN = 48.0
"""Design pixels of a column at least."""
_WIDER = "Wider than the panel: Shift and the wheel, or the bar below, show the rest; the busiest stand first."


def weeks_part(pages: HistoryPages, asked: Asked) -> Asked:
    """Draw the table and what it is of; returns what is asked for now."""
    row = FlowRow()
    for part, label in PART_LABELS.items():
        words = imgui.calc_text_size(label, True).x
        row.place(imgui.get_frame_height() + imgui.get_style().item_inner_spacing.x + words)
        if imgui.radio_button(label, asked.part is part):
            asked = replace(asked, part=part)
    imgui.set_next_item_width(-1)
    measures = list(_MEASURES)
    at = long_combo(MEASURE_LABEL, measures.index(asked.measure), list(_MEASURES.values()))
    theme.tooltip(
        "Lean: the mean against the click. Spread: how far strokes scatter. Hit: notes that a stroke answered"
    )
    asked = replace(asked, measure=measures[at])
    names = ["", *(each.name for each in pages.lessons)]
    titles = ["all lessons", *(f"{each.title}##{each.name}" for each in pages.lessons)]
    imgui.set_next_item_width(-1)
    chosen = names.index(asked.lesson_of_weeks) if asked.lesson_of_weeks in names else 0
    at = long_combo(LESSON_LABEL, chosen, titles)
    theme.tooltip("Of one lesson alone: then weeks are more alike")
    asked = replace(asked, lesson_of_weeks=names[at])
    table = pages.weeks
    if table is None:
        theme.soft("Reading …")
    elif not table.rows:
        theme.soft("Nothing of that was played in these weeks.")
    else:
        theme.soft(_ABOUT)
        _table(table)
    return asked


def _table(table: WeekTable) -> None:
    first, widths = imgui.calc_text_size(_WEEK).x, _widths(table)
    between = 2 * imgui.get_style().cell_padding.x
    taken = first + sum(widths) + between * (len(widths) + 1) + imgui.get_style().scrollbar_size
    if taken > imgui.get_content_region_avail().x:
        theme.soft(_WIDER)
    flags = imgui.TableFlags_.scroll_x | imgui.TableFlags_.scroll_y | imgui.TableFlags_.sizing_fixed_fit
    if not imgui.begin_table("##weeks", len(table.rows) + 1, flags):
        return
    imgui.table_setup_scroll_freeze(1, 1)
    imgui.table_setup_column(_WEEK, imgui.TableColumnFlags_.width_fixed, first)
    for (name, _), width in zip(table.rows, widths, strict=True):
        imgui.table_setup_column(short_name(table.part, name), imgui.TableColumnFlags_.width_fixed, width)
    imgui.table_headers_row()
    for at in reversed(range(len(table.weeks))):
        cells = [cells[at] for _, cells in table.rows]
        if any(cells):
            _week(table, table.weeks[at], cells)
    imgui.end_table()


def _widths(table: WeekTable) -> list[float]:
    """Pixels of each column: as wide as its widest text."""
    texts = (
        [short_name(table.part, name), *(_number(table.measure, cell) for cell in cells if cell is not None)]
        for name, cells in table.rows
    )
    return [max(theme.points(_COLUMN), *(imgui.calc_text_size(text).x for text in own)) for own in texts]


def _week(table: WeekTable, monday: date, cells: list[Cell | None]) -> None:
    imgui.table_next_row()
    imgui.table_next_column()
    imgui.text(f"{monday.day} {monday:%b}")
    for (name, _), cell in zip(table.rows, cells, strict=True):
        imgui.table_next_column()
        if cell is None:
            imgui.text_disabled("–")
            continue
        colour = palette.with_opacity(theme.themed(palette.MISSED), _MOST * _off(table.measure, cell.value))
        imgui.table_set_bg_color(imgui.TableBgTarget_.cell_bg, imgui.color_convert_float4_to_u32(imgui.ImVec4(*colour)))
        imgui.text(_number(table.measure, cell))
        theme.tooltip(
            f"{full_name(table.part, name)}, week of {monday.day} {monday:%B}: {cell_words(table.measure, cell)}"
        )


def _off(measure: WeekMeasure, value: float) -> float:
    """How far a value is from what is wanted, 0 to 1."""
    off = 100.0 - value if measure is WeekMeasure.HIT else abs(value)
    return min(off / _FAR[measure], 1.0)


def _number(measure: WeekMeasure, cell: Cell) -> str:
    whole = round(cell.value)
    value = f"{whole:+d}" if measure is WeekMeasure.LEAN and whole else f"{whole}"
    return value.replace("-", "−") + ("" if cell.half is None else f" ±{cell.half:.0f}")
