"""The grid: a row a line, a column a cell, the bars above; a click writes, a drag paints, a right click offers all.

Drawn by hand into one control, for a table of imgui's has no cells of different width; where everything is says
`grid_geometry`.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

from imgui_bundle import imgui

from station.app.actions.editor_actions import Edit, EditorAction, PutCursor, SelectBars
from station.app.editor.editor_view import EditorView
from station.drills.editing.edit_words import line_words
from station.drills.editing.grid_cursor import BarRange, Cursor, GridStep, Line, letter_at, line_of, writing
from station.drills.editing.grid_page import PageGrid
from station.drills.editing.lesson_edits import REST, LineAt, RemoveLine, TextLine
from station.drills.editing.letter_palette import line_letters, usual_letter
from station.gui import theme
from station.gui.panels.editor.grid_geometry import GridGeometry, GridSizes
from station.gui.panels.editor.grid_picture import GridPicture

GRID = "##grid"
PALETTE, LINE_MENU = "##letters", "##line-menu"

_Asked = tuple[GridStep, tuple[Line, ...], float, GridSizes]
"""What a geometry is made of beside its grid."""


@dataclass(frozen=True, slots=True)
class _Stroke:
    """A drag that writes `letter` in a line, and the cell (bar, tick) that it wrote last."""

    line: Line
    letter: str
    cell: tuple[int, int]


class GridPart:
    """Keeps what the mouse is in the middle of; what it does goes to `dispatch`. `geometry` is of the last frame."""

    def __init__(self, dispatch: Callable[[EditorAction], None]) -> None:
        self._dispatch = dispatch
        self._stroke: _Stroke | None = None
        self._selects: int | None = None
        self._menu_line: Line = TextLine.STICKING
        self.geometry: GridGeometry | None = None
        self.corner = (0.0, 0.0)
        """Where on the screen the picture begins."""
        self._followed: tuple[int, int, int] | None = None
        self._made: tuple[tuple[PageGrid, _Asked, GridGeometry], ...] = ()
        """The last two geometries that were made: a frame asks for the width, and then for what fits in it."""

    def gui(self, view: EditorView, size: tuple[float, float]) -> None:
        """Draw it in so many pixels and do what the user does in it."""
        imgui.begin_child("##grid-part", imgui.ImVec2(*size), 0, imgui.WindowFlags_.horizontal_scrollbar)
        if view.grid is not None and view.grid.frames:
            self._grid(view, view.grid)
        else:
            theme.soft("No bars can be shown: mend the text, or take the last change back.")
        imgui.end_child()

    def needed_width(self, view: EditorView, most: float) -> float:
        """How many pixels it fills of at most so many."""
        if view.grid is None or not view.grid.frames:
            return most
        width = self._laid_out(view, view.grid, most).width
        return min(width + imgui.get_style().scrollbar_size, most)

    def _grid(self, view: EditorView, grid: PageGrid) -> None:
        room = imgui.get_content_region_avail()
        geometry = self._laid_out(view, grid, room.x)
        corner = imgui.get_cursor_screen_pos()
        self.geometry, self.corner = geometry, (corner.x, corner.y)
        imgui.invisible_button(
            GRID, imgui.ImVec2(geometry.width, geometry.height), imgui.ButtonFlags_.mouse_button_left
        )
        hovered = imgui.is_item_hovered()
        self._mouse(view, grid, hovered)
        hover = self._cell_under_mouse() if hovered and self._stroke is None else None
        left = imgui.get_window_pos().x
        GridPicture(view, geometry, self.corner, (left, left + imgui.get_window_width())).draw(hover, left)
        if hover is not None:
            _tell(view, grid, hover)
        self._palette(view)
        self._line_menu(view)
        self._follow(view)

    def _laid_out(self, view: EditorView, grid: PageGrid, width: float) -> GridGeometry:
        """The geometry in so many pixels, as it was made before where nothing has changed since."""
        asked = (view.step, grid_rows(grid, view), width, _sizes())
        for known, words, geometry in self._made:
            if known is grid and words == asked:
                return geometry
        made = GridGeometry.of(grid, *asked)
        self._made = ((grid, asked, made), *self._made[:1])
        return made

    # --- the mouse ---------------------------------------------------------------------------------------------------

    def _at(self) -> tuple[float, float]:
        """Where the mouse is in the picture."""
        mouse = imgui.get_io().mouse_pos
        return mouse.x - self.corner[0], mouse.y - self.corner[1]

    def _cell_under_mouse(self) -> Cursor | None:
        assert self.geometry is not None
        x, y = self._at()
        line = self.geometry.line_at(y)
        cell = None if line is None or self._is_over_names() else self.geometry.tick_at(x, line)
        return None if line is None or cell is None else Cursor(_grid_of(line, 0), *cell, line)

    def _is_over_names(self) -> bool:
        assert self.geometry is not None
        return bool(imgui.get_io().mouse_pos.x < imgui.get_window_pos().x + self.geometry.sizes.names)

    def _mouse(self, view: EditorView, grid: PageGrid, hovered: bool) -> None:
        if hovered and imgui.is_mouse_clicked(imgui.MouseButton_.left):
            self._pressed(view, grid)
        elif hovered and imgui.is_mouse_clicked(imgui.MouseButton_.right):
            self._asked(view)
        elif not imgui.is_mouse_down(imgui.MouseButton_.left):
            self._stroke = self._selects = None
        elif self._stroke is not None:
            self._paint(view, self._stroke)
        elif self._selects is not None:
            self._select(view, self._selects)

    def _pressed(self, view: EditorView, grid: PageGrid) -> None:
        assert self.geometry is not None
        x, y = self._at()
        cell = self._cell_under_mouse()
        if y < self.geometry.sizes.head:
            self._press_head(view, self.geometry.bar_at(x))
        elif cell is not None:
            present = letter_at(grid, cell)
            letter = toggled(view, cell.line, present)
            self._stroke = _Stroke(cell.line, letter, (cell.bar, cell.tick))
            self._write(view, cell, letter, joins=False)
        elif (line := self.geometry.line_at(y)) is not None:
            self._dispatch(PutCursor(Cursor(view.cursor.grid, view.cursor.bar, view.cursor.tick, line)))

    def _press_head(self, view: EditorView, bar: int) -> None:
        self._selects = bar
        is_double = imgui.is_mouse_double_clicked(imgui.MouseButton_.left)
        self._dispatch(SelectBars(None if is_double else BarRange(view.cursor.grid, bar, bar)))
        self._dispatch(PutCursor(Cursor(view.cursor.grid, bar, 0, view.cursor.line)))
        if is_double:
            self._selects = None

    def _select(self, view: EditorView, first: int) -> None:
        assert self.geometry is not None
        low, high = sorted((first, self.geometry.bar_at(self._at()[0])))
        bars = BarRange(view.cursor.grid, low, high)
        if bars != view.bars and (view.bars is not None or low != high):
            self._dispatch(SelectBars(bars))

    def _paint(self, view: EditorView, stroke: _Stroke) -> None:
        """Write the same letter wherever the drag goes along its line."""
        assert self.geometry is not None
        cell = self.geometry.tick_at(self._at()[0], stroke.line)
        if cell is not None and cell != stroke.cell and view.grid is not None:
            self._stroke = _Stroke(stroke.line, stroke.letter, cell)
            self._write(view, Cursor(view.cursor.grid, *cell, stroke.line), stroke.letter, joins=True)

    def _write(self, view: EditorView, cell: Cursor, letter: str, joins: bool) -> None:
        at = Cursor(view.cursor.grid, cell.bar, cell.tick, cell.line)
        self._dispatch(PutCursor(at))
        self._dispatch(Edit(writing(view.page, at, letter), joins))

    def _asked(self, view: EditorView) -> None:
        """A right click: all letters for a cell, or what can be done with a line."""
        assert self.geometry is not None
        cell, line = self._cell_under_mouse(), self.geometry.line_at(self._at()[1])
        if cell is not None:
            self._dispatch(PutCursor(Cursor(view.cursor.grid, cell.bar, cell.tick, cell.line)))
            imgui.open_popup(PALETTE)
        elif line is not None:
            self._menu_line = line
            imgui.open_popup(LINE_MENU)

    # --- what it opens -----------------------------------------------------------------------------------------------

    def _palette(self, view: EditorView) -> None:
        if imgui.begin_popup(PALETTE):
            letter = letter_list(view)
            if letter is not None:
                self._dispatch(Edit(writing(view.page, view.cursor, letter)))
                imgui.close_current_popup()
            imgui.end_popup()

    def _line_menu(self, view: EditorView) -> None:
        if imgui.begin_popup(LINE_MENU):
            imgui.text_disabled(line_words(self._menu_line))
            if imgui.selectable("Take this line away", False)[0]:
                self._dispatch(Edit(RemoveLine(self._menu_line, view.cursor.grid)))
            imgui.end_popup()

    def _follow(self, view: EditorView) -> None:
        """Scroll to where the music or the cursor has gone, once it goes there."""
        assert self.geometry is not None
        place = view.playhead if view.plays and view.playhead is not None else view.cursor.place
        if place.grid != view.cursor.grid or place.bar >= self.geometry.grid.bar_count:
            return
        now = (place.grid, place.bar, place.tick if not view.plays else 0)
        if now == self._followed:
            return
        self._followed = now
        left, width = imgui.get_scroll_x() + self.geometry.sizes.names, imgui.get_window_width()
        x = self.geometry.x_of(place.bar, now[2])
        if not left <= x <= imgui.get_scroll_x() + width - self.geometry.sizes.row * 2:
            imgui.set_scroll_x(max(x - self.geometry.sizes.names - self.geometry.sizes.row, 0.0))


def grid_rows(grid: PageGrid, view: EditorView) -> tuple[Line, ...]:
    """The rows from above: lines that are played, those that cursor or kit are about to make, hands, loudness."""
    struck = () if view.take is None else tuple(stroke.at.line for stroke in view.take.strokes)
    played = [*(line.at for line in grid.lines), *struck, view.cursor.line]
    return (*dict.fromkeys(each for each in played if isinstance(each, LineAt)), TextLine.STICKING, TextLine.LOUDNESS)


def letter_list(view: EditorView) -> str | None:
    """All that can be written in the cursor's line, one under the other; returns what was pressed."""
    picked = REST if imgui.selectable("-     nothing", False)[0] else None
    for letter, words in line_letters(view.cursor.line).items():
        if imgui.selectable(f"{letter} ###letter {letter}", letter == view.letter)[0]:
            picked = letter
        imgui.same_line(theme.points(40))
        imgui.text_disabled(words)
    return picked


def toggled(view: EditorView, line: Line, present: str) -> str:
    """What a click makes of a cell: the chosen letter, or nothing where that stands."""
    chosen = view.letter if line == view.cursor.line and view.letter in line_letters(line) else ""
    if line is TextLine.STICKING and not chosen:
        return {REST: "R", "R": "L"}.get(present, REST)
    if not chosen:
        return usual_letter(line) if present == REST else REST
    return REST if present == chosen else chosen


def _grid_of(line: Line, usual: int) -> int:
    return line.grid if isinstance(line, LineAt) else usual


def _tell(view: EditorView, grid: PageGrid, cell: Cursor) -> None:
    """Say what stands in the cell under the mouse, and what a click writes."""
    present = letter_at(grid, cell)
    letters = line_letters(cell.line)
    there = letters.get(present, "") or present
    words = f"{line_words(cell.line)}: {'nothing' if present == REST else there}. Right click: all letters"
    faults = [each.text for each in view.fault_cells if each.at == replace(cell, grid=view.cursor.grid)]
    theme.tooltip("\n".join([*faults, words, *_repeat_words(grid, cell)]))


def _repeat_words(grid: PageGrid, cell: Cursor) -> list[str]:
    """What an edit does beside its own bar, where the line is written with `%` there."""
    line = line_of(grid, cell.line)
    if line is None or cell.bar >= len(line.bars):
        return []
    if line.bars[cell.bar].repeats:
        return ["This bar is written %, as the one before it: a click writes it out, and changes it alone"]
    after = line.bars[cell.bar + 1 : cell.bar + 2]
    return ["The next bar is written %: what changes here changes there"] if after and after[0].repeats else []


def _sizes() -> GridSizes:
    return GridSizes(
        names=theme.points(132),
        head=theme.points(44),
        row=theme.points(27),
        least_cell=theme.points(15),
        most_cell=theme.points(44),
        gap=theme.points(5),
    )
