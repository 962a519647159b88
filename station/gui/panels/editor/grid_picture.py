"""How the grid is painted: bars and beats, the letters in their cells, cursor, selection, the line that plays."""

from imgui_bundle import imgui

from station.app.editor.editor_view import EditorView
from station.core.pieces import Dynamic
from station.drills.editing.edit_words import line_words
from station.drills.editing.grid_cursor import Cursor, GridStep, Line, line_of, shown_bar
from station.drills.editing.grid_page import PageBar
from station.drills.editing.lesson_edits import REST, LineAt
from station.drills.grid.grid import GridFrame
from station.drills.grid.tab_symbols import SYMBOLS, family_of
from station.drills.writing.line_layout import counted
from station.gui import theme
from station.gui.panels.editor.grid_geometry import GridGeometry
from station.render import palette
from station.render.text.draw_list import Colour

_SIGN_SIZE, _HEAD_SIZE, _COUNT_SIZE = 0.95, 0.9, 0.78
"""Of the panels' letters."""
_FILLS = {Dynamic.GHOST: 0.16, Dynamic.NORMAL: 0.42, Dynamic.ACCENT: 0.92}
"""How strong a stroke's cell is: louder is brighter (our choice)."""
_TAKEN_SHARE, _TAKEN_SIZE = 0.74, 0.82
"""What the kit strikes is a disc of so much of a row, and its letter (our choice: no cell, for it is in none yet)."""
_INHERITED = 0.45
"""How faint what a variation takes over from its model is."""


class GridPicture:
    """Paints one view by its geometry, from `corner` on the screen: the bars between the edges that are `seen`."""

    def __init__(
        self, view: EditorView, geometry: GridGeometry, corner: tuple[float, float], seen: tuple[float, float]
    ) -> None:
        self._view, self._geometry = view, geometry
        self._left, self._top = corner
        self._brush = imgui.get_window_draw_list()
        self._seen = geometry.bars_between(seen[0] - corner[0], seen[1] - corner[0])

    def draw(self, hover: Cursor | None, names_left: float) -> None:
        """All of it; the names stand at `names_left`, wherever the bars were scrolled to."""
        for bar in self._seen:
            self._bar(bar)
        for line in self._geometry.rows:
            self._line(line)
        for cell in self._view.fault_cells:
            self._fault(cell.at)
        if hover is not None and self._geometry.y_of(hover.line) is not None:
            self._frame(hover, palette.INK_SOFT, 1.0)
        self._cursor()
        self._taken()
        self._playhead()
        self._names(names_left)

    # --- bars --------------------------------------------------------------------------------------------------------

    def _bar(self, bar: int) -> None:
        """The bar's ground, its number, its beats and its count."""
        geometry, frame = self._geometry, self._geometry.grid.frames[bar]
        left, right = geometry.x_of(bar, 0), geometry.x_of(bar, frame.meter.bar_ticks)
        chosen = self._view.bars is not None and self._view.bars.holds(self._view.cursor.grid, bar)
        head = palette.with_opacity(palette.BRAND, 0.30) if chosen else palette.with_opacity(palette.INK, 0.07)
        self._box((left, 0, right, geometry.sizes.head * 0.5), head, 4.0)
        for index, (start, length) in enumerate(frame.spans or ((0, frame.meter.bar_ticks),)):
            ground = 0.055 if index % 2 == 0 else 0.02
            box = (
                geometry.x_of(bar, start),
                geometry.sizes.head,
                geometry.x_of(bar, start + length),
                geometry.height,
            )
            self._box(box, palette.with_opacity(palette.INK, ground))
        if chosen:
            self._box((left, geometry.sizes.head, right, geometry.height), palette.with_opacity(palette.BRAND, 0.06))
        is_repeat = any(bar < len(line.bars) and line.bars[bar].repeats for line in geometry.grid.lines)
        number = f"{bar + 1} %" if is_repeat else str(bar + 1)
        self._text((left + theme.points(6), theme.points(2)), number, palette.INK, _HEAD_SIZE)
        self._count(bar, frame)

    def _count(self, bar: int, frame: GridFrame) -> None:
        geometry = self._geometry
        for tick, syllable in count_of(frame, geometry.step):
            colour = palette.INK if syllable.isdigit() else palette.INK_SOFT
            width = geometry.step.ticks * geometry.per_tick
            size = imgui.get_font_size() * _COUNT_SIZE
            wide = imgui.calc_text_size(syllable).x * _COUNT_SIZE
            at = geometry.x_of(bar, tick) + (width - wide) / 2, geometry.sizes.head - size - theme.points(3)
            self._text(at, syllable, colour, _COUNT_SIZE)

    # --- lines -------------------------------------------------------------------------------------------------------

    def _line(self, line: Line) -> None:
        geometry, written = self._geometry, line_of(self._geometry.grid, line)
        top = geometry.y_of(line)
        assert top is not None
        edge = (geometry.sizes.names, top + geometry.sizes.row, geometry.width, top + geometry.sizes.row)
        self._stroke(edge, palette.with_opacity(palette.INK, 0.06), 1.0)
        strength = 1.0 if written is None or written.is_own else _INHERITED
        for bar in () if written is None else self._seen:
            shown = shown_bar(geometry.grid, bar, line)
            self._cells(line, bar, shown, strength * (0.6 if shown.repeats else 1.0))

    def _cells(self, line: Line, bar: int, written: PageBar, strength: float) -> None:
        geometry = self._geometry
        top = geometry.y_of(line)
        assert top is not None
        for cell in written.cells:
            left = geometry.x_of(bar, cell.tick)
            right = geometry.x_of(bar, cell.tick + cell.length_ticks)
            self._stroke(
                (left, top + 3, left, top + geometry.sizes.row - 3), palette.with_opacity(palette.INK, 0.09), 1
            )
            if cell.letter != REST:
                shown = min(right, left + geometry.sizes.most_cell)
                self._letter(line, cell.letter, (left, top, shown), strength)
        if not written.cells:
            right = geometry.x_of(bar, geometry.grid.frames[bar].meter.bar_ticks)
            box = (geometry.x_of(bar, 0), top + 3, right, top + geometry.sizes.row - 3)
            self._box(box, palette.with_opacity(palette.MISSED, 0.30), 4.0)

    def _letter(self, line: Line, letter: str, place: tuple[float, float, float], strength: float) -> None:
        left, top, right = place
        row = self._geometry.sizes.row
        colour, fill = _colour_of(line, letter)
        self._box(
            (left + 1.5, top + 2.5, right - 1.0, top + row - 2.5), palette.with_opacity(colour, fill * strength), 5
        )
        ink = palette.NIGHT if fill > 0.6 and strength == 1.0 else palette.INK
        size = imgui.calc_text_size(letter)
        at = (left + right - size.x * _SIGN_SIZE) / 2, top + (row - size.y * _SIGN_SIZE) / 2
        self._text(at, letter, palette.with_opacity(ink, max(strength, 0.75)), _SIGN_SIZE)

    def _names(self, left: float) -> None:
        """The lines' names, which stay where they are when the bars are scrolled."""
        geometry, x = self._geometry, left - self._left
        paper = palette.with_opacity(palette.PAPER, 1.0)
        self._box((x, 0, x + geometry.sizes.names - 4, geometry.height), paper)
        for line in geometry.rows:
            top = geometry.y_of(line)
            assert top is not None
            written = line_of(geometry.grid, line)
            is_here = line == self._view.cursor.line
            colour = palette.BRAND if is_here else palette.INK if written is not None else palette.INK_SOFT
            words = theme.one_line(line_words(line), geometry.sizes.names - theme.points(12))
            self._text((x + theme.points(2), top + theme.points(4)), words, colour, _HEAD_SIZE)

    # --- what moves --------------------------------------------------------------------------------------------------

    def _cursor(self) -> None:
        cursor, geometry = self._view.cursor, self._geometry
        if geometry.y_of(cursor.line) is not None and cursor.bar < geometry.grid.bar_count:
            self._frame(cursor, palette.BRAND, 2.0)

    def _fault(self, at: Cursor) -> None:
        """A cell that is at fault."""
        geometry = self._geometry
        if at.grid == self._view.cursor.grid and at.bar in self._seen and geometry.y_of(at.line) is not None:
            self._frame(at, palette.MISSED, 3.0)

    def _frame(self, at: Cursor, colour: Colour, thick: float) -> None:
        geometry, top = self._geometry, self._geometry.y_of(at.line)
        assert top is not None
        left = geometry.x_of(at.bar, at.tick)
        right = left + max(geometry.step.ticks * geometry.per_tick, theme.points(10))
        low, high = self._at(left, top + 1), self._at(right, top + geometry.sizes.row - 1)
        self._brush.add_rect(low, high, theme.packed(colour), theme.points(5), theme.points(thick))

    def _taken(self) -> None:
        """What the kit has struck in the pass that sounds: each letter where it was struck, before it is in a cell."""
        geometry, take = self._geometry, self._view.take
        for stroke in () if take is None else take.strokes:
            top = geometry.y_of(stroke.at.line)
            if top is None or stroke.at.grid != self._view.cursor.grid or stroke.at.bar >= geometry.grid.bar_count:
                continue
            row, size = geometry.sizes.row, _TAKEN_SIZE
            x = geometry.x_of(stroke.at.bar, stroke.at.tick + geometry.step.ticks / 2)  # on time: amid its cell
            half = row * _TAKEN_SHARE / 2
            middle = top + row / 2
            box = (x - half, middle - half, x + half, middle + half)
            self._box(box, palette.with_opacity(palette.BRAND, 0.9), half / theme.points(1))
            words = imgui.calc_text_size(stroke.letter)
            self._text((x - words.x * size / 2, middle - words.y * size / 2), stroke.letter, palette.NIGHT, size)

    def _playhead(self) -> None:
        place, geometry = self._view.playhead, self._geometry
        if place is None or place.grid != self._view.cursor.grid or place.bar >= geometry.grid.bar_count:
            return
        x = geometry.x_of(place.bar, place.tick)
        self._stroke((x, 0, x, geometry.height), palette.BRAND, 2.5)

    # --- the brush ---------------------------------------------------------------------------------------------------

    def _at(self, x: float, y: float) -> imgui.ImVec2:
        return imgui.ImVec2(self._left + x, self._top + y)

    def _box(self, box: tuple[float, float, float, float], colour: Colour, rounded: float = 0.0) -> None:
        low, high = self._at(*box[:2]), self._at(*box[2:])
        self._brush.add_rect_filled(low, high, theme.packed(colour), theme.points(rounded))

    def _stroke(self, ends: tuple[float, float, float, float], colour: Colour, thick: float) -> None:
        self._brush.add_line(self._at(*ends[:2]), self._at(*ends[2:]), theme.packed(colour), theme.points(thick))

    def _text(self, at: tuple[float, float], words: str, colour: Colour, size: float) -> None:
        where = self._at(*at)
        self._brush.add_text(imgui.get_font(), imgui.get_font_size() * size, where, theme.packed(colour), words)


def count_of(frame: GridFrame, step: GridStep) -> list[tuple[int, str]]:
    """What is counted in a bar, and at which tick; blanks are left out."""
    cells, rest = divmod(frame.meter.bar_ticks, step.ticks)
    if rest or not cells:
        cells = frame.meter.beats
    ticks = frame.meter.bar_ticks // cells
    words = counted(REST * cells, frame).ljust(cells)
    return [(index * ticks, word) for index, word in enumerate(words) if word != " "]


def _colour_of(line: Line, letter: str) -> tuple[Colour, float]:
    """A cell's colour and how strong it is."""
    if not isinstance(line, LineAt):
        return palette.INK, 0.12
    symbol = SYMBOLS[family_of(line.piece)].get(letter)
    return palette.GOOD, 0.25 if symbol is None else _FILLS[symbol.dynamic]
