"""The figure panel: how the demonstrator moves, control by control, in eight slots, and over the bars.

What it changes moves the demonstrator from the next picture on.
"""

from collections.abc import Callable, Mapping

import numpy as np
from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.settings_actions import Embody, LeadWith, PutUp
from station.app.actions.style_actions import EditStyle
from station.app.room_state import Stage
from station.app.style.style_controls import TABS, WORD_LABELS, Control, ControlGroup
from station.app.style.style_options import PIECES, StyleOptions
from station.app.window_state import State
from station.core.labels import name_of
from station.gui import theme
from station.gui.panels.figure.lanes_editor import LanesEditor
from station.gui.panels.figure.styles_head import StylesHead
from station.motion.kinematics.figure import figure_names, load_figure
from station.motion.kit.kit import kit_names, load_kit
from station.motion.motion_plan import bar_places
from station.motion.sticking.hand_notes import Hands
from station.motion.style.style import HOLDS, WORDS, range_of

FIGURE = "Figure"
ABOUT = "How the demonstrator moves: arms, head, body, hands, over the bars; styles of your own"
HELP = (
    "Sliders change how the drummer moves at once: let the demonstration play meanwhile (W). × beside a control goes"
    " back to the style that was chosen, ~ lets it change over the bars, where its line can be drawn. The gain moves"
    " wrist, elbow and shoulder together; each has a share, and one's gain is the others' loss unless each is set for"
    " itself. Save makes a style of your own, a file; eight slots keep what you want at hand. Whose hand leads holds"
    " for what you are asked to play too."
)
FREE_LABEL = "each joint on its own"
_MORE_TABS = HANDS_TAB, PIECES_TAB, BARS_TAB = "Hands", "Pieces", "Bars"
_LABEL_WIDTH, _VALUE_WIDTH, _WORD_WIDTH, _SMALL = 112, 38, 180, 28
"""Design pixels."""
_LEADS = {
    Hands.RIGHT: ("Right-handed", "The right hand leads, over the left on the hi-hat"),
    Hands.LEFT: ("Left-handed", "The kit stands mirrored and the left hand leads; stickings change sides"),
    Hands.OPEN: ("Open-handed", "A right-handed kit whose hi-hat the left hand plays, uncrossed"),
}
_KITS = {"": "as the lesson says", **{name: load_kit(name).title for name in kit_names()}}
_DRUMMERS = {
    "": "as the style says",
    **{name: f"{name}, {100 * load_figure(name).stature_m:.0f} cm" for name in figure_names()},
}


class StylePanel:
    """The panel; what the user does goes to `dispatch`."""

    def __init__(self, dispatch: Callable[[Action], None]) -> None:
        self._dispatch = dispatch
        self._head = StylesHead(dispatch)
        self.lanes = LanesEditor()
        self._opens_bars = False
        self._is_held = False

    def gui(self, state: State) -> None:
        """Draw the panel and do what the user does in it."""
        options = self._head.gui(state.style)
        if _tabs():
            for tab in TABS:
                if _tab(tab.title):
                    if tab is TABS[0]:
                        options = self._constraint(options)
                    for group in tab.groups:
                        options = self._group(options, group)
                    imgui.end_tab_item()
            if _tab(HANDS_TAB):
                options = self._hands(options, state)
                imgui.end_tab_item()
            if _tab(PIECES_TAB):
                options = self._pieces(options)
                imgui.end_tab_item()
            opens, self._opens_bars = self._opens_bars, False
            if _tab(BARS_TAB, opens):
                options = self.lanes.gui(options, state.score, _place(state))
                imgui.end_tab_item()
            imgui.end_tab_bar()
        self._edit(state.style.options, options)

    def _edit(self, before: StyleOptions, options: StyleOptions) -> None:
        """Hand over what was changed, and say when the control that changes it is let go."""
        is_held = bool(imgui.is_any_item_active())
        if options is not before or (self._is_held and not is_held):
            self._dispatch(EditStyle(options, is_held))
            self._is_held = is_held

    # --- controls -----------------------------------------------------------------------------------------------------

    @staticmethod
    def _constraint(options: StyleOptions) -> StyleOptions:
        changed, free = imgui.checkbox(FREE_LABEL, options.unconstrained)
        theme.tooltip("Off: wrist, elbow and shoulder share the gain, and one's gain is the others' loss")
        return options.constrain(not free) if changed else options

    def _group(self, options: StyleOptions, group: ControlGroup) -> StyleOptions:
        theme.part(group.title)
        for control in group.controls:
            options = self._number(options, control)
        return options

    def _number(self, options: StyleOptions, control: Control) -> StyleOptions:
        """A slider between its label and its value, what resets it, and what lets it change over the bars."""
        name = control.name
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
            options = options.put(name, round(wanted, 2))
        theme.tooltip(f"{control.about}. Ctrl+click to type")
        imgui.same_line()
        if not narrow:
            edge = imgui.get_cursor_pos_x()
            imgui.text_disabled(value)
            imgui.same_line(edge + value_width)
        return self._beside(options, name, small)

    def _beside(self, options: StyleOptions, name: str, width: float) -> StyleOptions:
        """What sets a control back, and what lets it change over the bars."""
        imgui.begin_disabled(not options.can_reset(name))
        if imgui.button(f"×##reset-{name}", imgui.ImVec2(width, 0)):
            options = options.reset(name)
        imgui.end_disabled()
        theme.tooltip("Back to the style that was chosen")
        imgui.same_line()
        if imgui.button(f"~##bars-{name}", imgui.ImVec2(width, 0)):
            self.lanes.control = name
            self._opens_bars = True
        theme.tooltip("Let it change over the bars")
        return options

    def _pieces(self, options: StyleOptions) -> StyleOptions:
        theme.soft("How large the strokes on one piece are, beside the arm's amplitude.")
        for name in PIECES:
            words = name_of(name)
            options = self._number(options, Control(name, words, f"Strokes on the {words}"))
        return options

    def _hands(self, options: StyleOptions, state: State) -> StyleOptions:
        playing = state.room.stage is Stage.PLAYING
        waits = "; not while a pass is played" if playing else ""
        imgui.separator_text("Who plays")
        imgui.begin_disabled(playing)
        for hands, (words, about) in _LEADS.items():
            if imgui.radio_button(f"{words}##lead", state.hands is hands):
                self._dispatch(LeadWith(hands))
            theme.tooltip(f"{about}. It holds for what you are asked to play too{waits}")
        self._one_of("drummer##body", _DRUMMERS, state.style.figure, Embody)
        theme.tooltip(f"Who plays: how they are built, and what they wear{waits}")
        self._one_of("kit##stands", _KITS, state.settings.stands, PutUp)
        theme.tooltip(f"The kit before the demonstrator, as your own stands before you{waits}")
        imgui.end_disabled()
        imgui.separator_text("Hands and feet")
        for name, (label, about) in WORD_LABELS.items():
            imgui.begin_disabled(playing and name in HOLDS)
            options = _word(options, name, label, about + (waits if name in HOLDS else ""))
            imgui.end_disabled()
        imgui.set_next_item_width(theme.points(_WORD_WIDTH))
        sown, seed = imgui.input_int("chance##seed", options.style.seed)
        theme.tooltip("Another number, other blinks, looks and spun sticks; the same number, the same ones")
        return options.sow(seed) if sown else options

    def _one_of(self, label: str, titles: Mapping[str, str], chosen: str, choose: type[PutUp] | type[Embody]) -> None:
        """A list of names by their titles; what is picked is asked for."""
        imgui.set_next_item_width(theme.points(_WORD_WIDTH))
        if imgui.begin_combo(label, titles.get(chosen, chosen)):
            for name, title in titles.items():
                if imgui.selectable(f"{title}##{name}", name == chosen)[0]:
                    self._dispatch(choose(name))
            imgui.end_combo()


def _word(options: StyleOptions, name: str, label: str, about: str) -> StyleOptions:
    imgui.set_next_item_width(theme.points(_WORD_WIDTH))
    words = list(WORDS[name])
    changed, index = imgui.combo(f"{label}##{name}", words.index(getattr(options.style, name)), words)
    theme.tooltip(about)
    return options.say(name, words[index]) if changed else options


def _place(state: State) -> float | None:
    """Where the music is, in bars from 1; None where none is played or shown."""
    clock, score = state.room.clock, state.score
    if clock is not None and clock.bar is not None and clock.beat is not None:
        return clock.bar + (clock.beat - 1) / score.tempo_map.meters[0].beats
    if clock is not None or not state.player.is_shown:
        return None
    tick = state.player.player.song.tick_at(state.player.position_ns)
    return float(bar_places(score, np.array([tick]))[0])


def _tabs() -> bool:
    """Begin the bar of narrow tabs, which scroll where not all have room; returns whether it is seen."""
    fits = _width_of_tabs() <= imgui.get_content_region_avail().x
    scrolls = imgui.TabBarFlags_.fitting_policy_scroll | imgui.TabBarFlags_.tab_list_popup_button
    imgui.push_style_var(imgui.StyleVar_.frame_padding, _narrow())
    seen = imgui.begin_tab_bar("##figure", imgui.TabBarFlags_.fitting_policy_shrink if fits else scrolls)
    imgui.pop_style_var()
    return bool(seen)


def _width_of_tabs() -> float:
    """Pixels of all tabs side by side."""
    titles = [*(tab.title for tab in TABS), *_MORE_TABS]
    each = 2 * _narrow().x + imgui.get_style().item_inner_spacing.x
    return float(sum(imgui.calc_text_size(title).x for title in titles) + len(titles) * each)


def _narrow() -> imgui.ImVec2:
    """What stands round a tab's words: less in a narrow panel."""
    return imgui.ImVec2(theme.points(3 if theme.is_narrow() else 6), theme.points(7))


def _tab(title: str, opens: bool = False) -> bool:
    """Begin a narrow tab, which comes to the front if it `opens`; returns whether it is in front."""
    imgui.push_style_var(imgui.StyleVar_.frame_padding, _narrow())
    front, _ = imgui.begin_tab_item(title, None, imgui.TabItemFlags_.set_selected if opens else 0)
    imgui.pop_style_var()
    return bool(front)
