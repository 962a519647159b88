"""The practice panel: how sessions begin, wait, pause and end; what pauses is learnt from the kit."""

from collections.abc import Callable
from dataclasses import replace

from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.practice_actions import Select
from station.app.actions.settings_actions import LearnPause, SetPreferences
from station.app.selection import Selection
from station.app.settings.preferences import PracticePreferences, pause_in_words
from station.app.window_state import State
from station.gui import theme
from station.practice.book.book_words import rise_words
from station.practice.session.rising_tempo import Rise

PRACTICE = "Practice"
ABOUT = "What starts and pauses a session, whether it waits for you, what you are asked"
HELP = (
    "Ticks hold from now on and are kept. To pause by a gesture of your own press Learn, then strike two pads at once"
    " or press a foot switch; the same gesture goes on. Two pads that a lesson wants nearly at once never pause in it."
)
LEARN_LABEL, GIVE_UP_LABEL = "Learn from the kit##learn", "Give up##learn"
_STEPS = ((2, 4), (4, 4), (5, 8), (10, 8))
"""Beats a minute and bars (our choice): hardly felt, a step of TEACHING's ladder, brisk, a dare."""
_TICKS = (
    (
        "kicks_start",
        "the kit starts",
        "Two kicks that stand alone do what Enter does, and a pad begins what comes next beside a result",
    ),
    (
        "auto_pause",
        "wait when I stop",
        "After two silent bars that have notes the score waits for you",
    ),
    (
        "pads_switch",
        "the kit asks who plays",
        "Between sessions, what pauses one lists the students; pads choose",
    ),
    ("ask_first", "ask me before a result", "Did you rush or drag? At most once a lesson; a pad answers after silence"),
    ("guide", "the drummer sounds along", "The demonstration's strokes sound in the passes too, from the next session"),
)


_RISES = (("the tempo does not rise", None), *((f"+{n} bpm every {bars} bars", Rise(n, bars)) for n, bars in _STEPS))


def _rise(selection: Selection) -> Rise | None:
    """Draw the choice of a rising tempo, one that is none of the usual ones stands first."""
    rise = selection.rise
    known, labels = [each for _, each in _RISES], [label for label, _ in _RISES]
    if rise not in known:
        assert rise is not None, "none is a usual one"
        known, labels = [rise, *known], [rise_words(rise), *labels]
    imgui.set_next_item_width(-1)
    changed, index = imgui.combo("##rise", known.index(rise), labels)
    theme.tooltip("From the tempo that is chosen up to the lesson's target; the tempo then follows no one")
    return known[index] if changed else rise


class PracticePanel:
    """The panel; what the user does goes to `dispatch`."""

    def __init__(self, dispatch: Callable[[Action], None]) -> None:
        self._dispatch = dispatch

    def gui(self, state: State) -> None:
        """Draw the panel and do what the user does in it."""
        preferences = state.preferences
        theme.heading("How sessions go", 20)
        for name, label, tip in _TICKS:
            changed, on = theme.checkbox(label, bool(getattr(preferences, name)))
            theme.tooltip(tip)
            if changed:
                preferences = replace(preferences, **{name: on})  # type: ignore[arg-type] # every tick is a yes or no
        self._tempo(state.selection)
        theme.part("What pauses and goes on")
        preferences = self._pauses(preferences)
        if preferences != state.preferences:
            self._dispatch(SetPreferences(preferences))
        self._learn(state.learns_pause)

    def _tempo(self, selection: Selection) -> None:
        """Whether the tempo of the chosen lesson rises."""
        if selection.card is None or selection.free:
            return
        theme.part("The lesson that is chosen")
        chosen = replace(selection, rise=_rise(selection))
        if chosen.rise is not None and chosen.rise != selection.rise:
            chosen = replace(chosen, adapt=False)
        if chosen != selection:
            self._dispatch(Select(chosen))

    @staticmethod
    def _pauses(preferences: PracticePreferences) -> PracticePreferences:
        """Each gesture with a button that takes it away."""
        theme.soft("Backspace always does." if preferences.pauses else "Backspace alone.")
        for word in preferences.pauses:
            if imgui.button(f"×##no-{word}"):
                preferences = preferences.without(word)
            theme.tooltip("No longer pauses")
            imgui.same_line()
            imgui.align_text_to_frame_padding()
            imgui.text_wrapped(pause_in_words(word))
        return preferences

    def _learn(self, learns: bool) -> None:
        if imgui.button(GIVE_UP_LABEL if learns else LEARN_LABEL, imgui.ImVec2(-1, theme.points(38))):
            self._dispatch(LearnPause(not learns))
        theme.tooltip("One more gesture that pauses: press here, then make it on the kit")
        if learns:
            imgui.text_wrapped("Now strike two pads at once, or press the foot switch.")
