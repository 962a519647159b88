"""The head of the figure panel: which style, one proposed from the score, styles of the user's own, the eight slots."""

from collections.abc import Callable
from functools import partial

from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.style_actions import KeepSlot, ListStyles, LoadStyle, ProposeStyle, SaveStyle
from station.app.style.style_options import StyleOptions
from station.app.style_editor import StyleView
from station.gui import theme
from station.gui.widgets.slots import Grid, Use, slot_rows
from station.motion.style.style_file import SLOTS

PROPOSE_LABEL = "From the score##propose"
SAVE_LABEL = "Save##save-style"
_BESIDE, _SLOTS_FROM, _SLOT_GAP = 150, 60, 4
"""Design pixels."""


class StylesHead:
    """Draws it; what the user does goes to `dispatch`."""

    def __init__(self, dispatch: Callable[[Action], None]) -> None:
        self._dispatch = dispatch
        self._name = ""

    def gui(self, view: StyleView) -> StyleOptions:
        """Draw it and do what the user does in it; returns the options as they were reset or taken from a slot."""
        narrow = theme.is_narrow()
        imgui.set_next_item_width(-1.0 if narrow else -theme.points(_BESIDE))
        self._list(view)
        if not narrow:
            imgui.same_line()
        if imgui.button(PROPOSE_LABEL, imgui.ImVec2(-1, 0)):
            self._dispatch(ProposeStyle())
        theme.tooltip("A style that the lesson's tempo, density and dynamics ask for")
        imgui.set_next_item_width(-1.0 if narrow else -theme.points(_BESIDE))
        _, self._name = imgui.input_text_with_hint("##style-name", "a new name", self._name)
        theme.tooltip(f"Saved styles are files in {view.folder}")
        if not narrow:
            imgui.same_line()
        options = self._save_and_reset(view.options)
        return self._slots(options, narrow)

    # --- styles -------------------------------------------------------------------------------------------------------

    def _list(self, view: StyleView) -> None:
        options = view.options
        if imgui.begin_combo("##style", f"{options.style.name}, changed" if options.is_changed else options.style.name):
            if imgui.is_window_appearing():
                self._dispatch(ListStyles())
            for entry in view.entries:
                label = f"{entry.label}##{entry.source}"
                if imgui.selectable(f"your own: {label}" if entry.is_own else label, entry.source == view.source)[0]:
                    self._dispatch(LoadStyle(entry.source))
            imgui.end_combo()
        theme.tooltip("Styles: five settings of the thesis, five of its users' genres, the natural one, and your own")

    def _save_and_reset(self, options: StyleOptions) -> StyleOptions:
        half = (imgui.get_content_region_avail().x - imgui.get_style().item_spacing.x) / 2
        if imgui.button(SAVE_LABEL, imgui.ImVec2(half, 0)):
            self._dispatch(SaveStyle(self._name))
        theme.tooltip("Save what is set as a style of your own: `station animate --style FILE` takes it too")
        imgui.same_line()
        imgui.begin_disabled(not options.is_changed)
        if imgui.button("Reset##all", imgui.ImVec2(-1, 0)):
            options = options.choose(options.base)
        imgui.end_disabled()
        theme.tooltip("Every control back to the style that was chosen")
        return options

    def _slots(self, options: StyleOptions, narrow: bool) -> StyleOptions:
        gap, a_row = theme.points(_SLOT_GAP), SLOTS // 2 if narrow else SLOTS
        left = 0.0 if narrow else theme.points(_SLOTS_FROM)
        width = max((imgui.get_content_region_avail().x - left - (a_row - 1) * gap) / a_row, 1.0)
        styles = options.slots.styles
        taken: list[int] = []

        def tip(words: str, slot: int) -> str:
            held = styles[slot]
            return f"{words} slot {slot + 1}, which {'is empty' if held is None else f'holds {held.name}'}"

        uses = (
            Use("Take", "take", taken.append, partial(tip, "Take"), needs_filled=True),
            Use("Keep as", "keep", self._keep_slot, partial(tip, "Keep as")),
        )
        slot_rows(uses, [style is not None for style in styles], Grid(left, width, a_row, gap))
        return options.recall(taken[0]) if taken else options

    def _keep_slot(self, slot: int) -> None:
        self._dispatch(KeepSlot(slot, self._name.strip()))
