"""The head of the figure panel: which style, one proposed from the score, styles of the user's own, the eight slots.

It also knows where the style that is set came from, and keeps it: in the settings by its name or file.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path

from imgui_bundle import imgui

from station.app.style_library import StyleEntry, StyleLibrary
from station.app.style_options import StyleOptions
from station.core.settings import load_settings, save_settings
from station.gui import theme
from station.gui.widgets.slots import Grid, Use, slot_rows
from station.motion.style.proposal import propose_style
from station.motion.style.style import Style
from station.motion.style.style_file import SLOTS
from station.music.score import Score

PROPOSE_LABEL = "From the score##propose"
SAVE_LABEL = "Save##save-style"
_BESIDE, _SLOTS_FROM, _SLOT_GAP = 150, 60, 4
"""Design pixels."""

Tried = Callable[[Callable[[], object]], None]
"""Does something, or says in one line why it could not be done."""


class StylesHead:
    """Styles and slots of `options`; `settings` is the file that keeps what was set, None for this user's."""

    def __init__(self, options: StyleOptions, settings: Path | None, tried: Tried) -> None:
        self._options = options
        self._settings = settings
        self._tried = tried
        kept = load_settings(settings)
        self._shelf = StyleLibrary(kept.styles_dir)
        self._source: str | None = kept.style
        self._kept = options.style
        self._entries: list[StyleEntry] = []
        self._name = ""
        tried(self._load_slots)

    def gui(self, score: Score) -> None:
        """Draw it and do what the user does in it; `score` is what a style is proposed for."""
        narrow = theme.is_narrow()
        imgui.set_next_item_width(-1.0 if narrow else -theme.points(_BESIDE))
        self._list()
        if not narrow:
            imgui.same_line()
        if imgui.button(PROPOSE_LABEL, imgui.ImVec2(-1, 0)):
            self._choose(propose_style(score), None)
        theme.tooltip("A style that the lesson's tempo, density and dynamics ask for")
        imgui.set_next_item_width(-1.0 if narrow else -theme.points(_BESIDE))
        _, self._name = imgui.input_text_with_hint("##style-name", "a new name", self._name)
        theme.tooltip(f"Saved styles are files in {self._shelf.folder}")
        if not narrow:
            imgui.same_line()
        self._save_and_reset()
        self._slots(narrow)

    def keep(self) -> None:
        """Write to the settings what was changed since the last time, unless a control is being moved."""
        style = self._options.style
        if style is self._kept or imgui.is_any_item_active():
            return
        self._kept = style
        self._tried(lambda: self._write(style))

    def _write(self, style: Style) -> None:
        source = self._source
        if source is None or self._options.is_changed:
            source = self._shelf.keep(style)
        save_settings(replace(load_settings(self._settings), style=source), self._settings)

    # --- styles -------------------------------------------------------------------------------------------------------

    def _list(self) -> None:
        options = self._options
        if imgui.begin_combo("##style", f"{options.style.name}, changed" if options.is_changed else options.style.name):
            if imgui.is_window_appearing():
                self._entries = self._shelf.entries()
            for entry in self._entries:
                label = f"{entry.label}##{entry.source}"
                if imgui.selectable(f"your own: {label}" if entry.is_own else label, entry.source == self._source)[0]:
                    self._tried(lambda entry=entry: self._take(entry))  # type: ignore[misc] # mypy knows no such default
            imgui.end_combo()
        theme.tooltip("Styles: five settings of the thesis, five of its users' genres, the natural one, and your own")

    def _save_and_reset(self) -> None:
        half = (imgui.get_content_region_avail().x - imgui.get_style().item_spacing.x) / 2
        if imgui.button(SAVE_LABEL, imgui.ImVec2(half, 0)):
            self._tried(self._save)
        theme.tooltip("Save what is set as a style of your own: `station animate --style FILE` takes it too")
        imgui.same_line()
        imgui.begin_disabled(not self._options.is_changed)
        if imgui.button("Reset##all", imgui.ImVec2(-1, 0)):
            self._choose(self._options.base, self._source)
        imgui.end_disabled()
        theme.tooltip("Every control back to the style that was chosen")

    def _take(self, entry: StyleEntry) -> None:
        self._choose(self._shelf.load(entry.source), entry.source)

    def _choose(self, style: Style, source: str | None) -> None:
        self._options.choose(style)
        self._source = source

    def _save(self) -> None:
        entry = self._shelf.save(self._options.style, self._name)
        self._choose(replace(self._options.style, name=entry.label), entry.source)

    # --- slots --------------------------------------------------------------------------------------------------------

    def _load_slots(self) -> None:
        self._options.slots = self._shelf.slots()

    def _slots(self, narrow: bool) -> None:
        gap, a_row = theme.points(_SLOT_GAP), SLOTS // 2 if narrow else SLOTS
        left = 0.0 if narrow else theme.points(_SLOTS_FROM)
        width = max((imgui.get_content_region_avail().x - left - (a_row - 1) * gap) / a_row, 1.0)
        styles = self._options.slots.styles

        def told(words: str, slot: int) -> str:
            held = styles[slot]
            return f"{words} slot {slot + 1}, which {'is empty' if held is None else f'holds {held.name}'}"

        uses = (
            Use("Take", "take", self._recall, partial(told, "Take"), needs_filled=True),
            Use("Keep as", "keep", self._store, partial(told, "Keep as")),
        )
        slot_rows(uses, [style is not None for style in styles], Grid(left, width, a_row, gap))

    def _recall(self, slot: int) -> None:
        self._options.recall(slot)
        self._source = None

    def _store(self, slot: int) -> None:
        def keep() -> None:
            self._load_slots()  # a file that cannot be read is told, and not written over
            self._options.store(slot, self._name.strip())
            self._shelf.keep_slots(self._options.slots)

        self._tried(keep)
