"""The figure panel: how the demonstrator moves, control by control, in eight slots, and over the bars.

A view over `FigureOptions`; what it changes moves the demonstrator from the next picture on. What was set last is
written to the settings when the mouse is let go, never while somebody plays.
"""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
from imgui_bundle import imgui

from station.app import theme
from station.app.figure_controls import TABS, WORD_LABELS, Control, Group
from station.app.figure_options import PIECES, FigureOptions
from station.app.model import PracticeModel, Stage
from station.app.panels.lanes import LanesEditor
from station.app.style_shelf import Entry, StyleShelf
from station.core.names import name_of
from station.core.settings import load_settings, save_settings
from station.motion.hand_notes import Hands
from station.motion.plan import bar_places
from station.motion.propose import propose_style
from station.motion.style import HOLDS, WORDS, Style, range_of
from station.motion.style_file import SLOTS

FIGURE = "Figure"
ABOUT = "How the demonstrator moves: arms, head, body, hands, over the bars; styles of your own"
PROPOSE_LABEL = "From the score##propose"
SAVE_LABEL = "Save##save-style"
FREE_LABEL = "each for itself"
BARS_TAB = "Bars"
_LABEL_WIDTH, _VALUE_WIDTH, _SMALL, _BESIDE, _SLOTS_FROM, _SLOT_GAP = 112, 38, 28, 150, 60, 4
"""Design pixels."""
_LEADS = {
    Hands.RIGHT: ("Right-handed", "The right hand leads, over the left on the hi-hat"),
    Hands.LEFT: ("Left-handed", "The kit stands mirrored and the left hand leads; stickings change sides"),
    Hands.OPEN: ("Open-handed", "A right-handed kit whose hi-hat the left hand plays, uncrossed"),
}

Tried = Callable[[Callable[[], object]], None]
"""Does something, or says in one line why it could not be done."""


class FigurePanel:
    """The panel over one model; `settings` is the file that keeps what was set, None for this user's."""

    def __init__(self, model: PracticeModel, settings: Path | None, tried: Tried, preview: Callable[[], None]) -> None:
        self._model = model
        self._settings = settings
        self._tried = tried
        self._preview = preview
        kept = load_settings(settings)
        self._shelf = StyleShelf(kept.styles_dir)
        self._source: str | None = kept.style
        self.options = FigureOptions(model.demonstrator().style)
        self._kept = self.options.style
        self._lanes = LanesEditor(self.options)
        self._entries: list[Entry] = []
        self._name = ""
        self._opens_bars = False
        tried(self._load_slots)

    def gui(self) -> None:
        """Draw the panel and do what the user does in it."""
        before = self.options.style
        self._styles()
        self._slots()
        if _tabs():
            for tab in TABS:
                if _tab(tab.title):
                    if tab is TABS[0]:
                        self._constraint()
                    for group in tab.groups:
                        self._group(group)
                    imgui.end_tab_item()
            if _tab("Hands"):
                self._hands()
                imgui.end_tab_item()
            if _tab("Pieces"):
                self._pieces()
                imgui.end_tab_item()
            opens, self._opens_bars = self._opens_bars, False
            if _tab(BARS_TAB, opens):
                self._lanes.gui(self._model.score(), self._place())
                imgui.end_tab_item()
            imgui.end_tab_bar()
        if self.options.style is not before:
            self._model.move_as(self.options.style)

    def _place(self) -> float | None:
        """Where the music is, in bars from 1; None where none is played or shown."""
        clock, deck, score = self._model.room().clock, self._model.deck, self._model.score()
        if clock is not None and clock.bar is not None and clock.beat is not None:
            return clock.bar + (clock.beat - 1) / score.tempo_map.meters[0].beats
        if clock is not None or not deck.is_shown:
            return None
        tick = deck.player.song.tick_at(deck.player.position_ns(deck.now_ns))
        return float(bar_places(score, np.array([tick]))[0])

    def keep(self) -> None:
        """Write to the settings what was changed since the last time, unless a control is being moved."""
        style = self.options.style
        if style is self._kept or imgui.is_any_item_active():
            return
        self._kept = style
        self._tried(lambda: self._write(style))

    def _write(self, style: Style) -> None:
        source = self._source
        if source is None or self.options.is_changed:
            source = self._shelf.keep(style)
        save_settings(replace(load_settings(self._settings), style=source), self._settings)

    # --- styles and slots ---------------------------------------------------------------------------------------------

    def _styles(self) -> None:
        options, narrow = self.options, theme.is_narrow()
        beside = -1.0 if narrow else -theme.points(_BESIDE)
        imgui.set_next_item_width(beside)
        shown = f"{options.style.name}, changed" if options.is_changed else options.style.name
        if imgui.begin_combo("##style", shown):
            self._list()
            imgui.end_combo()
        theme.tooltip("Styles: five settings of the thesis, five of its users' genres, the natural one, and your own")
        if not narrow:
            imgui.same_line()
        if imgui.button(PROPOSE_LABEL, imgui.ImVec2(-1, 0)):
            self._choose(propose_style(self._model.score()), None)
        theme.tooltip("A style that the lesson's tempo, density and dynamics ask for")
        imgui.set_next_item_width(beside)
        _, self._name = imgui.input_text_with_hint("##style-name", "a name of your own", self._name)
        theme.tooltip(f"Saved styles are files in {self._shelf.folder}")
        if not narrow:
            imgui.same_line()
        half = (imgui.get_content_region_avail().x - imgui.get_style().item_spacing.x) / 2
        if imgui.button(SAVE_LABEL, imgui.ImVec2(half, 0)):
            self._tried(self._save)
        theme.tooltip("Save what is set as a style of your own: `station animate --style FILE` takes it too")
        imgui.same_line()
        imgui.begin_disabled(not options.is_changed)
        if imgui.button("Reset##all", imgui.ImVec2(-1, 0)):
            self._choose(options.base, self._source)
        imgui.end_disabled()
        theme.tooltip("Every control back to the style that was chosen")

    def _list(self) -> None:
        if imgui.is_window_appearing():
            self._entries = self._shelf.entries()
        for entry in self._entries:
            label = f"{entry.label}##{entry.source}"
            if imgui.selectable(f"your own: {label}" if entry.is_own else label, entry.source == self._source)[0]:
                self._tried(lambda entry=entry: self._take(entry))  # type: ignore[misc] # mypy knows no such default

    def _take(self, entry: Entry) -> None:
        self._choose(self._shelf.load(entry.source), entry.source)

    def _choose(self, style: Style, source: str | None) -> None:
        self.options.choose(style)
        self._source = source

    def _save(self) -> None:
        entry = self._shelf.save(self.options.style, self._name)
        self._choose(replace(self.options.style, name=entry.label), entry.source)

    def _load_slots(self) -> None:
        self.options.slots = self._shelf.slots()

    def _slots(self) -> None:
        slots, gap, narrow = self.options.slots.styles, theme.points(_SLOT_GAP), theme.is_narrow()
        a_row = SLOTS // 2 if narrow else SLOTS
        left = 0.0 if narrow else theme.points(_SLOTS_FROM)
        width = max((imgui.get_content_region_avail().x - left - (a_row - 1) * gap) / a_row, 1.0)
        edge = imgui.get_cursor_pos_x()
        for words, does in (("Take", "take"), ("Keep as", "keep")):
            imgui.align_text_to_frame_padding()
            imgui.text_disabled(words)
            for slot, style in enumerate(slots):
                if slot % a_row:
                    imgui.same_line(0, gap)
                elif not narrow:
                    imgui.same_line(edge + left)
                imgui.begin_disabled(does == "take" and style is None)
                if imgui.button(f"{slot + 1}##{does}{slot + 1}", imgui.ImVec2(width, 0)):
                    self._use_slot(does, slot)
                imgui.end_disabled()
                kept = "is empty" if style is None else f"holds {style.name}"
                theme.tooltip(f"{words} slot {slot + 1}, which {kept}")

    def _use_slot(self, does: str, slot: int) -> None:
        if does == "take":
            self.options.recall(slot)
            self._source = None
            return
        self.options.store(slot, self._name.strip())
        self._tried(lambda: self._shelf.keep_slots(self.options.slots))

    # --- controls -----------------------------------------------------------------------------------------------------

    def _constraint(self) -> None:
        changed, free = imgui.checkbox(FREE_LABEL, self.options.unconstrained)
        if changed:
            self.options.constrain(not free)
        theme.tooltip("Off: wrist, elbow and shoulder share the gain, and one's gain is the others' loss")

    def _group(self, group: Group) -> None:
        imgui.separator_text(group.title)
        for control in group.controls:
            self._number(control)

    def _number(self, control: Control) -> None:
        """A slider between its label and its value, what resets it, and what lets it change over the bars."""
        options, name = self.options, control.name
        factor, has_lane, narrow = options.factor(name), options.lane(name) is not None, theme.is_narrow()
        gap, small = imgui.get_style().item_spacing.x, theme.points(_SMALL)
        label = control.label if factor is None or has_lane else f"{control.label} ×{factor:.1f}"
        value = "in bars" if has_lane else control.form % options.value(name)
        imgui.align_text_to_frame_padding()
        imgui.text(label)
        imgui.same_line(0 if narrow else theme.points(_LABEL_WIDTH))
        if narrow:
            imgui.text_disabled(value)
        value_width = 0.0 if narrow else theme.points(_VALUE_WIDTH) + gap
        imgui.set_next_item_width(-value_width - 2 * (small + gap))
        flags = imgui.SliderFlags_.always_clamp | imgui.SliderFlags_.no_round_to_format
        if control.is_curved:
            flags |= imgui.SliderFlags_.logarithmic
        imgui.begin_disabled(has_lane)
        moved, wanted = imgui.slider_float(f"##{name}", options.value(name), *range_of(name), "", flags)
        imgui.end_disabled()
        if moved:
            options.put(name, round(wanted, 2))
        theme.tooltip(f"{control.about}. Ctrl+click to type")
        imgui.same_line()
        if not narrow:
            edge = imgui.get_cursor_pos_x()
            imgui.text_disabled(value)
            imgui.same_line(edge + value_width)
        self._beside(name, small)

    def _beside(self, name: str, width: float) -> None:
        """What sets a control back, and what lets it change over the bars."""
        imgui.begin_disabled(not self.options.can_reset(name))
        if imgui.button(f"×##reset-{name}", imgui.ImVec2(width, 0)):
            self.options.reset(name)
        imgui.end_disabled()
        theme.tooltip("Back to the style that was chosen")
        imgui.same_line()
        if imgui.button(f"~##bars-{name}", imgui.ImVec2(width, 0)):
            self._lanes.control = name
            self._opens_bars = True
        theme.tooltip("Let it change over the bars")

    def _pieces(self) -> None:
        theme.soft("How large the strokes on one piece are, beside the arm's amplitude.")
        for name in PIECES:
            words = name_of(name)
            self._number(Control(name, words, f"Strokes on the {words}"))

    def _hands(self) -> None:
        playing = self._model.room().stage is Stage.PLAYING
        imgui.separator_text("Who leads")
        imgui.begin_disabled(playing)
        for hands, (words, about) in _LEADS.items():
            if imgui.radio_button(f"{words}##lead", self._model.hands() is hands):
                self._tried(lambda hands=hands: self._lead(hands))  # type: ignore[misc] # mypy knows no such default
            theme.tooltip(f"{about}. It holds for what you are asked to play too")
        imgui.end_disabled()
        imgui.separator_text("Hands and feet")
        for name, (label, about) in WORD_LABELS.items():
            imgui.begin_disabled(playing and name in HOLDS)
            self._word(name, label, about)
            imgui.end_disabled()
        imgui.set_next_item_width(theme.points(180))
        sown, seed = imgui.input_int("chance##seed", self.options.style.seed)
        if sown:
            self.options.sow(seed)
        theme.tooltip("Another number, other blinks, looks and spun sticks; the same number, the same ones")

    def _word(self, name: str, label: str, about: str) -> None:
        imgui.set_next_item_width(theme.points(180))
        words = list(WORDS[name])
        changed, index = imgui.combo(f"{label}##{name}", words.index(getattr(self.options.style, name)), words)
        if changed:
            self.options.say(name, words[index])
        theme.tooltip(about)

    def _lead(self, hands: Hands) -> None:
        self._model.lead_with(hands)
        save_settings(replace(load_settings(self._settings), hands=hands.value), self._settings)
        self._preview()


def _tabs() -> bool:
    """Begin the bar of narrow tabs; returns whether it is seen."""
    imgui.push_style_var(imgui.StyleVar_.frame_padding, _narrow())
    narrow = imgui.TabBarFlags_.fitting_policy_scroll | imgui.TabBarFlags_.tab_list_popup_button
    flags = narrow if theme.is_narrow() else imgui.TabBarFlags_.fitting_policy_shrink
    seen = imgui.begin_tab_bar("##figure", flags)
    imgui.pop_style_var()
    return bool(seen)


def _narrow() -> imgui.ImVec2:
    return imgui.ImVec2(theme.points(6), theme.points(7))


def _tab(title: str, opens: bool = False) -> bool:
    """Begin a narrow tab, which comes to the front if it `opens`; returns whether it is in front."""
    imgui.push_style_var(imgui.StyleVar_.frame_padding, _narrow())
    front, _ = imgui.begin_tab_item(title, None, imgui.TabItemFlags_.set_selected if opens else 0)
    imgui.pop_style_var()
    return bool(front)
