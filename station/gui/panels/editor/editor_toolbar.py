"""What can be done with a lesson that is edited: keep it, take back, how fine and what one writes, grids and bars."""

from bisect import bisect_right
from collections.abc import Callable
from itertools import product

from imgui_bundle import icons_fontawesome_4 as icons
from imgui_bundle import imgui

from station.app.actions.editor_actions import (
    ChooseLetter,
    CloseEditor,
    CopySelection,
    CutSelection,
    DuplicateBars,
    Edit,
    EditorAction,
    PasteBars,
    PutCursor,
    Redo,
    RemoveSelection,
    SaveLesson,
    SetGridStep,
    Undo,
)
from station.app.editor.editor_view import EditorView
from station.core.labels import piece_name
from station.core.pieces import Piece
from station.drills.editing.edit_words import line_words
from station.drills.editing.grid_cursor import Cursor, GridStep
from station.drills.editing.lesson_edits import AddBars, AddGrid, AddLine, CutBeat, Fold, LineAt, RemoveGrid, SetKey
from station.drills.editing.letter_palette import line_letters, usual_letter
from station.drills.grid.tab_symbols import LINE_ORDER
from station.gui import theme
from station.gui.panels.editor.take_part import TakePart
from station.gui.widgets.flow_row import FlowRow

BACK_LABEL, SAVE_LABEL, SAVE_AS_LABEL = "Lessons###close-editor", "Save###save-editor", "Save as…##editor"
UNDO_LABEL, REDO_LABEL = f"{icons.ICON_FA_UNDO}##undo", f"{icons.ICON_FA_REDO}##redo"
STEP_LABEL, LETTER_LABEL, GRIDS_LABEL = "##grid-step", "##letter", "##grids"
BARS_LABEL, LINES_LABEL = "Bars##editor", "Lines##editor"
_SAVE_AS, _BARS, _LINES, _NEW_GRID = "##save-as", "##bars-menu", "##lines-menu", "##new-grid"
FOLD_LABEL = "Fold##editor"
NAME_LABEL, KEEP_LABEL = "##lesson-name", "Keep it##editor"
_ICON, _STEP, _LETTER, _GRIDS, _NAME = 38.0, 130.0, 170.0, 170.0, 240.0
"""Design pixels."""

_CLIPBOARD: tuple[tuple[str, EditorAction], ...] = (
    ("Cut (Ctrl+X)", CutSelection()),
    ("Copy (Ctrl+C)", CopySelection()),
    ("Paste over (Ctrl+V)", PasteBars()),
    ("Paste before (Ctrl+Shift+V)", PasteBars(inserts=True)),
)
CELLS = {
    1: "one",
    2: "halves",
    3: "triplets",
    4: "quarters of the beat",
    5: "quintuplets",
    6: "sextuplets",
    7: "septuplets",
    8: "eighths of the beat",
    9: "nonuplets",
    12: "twelfths",
}
"""Into how many cells a beat can be cut in the menu: what drummers play (our choice; the text knows more)."""


class EditorToolbar:
    """Keeps the name that is typed for a new file; what the user does goes to `dispatch`."""

    def __init__(self, dispatch: Callable[[EditorAction], None]) -> None:
        self._dispatch = dispatch
        self._take = TakePart(dispatch)
        self._name = ""
        self._lacks: frozenset[Piece] = frozenset()
        """The pieces that the smaller kit has not."""

    def gui(self, view: EditorView) -> None:
        """Draw it and do what the user does in it."""
        row = FlowRow()
        self._file(view, row)
        self._history(view, row)
        self._grids(view, row)
        self._writing(view, row)
        self._music(view, row)

    # --- the file ----------------------------------------------------------------------------------------------------

    def _file(self, view: EditorView, row: FlowRow) -> None:
        if _button(row, f"{icons.ICON_FA_CHEVRON_LEFT} {BACK_LABEL}"):
            self._dispatch(CloseEditor())
        theme.tooltip("Back to the lessons (Esc); what is not saved is kept, and offered again there")
        if _button(row, SAVE_LABEL if view.is_saved else f"{icons.ICON_FA_CIRCLE} {SAVE_LABEL}"):
            self._dispatch(SaveLesson())
        theme.tooltip("Write it among your own lessons (Ctrl+S). Until then every change is kept as a draft")
        if _button(row, SAVE_AS_LABEL):
            self._name = view.name
            imgui.open_popup(_SAVE_AS)
        theme.tooltip("Write it as another lesson, and go on with that")
        self._save_as()

    def _save_as(self) -> None:
        if not imgui.begin_popup(_SAVE_AS):
            return
        imgui.set_next_item_width(theme.points(_NAME))
        is_entered, self._name = imgui.input_text(NAME_LABEL, self._name, imgui.InputTextFlags_.enter_returns_true)
        theme.tooltip("What the file is called")
        imgui.same_line()
        if (imgui.button(KEEP_LABEL) or is_entered) and self._name.strip():
            self._dispatch(SaveLesson(self._name.strip()))
            imgui.close_current_popup()
        imgui.end_popup()

    def _history(self, view: EditorView, row: FlowRow) -> None:
        for label, words, action in ((UNDO_LABEL, view.undo, Undo()), (REDO_LABEL, view.redo, Redo())):
            imgui.begin_disabled(not words)
            row.place(theme.points(_ICON))
            if theme.icon_button(label, (theme.points(_ICON), 0)):
                self._dispatch(action)
            imgui.end_disabled()
            way, key = ("Take back", "Ctrl+Z") if action == Undo() else ("Do again", "Ctrl+Y")
            theme.tooltip(f"{way}: {words} ({key})" if words else f"Nothing to {way.lower()}")

    # --- grids -------------------------------------------------------------------------------------------------------

    def _grids(self, view: EditorView, row: FlowRow) -> None:
        """Which grid is shown, and what can be done with it."""
        row.place(theme.points(_GRIDS))
        imgui.set_next_item_width(theme.points(_GRIDS))
        names = [_grid_name(view, index) for index in range(len(view.page.grids))]
        shown = names[view.cursor.grid] if view.cursor.grid < len(names) else "no grid"
        is_open = imgui.begin_combo(GRIDS_LABEL, shown)
        if not is_open:
            theme.tooltip("The grids of the lesson: which one you see, new ones, variations, how often it is played")
            return
        for index, name in enumerate(names):
            if imgui.selectable(f"{name}##grid-{index}", index == view.cursor.grid)[0]:
                self._dispatch(PutCursor(Cursor(index, 0, 0, view.cursor.line)))
        imgui.separator()
        self._grid_menu(view)
        imgui.end_combo()

    def _grid_menu(self, view: EditorView) -> None:
        here, grid = view.cursor.grid, view.grid
        if imgui.selectable("New grid behind it", False)[0]:
            self._dispatch(Edit(AddGrid(_free_name(view), here)))
        if grid is not None and imgui.selectable("Variation of it", False)[0]:
            self._dispatch(Edit(AddGrid(_free_name(view), here, like=here)))
        if len(view.page.grids) > 1 and imgui.selectable("Take it away", False)[0]:
            self._dispatch(Edit(RemoveGrid(here)))
        if grid is not None:
            imgui.set_next_item_width(theme.points(_STEP))
            changed, times = imgui.input_int("times", grid.times)
            if changed and times >= 1:
                self._dispatch(Edit(SetKey(("grid", here, "times"), times), joins=True))

    # --- writing -----------------------------------------------------------------------------------------------------

    def _writing(self, view: EditorView, row: FlowRow) -> None:
        """How fine, and what a click writes."""
        row.place(theme.points(_STEP))
        imgui.set_next_item_width(theme.points(_STEP))
        steps = list(GridStep)
        changed, index = imgui.combo(STEP_LABEL, steps.index(view.step), [step.words for step in steps])
        theme.tooltip(
            "How fine you write: the cells a click and the arrows go by. Bars are cut finer where they must be"
        )
        if changed:
            self._dispatch(SetGridStep(steps[index]))
        row.place(theme.points(_LETTER))
        imgui.set_next_item_width(theme.points(_LETTER))
        letters = line_letters(view.cursor.line)
        letter = view.letter if view.letter in letters else usual_letter(view.cursor.line)
        if imgui.begin_combo(LETTER_LABEL, f"{letter}  {letters[letter]}", imgui.ComboFlags_.height_large):
            for each, words in letters.items():
                if imgui.selectable(f"{each}   {words}###brush {each}", each == letter)[0]:
                    self._dispatch(ChooseLetter(each))
            imgui.end_combo()
        theme.tooltip("What a click writes in this line; its letter on the keyboard writes it at the cursor")

    def _music(self, view: EditorView, row: FlowRow) -> None:
        if _button(row, BARS_LABEL):
            imgui.open_popup(_BARS)
        theme.tooltip("Bars: add, copy, take away; into how many cells their beats are cut")
        self._bars_menu(view)
        if _button(row, LINES_LABEL):
            imgui.open_popup(_LINES)
        theme.tooltip("A line for another piece, or a smaller kit; a right click on a line's name takes it away")
        self._lines_menu(view)
        self._take.gui(view, row)

    def _bars_menu(self, view: EditorView) -> None:
        if not imgui.begin_popup(_BARS):
            return
        here, bar = view.cursor.grid, view.cursor.bar
        last = bar if view.bars is None else view.bars.last
        if imgui.selectable("A bar behind this one", False)[0]:
            self._dispatch(Edit(AddBars(here, last + 1)))
        if imgui.selectable("A bar before this one", False)[0]:
            self._dispatch(Edit(AddBars(here, bar if view.bars is None else view.bars.first)))
        if imgui.selectable("Once more behind it (Ctrl+D)", False)[0]:
            self._dispatch(DuplicateBars())
        imgui.separator()
        for words, action in _CLIPBOARD:
            if imgui.selectable(words, False)[0]:
                self._dispatch(action)
        imgui.separator()
        if imgui.selectable("Take away (Ctrl+Del)", False)[0]:
            self._dispatch(RemoveSelection())
        self._cells_menus(view)
        imgui.end_popup()

    def _cells_menus(self, view: EditorView) -> None:
        """Into how many cells a beat or the bar is cut, of the cursor's line or of all."""
        if view.grid is None or view.cursor.bar >= view.grid.bar_count:
            return
        beats = bisect_right([start for start, _ in view.grid.frames[view.cursor.bar].spans], view.cursor.tick)
        line = view.cursor.line if isinstance(view.cursor.line, LineAt) else None
        imgui.separator()
        for beat, of in product((max(beats - 1, 0), None), (line, None) if line else (None,)):
            what = "The bar" if beat is None else f"Beat {beat + 1}"
            what += f" of {'all lines' if of is None else line_words(of)}"
            if imgui.begin_menu(f"{what}: cells"):
                for cells, words in CELLS.items():
                    if imgui.selectable(f"{cells}   {words}", False)[0]:
                        self._dispatch(Edit(CutBeat(view.cursor.grid, view.cursor.bar, beat, cells, of)))
                imgui.end_menu()

    def _lines_menu(self, view: EditorView) -> None:
        if not imgui.begin_popup(_LINES):
            return
        there = set() if view.grid is None else {line.piece for line in view.grid.lines}
        for piece in (piece for piece in LINE_ORDER if piece not in there):
            if imgui.selectable(f"{piece_name(piece)}##add-line", False)[0]:
                self._dispatch(Edit(AddLine(LineAt(view.cursor.grid, Piece(piece)))))
        imgui.separator()
        if imgui.begin_menu("Fold to a smaller kit"):
            self._fold_menu(view)
            imgui.end_menu()
        else:
            self._lacks = frozenset()
        imgui.end_popup()

    def _fold_menu(self, view: EditorView) -> None:
        """Which pieces of the lesson the smaller kit has; what stands on the others goes to the nearest."""
        pieces = {line.at.piece for grid in view.page.grids for line in grid.lines if isinstance(line.at, LineAt)}
        for piece in (piece for piece in LINE_ORDER if piece in pieces):
            if imgui.checkbox(f"{piece_name(piece)}##fold", piece not in self._lacks)[0]:
                self._lacks ^= {piece}
        stays = frozenset(pieces - self._lacks)
        imgui.begin_disabled(not stays or stays == pieces)
        if imgui.button(FOLD_LABEL):
            self._dispatch(Edit(Fold(stays)))
            imgui.close_current_popup()
        imgui.end_disabled()
        theme.tooltip("What is written for the other pieces goes to the nearest that is left, in all grids")


def _button(row: FlowRow, label: str) -> bool:
    """A button as wide as its words."""
    padding = 2 * imgui.get_style().frame_padding.x
    row.place(imgui.calc_text_size(label, True).x + padding)
    return bool(imgui.button(label))


def _grid_name(view: EditorView, index: int) -> str:
    grid = view.page.grids[index]
    name = grid.name or (f"grid {index + 1}" if len(view.page.grids) > 1 else "the grid")
    like = "" if grid.like is None else f", like {view.page.grids[grid.like].name or grid.like + 1}"
    return f"{name}{like}{f' x{grid.times}' if grid.times > 1 else ''}"


def _free_name(view: EditorView) -> str:
    """The first of A, B, C … that no grid is called."""
    taken = {grid.name for grid in view.page.grids}
    letters = [chr(ord("A") + index) for index in range(26)]
    return next((letter for letter in letters if letter not in taken), f"grid {len(taken) + 1}")
