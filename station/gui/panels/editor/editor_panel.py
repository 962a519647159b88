"""The editor's page: what can be done above; grid and notation, all words or the text below; the first fault under it.

Each part is a class or a function of its own that gets the view and the pixels it has.
"""

from collections.abc import Callable

from imgui_bundle import imgui

from station.app.actions.editor_actions import Edit, EditorAction
from station.app.editor.editor_view import EditorView
from station.app.window_state import State
from station.gui import theme
from station.gui.flat_canvas import FlatCanvas
from station.gui.panels.editor.editor_toolbar import EditorToolbar
from station.gui.panels.editor.grid_part import GridPart
from station.gui.panels.editor.notation_part import NotationPart
from station.gui.panels.editor.text_part import TextPart
from station.gui.panels.editor.words_part import WordsPart
from station.gui.widgets.page_height import PageHeight

EDITOR = "Editor"
MUSIC_LEAF, GRID_LEAF, NOTATION_LEAF = "Music##leaf", "Grid##leaf", "Notation##leaf"
WORDS_LEAF, TEXT_LEAF = "Words##leaf", "Text##leaf"
_LEAST_BESIDE, _LEAST_ABOVE = 900.0, 560.0
"""Design pixels: in a narrower page notation stands under the grid, and in one that is low too, each has a leaf of its
own (our choice: eight lines of the grid, or two of notation)."""
_GRID_SHARE = 0.5
"""The grid's share of the page beside or above the notation; beside it no more than it fills (our choice)."""

_LEAST_HIGH = 330.0
"""Design pixels (our choice: two lines of controls and five of the grid, so that a low window shows the drummer)."""
_BEGIN = "Click a cell to write the first stroke; Space plays, F1 explains the page."

_Leaf = Callable[[EditorView, tuple[float, float]], None]


class EditorPanel:
    """The page; `is_writing` says whether letters that are typed belong to the grid."""

    def __init__(self, dispatch: Callable[[EditorAction], None], canvas: FlatCanvas) -> None:
        self._dispatch = dispatch
        self.toolbar = EditorToolbar(dispatch)
        self.grid = GridPart(dispatch)
        self.notation = NotationPart(dispatch, canvas)
        self.words = WordsPart(dispatch)
        self.text = TextPart(lambda edit: dispatch(Edit(edit, joins=True)))
        self.is_writing = False
        self._height = PageHeight(_LEAST_HIGH)

    def gui(self, state: State) -> None:
        """Draw it and do what the user does in it."""
        self.is_writing = False
        view = state.editor
        if view is None:
            return
        self._height.fit()
        self.toolbar.gui(view)
        foot = self._foot_height(view)
        if imgui.begin_tab_bar("##editor-leaves"):
            for label, leaf in (*self._music_leaves(), (WORDS_LEAF, self.words.gui), (TEXT_LEAF, self.text.gui)):
                if imgui.begin_tab_item(label)[0]:
                    room = imgui.get_content_region_avail()
                    self.is_writing = label not in (WORDS_LEAF, TEXT_LEAF)
                    leaf(view, (room.x, max(room.y - foot, 1.0)))
                    imgui.end_tab_item()
            imgui.end_tab_bar()
        self._foot(view)

    def _music_leaves(self) -> "tuple[tuple[str, _Leaf], ...]":
        """Grid and notation on one leaf where there is room for both."""
        room = imgui.get_content_region_avail()
        if room.x >= theme.points(_LEAST_BESIDE) or room.y >= theme.points(_LEAST_ABOVE):
            return ((MUSIC_LEAF, self._music),)
        return (GRID_LEAF, self.grid.gui), (NOTATION_LEAF, self.notation.gui)

    def _music(self, view: EditorView, size: tuple[float, float]) -> None:
        """Grid and notation, side by side; in a narrow page one above the other."""
        (width, height), gap = size, imgui.get_style().item_spacing
        if width >= theme.points(_LEAST_BESIDE):
            across = self.grid.needed_width(view, (width - gap.x) * _GRID_SHARE)
            self.grid.gui(view, (across, height))
            imgui.same_line()
            self.notation.gui(view, (width - gap.x - across, height))
        else:
            high = (height - gap.y) * _GRID_SHARE
            self.grid.gui(view, (width, high))
            self.notation.gui(view, (width, height - gap.y - high))

    @staticmethod
    def _foot_height(view: EditorView) -> float:
        lines = 0 if view.is_sound else 1
        return lines * float(imgui.get_text_line_height_with_spacing())

    def _foot(self, view: EditorView) -> None:
        """The first fault of the text, and how many more there are; where nothing stands yet, how one begins."""
        if view.is_sound:
            return
        if view.is_blank:
            theme.soft(theme.one_line(_BEGIN, imgui.get_content_region_avail().x))
            return
        first, more = view.faults[0], len(view.faults) - 1
        words = f"{first.place}: {first.text}" if first.place else first.text
        words += f" (and {more} more)" if more else ""
        theme.warning(theme.one_line(words, imgui.get_content_region_avail().x))
        theme.tooltip("\n".join(f"{fault.place}: {fault.text}" for fault in view.faults[:10]))
