"""The editor's notation: the grids engraved, each once; a click writes or erases, a drag selects bars.

The page scrolls downwards; its bars go into lines as wide as there is room, and Ctrl with the wheel makes it larger.
"""

from collections.abc import Callable

from imgui_bundle import imgui

from station.app.actions.editor_actions import Edit, EditorAction, PutCursor, SelectBars
from station.app.editor.editor_view import EditorView
from station.app.editor.staff_pointer import StaffCell, StaffPointer, symbol_of
from station.drills.editing.edit_words import line_words
from station.drills.editing.grid_cursor import BarRange, Place, letter_at, writing
from station.drills.editing.lesson_edits import REST, LineAt
from station.gui import theme
from station.gui.flat_canvas import FlatCanvas
from station.gui.panels.editor.grid_part import letter_list, toggled
from station.gui.widgets.score_page import OverPage, PagePlace, paint_page
from station.render.notation.page.head_preview import head_preview
from station.render.notation.staff import step_of
from station.render.palette import BRAND, INK_SOFT, PAPER, with_opacity
from station.render.text.draw_list import Colour
from station.scenes.draft_notation import DraftNotation, Notation

NOTATION = "##notation"
PALETTE = "##staff-letters"
_SPACES, _LINE, _HIGH = (7.5, 14.0), 62.0, 23.0
"""Design pixels of a staff space, between which it is chosen so that a line has as many spaces as three bars of
sixteenths need, and a whole line with its words is seen (our choice)."""
_ZOOMS = (0.6, 0.75, 0.9, 1.0, 1.2, 1.45, 1.75, 2.1)
_USUAL_ZOOM = 3
_MARGIN = (1.4, 0.6)
"""Staff spaces beside and above the page."""
_SETTLES_S = 0.3
"""After so long without a change long music is set anew (our choice: between two words of whoever types)."""
_DRAG = 8.0
"""Design pixels after which a press is no click any more."""
_CURSOR = (0.95, 0.62)
"""Half of the cursor's box, in staff spaces."""


class NotationPart:
    """Keeps the page that is shown and what the mouse is in the middle of; what it does goes to `dispatch`."""

    def __init__(self, dispatch: Callable[[EditorAction], None], canvas: FlatCanvas) -> None:
        self._dispatch, self._canvas = dispatch, canvas
        self._draft = DraftNotation()
        self._zoom = _USUAL_ZOOM
        self._pressed: tuple[StaffCell | None, Place | None] | None = None
        self._selects = False
        self._followed: Place | None = None
        self._text, self._since = "", 0.0
        self.pointer: StaffPointer | None = None
        """What the page of the last frame means; None while there is none."""
        self.corner, self.space = (0.0, 0.0), 1.0
        """Where on the screen the page begins, and how many pixels a staff space has."""

    def gui(self, view: EditorView, size: tuple[float, float]) -> None:
        """Draw it in so many pixels and do what the user does in it."""
        flags = imgui.WindowFlags_.no_scroll_with_mouse if imgui.get_io().key_ctrl else 0
        imgui.begin_child("##notation-part", imgui.ImVec2(*size), 0, flags)
        self._zoomed()
        room = imgui.get_content_region_avail()
        self.space = self._fitting(room) * _ZOOMS[self._zoom]
        notation = self._draft.of(view.text, max(room.x / self.space - 2 * _MARGIN[0], 1.0), self._is_settled(view))
        if notation is None:
            theme.soft("No notation can be shown: mend the text, or take the last change back.")
            self.pointer = None
        else:
            self._page(view, notation, room.x)
        imgui.end_child()

    @staticmethod
    def _fitting(room: imgui.ImVec2) -> float:
        """Pixels of a staff space for so much room."""
        least, most = map(theme.points, _SPACES)
        return min(max(min(room.x / _LINE, imgui.get_window_height() / _HIGH), least), most)

    def _is_settled(self, view: EditorView) -> bool:
        """Whether the text has not changed for a moment."""
        if view.text is not self._text:
            self._text, self._since = view.text, imgui.get_time()
        return bool(imgui.get_time() - self._since >= _SETTLES_S)

    def place_on_screen(self, x: float, y: float) -> tuple[float, float]:
        """Where a place of the page, in staff spaces, is on the screen."""
        return self.corner[0] + x * self.space, self.corner[1] + y * self.space

    # --- the page ----------------------------------------------------------------------------------------------------

    def _page(self, view: EditorView, notation: Notation, width: float) -> None:
        start, pointer = imgui.get_cursor_screen_pos(), StaffPointer(notation, view.page, view.step)
        self.pointer = pointer
        self.corner = start.x + _MARGIN[0] * self.space, start.y + _MARGIN[1] * self.space
        height = max((notation.page.height + _MARGIN[1]) * self.space, imgui.get_content_region_avail().y)
        imgui.invisible_button(NOTATION, imgui.ImVec2(width, height))
        hovered = imgui.is_item_hovered() and notation.can_be_edited
        cell = pointer.cell_at(*self._mouse()) if hovered else None
        self._press(view, pointer, hovered, cell)
        self._paint(view, notation, None if self._selects else cell)
        self._over(view, pointer)
        if not notation.is_present:
            self._veil("The text is at fault: this is what it was before")
        elif cell is not None and not self._selects:
            _tell(view, cell)
        self._palette(view)
        self._follow(view, pointer)

    def _mouse(self) -> tuple[float, float]:
        """Where the mouse is on the page, in staff spaces."""
        mouse = imgui.get_io().mouse_pos
        return (mouse.x - self.corner[0]) / self.space, (mouse.y - self.corner[1]) / self.space

    def _zoomed(self) -> None:
        io = imgui.get_io()
        if io.key_ctrl and io.mouse_wheel and imgui.is_window_hovered():
            self._zoom = min(max(self._zoom + (1 if io.mouse_wheel > 0 else -1), 0), len(_ZOOMS) - 1)

    # --- the mouse ---------------------------------------------------------------------------------------------------

    def _press(self, view: EditorView, pointer: StaffPointer, hovered: bool, cell: StaffCell | None) -> None:
        if hovered and imgui.is_mouse_clicked(imgui.MouseButton_.left):
            self._pressed = cell, pointer.bar_at(*self._mouse())
        elif hovered and cell is not None and imgui.is_mouse_clicked(imgui.MouseButton_.right):
            self._dispatch(PutCursor(cell.cursor))
            imgui.open_popup(PALETTE)
        elif self._pressed is not None and imgui.is_mouse_released(imgui.MouseButton_.left):
            self._released(view, *self._pressed)
        elif self._pressed is not None and imgui.is_mouse_dragging(imgui.MouseButton_.left, theme.points(_DRAG)):
            self._drag(view, pointer, self._pressed[1])

    def _drag(self, view: EditorView, pointer: StaffPointer, first: Place | None) -> None:
        """Select the bars from where the mouse was pressed to where it is, of one grid."""
        self._selects = True
        last = pointer.bar_at(*self._mouse())
        if first is not None and last is not None and first.grid == last.grid:
            bars = BarRange(first.grid, *sorted((first.bar, last.bar)))
            if bars != view.bars:
                self._dispatch(SelectBars(bars))

    def _released(self, view: EditorView, cell: StaffCell | None, bar: Place | None) -> None:
        was_drag, self._pressed, self._selects = self._selects, None, False
        if was_drag:
            return
        if cell is not None:
            self._click(view, cell)
        elif bar is None:
            self._dispatch(SelectBars(None))

    def _click(self, view: EditorView, cell: StaffCell) -> None:
        """Write what was chosen, or erase it where it stands."""
        letter = toggled(view, cell.cursor.line, _present(view, cell))
        self._dispatch(PutCursor(cell.cursor))
        self._dispatch(Edit(writing(view.page, cell.cursor, letter)))

    def _palette(self, view: EditorView) -> None:
        if imgui.begin_popup(PALETTE):
            letter = letter_list(view)
            if letter is not None:
                self._dispatch(Edit(writing(view.page, view.cursor, letter)))
                imgui.close_current_popup()
            imgui.end_popup()

    # --- painting ----------------------------------------------------------------------------------------------------

    def _paint(self, view: EditorView, notation: Notation, cell: StaffCell | None) -> None:
        """The part of the page that is seen, with the head that a click would write."""
        preview = None if cell is None or cell.is_struck else self._preview(view, cell)
        paint_page(self._canvas, notation.page, PagePlace(self.corner, self.space), preview)

    def _preview(self, view: EditorView, cell: StaffCell) -> OverPage:
        """The stroke that a click writes, its zone and how it is struck, and where."""
        line = cell.cursor.line
        assert isinstance(line, LineAt)
        symbol = symbol_of(line, toggled(view, line, _present(view, cell)))
        stroke = line.piece, (symbol.zone, symbol.articulation), (cell.x, cell.y)
        return OverPage(stroke, lambda atlas: head_preview(*stroke, atlas))

    def _over(self, view: EditorView, pointer: StaffPointer) -> None:
        """Selected bars, bars at fault, the cursor, and the line that plays."""
        for number, place in enumerate(pointer.notation.music.bars):
            chosen = view.bars is not None and view.bars.holds(place.grid, place.bar)
            at_fault = _is_at_fault(view, place)
            found = pointer.notation.page.places.bar(number) if chosen or at_fault else None
            if found is not None:
                line, bar = found
                colour = with_opacity(PAPER, 0.6) if at_fault else with_opacity(BRAND, 0.10)
                self._box((bar.left, line.top, bar.right, line.bottom), colour, is_filled=True)
        self._cursor(view, pointer)
        if view.playhead is not None and (spot := pointer.spot(view.playhead)) is not None:
            line, x = spot
            self._box((x - 0.1, line.top, x + 0.1, line.bottom), with_opacity(BRAND, 0.85), is_filled=True)

    def _cursor(self, view: EditorView, pointer: StaffPointer) -> None:
        line, spot = view.cursor.line, pointer.spot(view.cursor.place)
        if isinstance(line, LineAt) and spot is not None:
            y, (across, upright) = spot[0].y_of(step_of(line.piece)), _CURSOR
            self._box((spot[1] - across, y - upright, spot[1] + across, y + upright), BRAND, is_filled=False)

    def _box(self, box: tuple[float, float, float, float], colour: Colour, is_filled: bool) -> None:
        low, high = self.place_on_screen(*box[:2]), self.place_on_screen(*box[2:])
        ink = imgui.color_convert_float4_to_u32(imgui.ImVec4(*theme.themed(colour)))
        brush = imgui.get_window_draw_list()
        if is_filled:
            brush.add_rect_filled(imgui.ImVec2(*low), imgui.ImVec2(*high), ink, theme.points(3))
        else:
            brush.add_rect(imgui.ImVec2(*low), imgui.ImVec2(*high), ink, theme.points(3), thickness=theme.points(1.5))

    def _veil(self, words: str) -> None:
        low, size = imgui.get_window_pos(), imgui.get_window_size()
        brush, high = imgui.get_window_draw_list(), imgui.ImVec2(low.x + size.x, low.y + size.y)
        veil, ink = (imgui.ImVec4(*theme.themed(c)) for c in (with_opacity(PAPER, 0.6), INK_SOFT))
        brush.add_rect_filled(low, high, imgui.color_convert_float4_to_u32(veil))
        at = imgui.ImVec2(low.x + theme.points(12), high.y - imgui.get_text_line_height() - theme.points(8))
        brush.add_text(at, imgui.color_convert_float4_to_u32(ink), words)

    def _follow(self, view: EditorView, pointer: StaffPointer) -> None:
        """Scroll to the line that plays, or that the cursor has gone to, once it goes there."""
        place = view.playhead if view.plays and view.playhead is not None else view.cursor.place
        now = Place(place.grid, place.bar)
        spot = pointer.spot(now) if now != self._followed else None
        if spot is None:
            return
        self._followed = now
        top, bottom = ((y + _MARGIN[1]) * self.space for y in (spot[0].top, spot[0].bottom))
        if top < imgui.get_scroll_y() or bottom > imgui.get_scroll_y() + imgui.get_window_height():
            imgui.set_scroll_y(max(top - self.space, 0.0))


def _present(view: EditorView, cell: StaffCell) -> str:
    grids, number = view.page.grids, cell.cursor.grid
    return letter_at(grids[number], cell.cursor) if number < len(grids) else REST


def _is_at_fault(view: EditorView, place: Place) -> bool:
    """Whether a line of the bar cannot be read."""
    if place.grid >= len(view.page.grids):
        return False
    lines = view.page.grids[place.grid].lines
    return any(place.bar < len(line.bars) and not line.bars[place.bar].cells for line in lines)


def _tell(view: EditorView, cell: StaffCell) -> None:
    """Say what stands under the mouse, and what a click does."""
    what = line_words(cell.cursor.line)
    does = "a click erases it" if cell.is_struck else "a click writes it"
    theme.tooltip(f"{what}: {does}. Right click: all letters. Drag: select bars")
