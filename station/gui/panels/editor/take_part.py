"""Playing a lesson in: the button that records, and how what is played is written."""

from collections.abc import Callable
from dataclasses import replace

from imgui_bundle import icons_fontawesome_4 as icons
from imgui_bundle import imgui

from station.app.actions.editor_actions import EditorAction, RecordTake, SetStepEntry, SetTakeOptions
from station.app.editor.editor_view import EditorView
from station.drills.editing.take_options import TakeOptions
from station.gui import theme
from station.gui.widgets.flow_row import FlowRow

RECORD_LABEL, STOP_LABEL = "Record###record", "Stop###record"
KIT_LABEL, POPUP = "Kit##editor", "##kit-menu"
STEP_LABEL = "a stroke writes at the cursor##step-entry"
OVER_LABEL, GUIDE_LABEL = "beside what stands there##over", "what stands there sounds##guide"
KEEP_LABEL = "the rest stays as timing##keeps"
CELLS_LABEL, STRENGTH_LABEL = "##quantise-cells", "##quantise-strength"
_CELLS = {1: "quarters", 2: "1/8", 3: "1/8 triplets", 4: "1/16", 6: "1/16 triplets", 8: "1/32"}
"""What is played is brought to so many cells a beat."""
_WIDE = 220.0
"""Design pixels of a control."""


class TakePart:
    """Keeps nothing; what the user does goes to `dispatch`."""

    def __init__(self, dispatch: Callable[[EditorAction], None]) -> None:
        self._dispatch = dispatch

    def gui(self, view: EditorView, row: FlowRow) -> None:
        """Draw the two buttons in the row, and what they open."""
        runs = view.take is not None
        label = f"{icons.ICON_FA_STOP} {STOP_LABEL}" if runs else f"{icons.ICON_FA_CIRCLE} {RECORD_LABEL}"
        padding = 2 * imgui.get_style().frame_padding.x
        row.place(imgui.calc_text_size(label, True).x + padding)
        if imgui.button(label):
            self._dispatch(RecordTake())
        starts = "Play on your kit over the click: the selected bars, else all, go round, and each pass is written"
        theme.tooltip("End the recording; what you have played of this pass is written too" if runs else starts)
        row.place(imgui.calc_text_size(KIT_LABEL, True).x + padding)
        if imgui.button(KIT_LABEL):
            imgui.open_popup(POPUP)
        theme.tooltip("Writing with your kit: step by step, or recorded; how it is brought to the grid")
        if imgui.begin_popup(POPUP):
            self._menu(view)
            imgui.end_popup()

    def _menu(self, view: EditorView) -> None:
        changed, on = imgui.checkbox(STEP_LABEL, view.step_entry)
        theme.tooltip("And the cursor goes a cell on; what is struck within 25 ms is written together")
        if changed:
            self._dispatch(SetStepEntry(on))
        theme.part("Recording")
        options = self._options(view.options)
        if options != view.options:
            self._dispatch(SetTakeOptions(options))

    def _options(self, options: TakeOptions) -> TakeOptions:
        quantise, names = options.quantise, list(_CELLS.values())
        imgui.set_next_item_width(theme.points(_WIDE))
        here = [*_CELLS].index(quantise.cells) if quantise.cells in _CELLS else names.index("1/16")
        changed, index = imgui.combo(CELLS_LABEL, here, [f"brought to {name}" for name in names])
        theme.tooltip("The cells that strokes go to; a grid that swings brings them to its swung ones")
        if changed:
            quantise = replace(quantise, cells=[*_CELLS][index])
        imgui.set_next_item_width(theme.points(_WIDE))
        moved, percent = theme.slider_int(STRENGTH_LABEL, round(quantise.strength * 100), 0, 100, "strength %d %%")
        theme.tooltip("How much of the way to its cell a stroke goes, where the rest is kept")
        if moved:
            quantise = replace(quantise, strength=percent / 100)
        keeps = imgui.checkbox(KEEP_LABEL, quantise.keeps_timing)[1]
        theme.tooltip("Each stroke keeps how early or late it was; else it stands on its cell")
        over = imgui.checkbox(OVER_LABEL, options.over)[1]
        theme.tooltip("Overdub: pass by pass what you play is added. Without it each pass takes the place of the last")
        guide = imgui.checkbox(GUIDE_LABEL, options.guide)[1]
        theme.tooltip("Hear the bars as they are written while you play")
        return TakeOptions(replace(quantise, keeps_timing=keeps), over, guide)
