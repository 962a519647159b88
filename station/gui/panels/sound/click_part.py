"""What clicks, and in which voice: every change is heard at once for a bar, and holds from the next session on."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import TypeVar

from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.practice_actions import Select
from station.app.actions.sound_actions import ChooseClick, HearClick, SetClickPattern
from station.app.selection import Selection
from station.app.sound.sound_page import SoundView
from station.gui import theme
from station.gui.panels.sound.hover_trial import HoverTrial
from station.gui.widgets.flow_row import FlowRow
from station.gui.widgets.gap_choice import gap_choice
from station.music.swing import MAX_RATIO, MIN_RATIO, Swing
from station.practice.session.cues.click_pattern import MAX_SUBDIVISIONS, ClickBeats, ClickPattern, Displacement
from station.practice.session.cues.quiet_bars import gap_words
from station.render import palette
from station.sound.click_sounds import TIMBRES

T = TypeVar("T")

HEAR_LABEL, COUNT_LABEL, NOT_HERE_LABEL = "Hear a bar##click", "a voice counts instead", "Not by the plan##gap"
PARTS_LABEL, SWING_LABEL, ON_LABEL, PLACE_LABEL = "##parts", "##swing", "##click-on", "##click-place"
_ON = {ClickBeats.ALL: "every beat", ClickBeats.BACKBEAT: "2 and 4 alone", ClickBeats.BAR: "once a bar"}
_PLACES = {
    Displacement.NONE: "on the beat",
    Displacement.E: 'on "e"',
    Displacement.AND: 'on "and"',
    Displacement.A: 'on "a"',
}
_CELL, _BUTTON = 46.0, 110.0
"""Design pixels, wide: a beat's cell and a button."""
_STRONG, _WEAK, _OFF = "strong", "weak", "off"


class ClickPart:
    """Draws it; what the user does goes to `dispatch`."""

    def __init__(self, dispatch: Callable[[Action], None], trial: HoverTrial) -> None:
        self._dispatch, self._trial = dispatch, trial

    def gui(self, view: SoundView, click: str, selection: Selection) -> None:
        """Draw it; `click` is the voice that is chosen, of `selection` the day's plan may want silent bars."""
        theme.part("Voice")
        self._voices(click)
        theme.part("What clicks")
        pattern = _beats(view.pattern, view.beats)
        pattern = _parts(pattern)
        theme.part("Where it falls silent")
        pattern = replace(pattern, gap=gap_choice(pattern.gap))
        if selection.gap is not None:
            theme.soft(f"In the lesson that is chosen, by the day's plan: {gap_words(selection.gap)}.")
            if imgui.button(NOT_HERE_LABEL):
                self._dispatch(Select(replace(selection, gap=None)))
            theme.tooltip("The lesson that is chosen goes by what is set here, too")
        if pattern != view.pattern:
            self._dispatch(SetClickPattern(pattern))
        imgui.begin_disabled(view.is_playing)
        if imgui.button(HEAR_LABEL, imgui.ImVec2(theme.points(_BUTTON), 0)):
            self._dispatch(HearClick())
        imgui.end_disabled()
        theme.tooltip("A bar in the meter and at the tempo of the lesson that is chosen")
        if view.is_playing:
            theme.soft("The voice changes at once; what clicks, from the next session on.")

    def _voices(self, click: str) -> None:
        row = FlowRow()
        for name in TIMBRES:
            row.place(imgui.get_frame_height() + imgui.get_style().item_inner_spacing.x + imgui.calc_text_size(name).x)
            if imgui.radio_button(f"{name}##voice", click == name):
                self._dispatch(ChooseClick(name))
                self._dispatch(HearClick(name))
            self._trial.item(f"click {name}", HearClick(name))


def _beats(pattern: ClickPattern, beats: int) -> ClickPattern:
    """Which beats click, and how strongly."""
    is_narrow, half = _halves()
    pattern = replace(pattern, beats=_choice(ON_LABEL, pattern.beats, _ON, half, "Which beats of the bar click"))
    if not is_narrow:
        imgui.same_line()
    pattern = replace(
        pattern,
        displacement=_choice(PLACE_LABEL, pattern.displacement, _PLACES, half, "Where in its beat a click falls"),
    )
    if pattern.beats is ClickBeats.ALL:
        row = FlowRow()
        for beat in range(beats):
            row.place(theme.points(_CELL))
            pattern = _cell(pattern, beat)
        theme.soft("Click a beat: strong, weak or off.")
    return pattern


def _halves() -> tuple[bool, float]:
    """Whether a control takes a line of its own, and how wide each is."""
    is_narrow, room = theme.is_narrow(), float(imgui.get_content_region_avail().x)
    return is_narrow, room if is_narrow else (room - imgui.get_style().item_spacing.x) / 2


def _cell(pattern: ClickPattern, beat: int) -> ClickPattern:
    """One beat's cell: a press makes a strong one weak, a weak one silent, a silent one strong."""
    now = _OFF if beat in pattern.off else _STRONG if beat in pattern.accents else _WEAK
    ink, brand = theme.themed(palette.INK), theme.themed(palette.BRAND)
    colour = {
        _STRONG: palette.with_opacity(brand, 0.75),
        _WEAK: palette.with_opacity(ink, 0.22),
        _OFF: palette.with_opacity(ink, 0.04),
    }[now]
    imgui.push_style_color(imgui.Col_.button, imgui.ImVec4(*colour))
    sign = {_STRONG: ">", _WEAK: " ", _OFF: "–"}[now]
    pressed = imgui.button(
        f"{sign}\n{beat + 1}###beat{beat + 1}", imgui.ImVec2(theme.points(_CELL), theme.points(_CELL))
    )
    imgui.pop_style_color()
    theme.tooltip(f"Beat {beat + 1} is {now}")
    if not pressed:
        return pattern
    accents, off = set(pattern.accents) - {beat}, set(pattern.off) - {beat}
    if now == _WEAK:
        off |= {beat}
    elif now == _OFF:
        accents |= {beat}
    return replace(pattern, accents=tuple(sorted(accents)), off=tuple(sorted(off)))


def _parts(pattern: ClickPattern) -> ClickPattern:
    """Clicks between the beats, their swing, and the voice that counts."""
    is_narrow, half = _halves()
    imgui.set_next_item_width(half)
    moved, parts = theme.slider_int(PARTS_LABEL, pattern.subdivisions, 1, MAX_SUBDIVISIONS, "%d a beat")
    if moved:
        pattern = replace(pattern, subdivisions=min(max(parts, 1), MAX_SUBDIVISIONS))
    theme.tooltip("How many clicks a beat has; 2 are eighths in 4/4, 3 triplets, 4 sixteenths")
    if not is_narrow:
        imgui.same_line()
    imgui.set_next_item_width(half)
    words = "straight" if pattern.swing.ratio == MIN_RATIO else "swing %.2f : 1"
    imgui.begin_disabled(pattern.subdivisions % 2 == 1)
    moved, ratio = theme.slider_float(SWING_LABEL, pattern.swing.ratio, MIN_RATIO, MAX_RATIO, words)
    imgui.end_disabled()
    if moved:
        pattern = replace(pattern, swing=Swing(round(min(max(ratio, MIN_RATIO), MAX_RATIO), 2)))
    theme.tooltip("Long to short of two eighths: 2 is the triplet feel; for 2, 4, 6 or 8 clicks a beat")
    changed, counts = theme.checkbox(COUNT_LABEL, pattern.counts)
    theme.tooltip('"one e and a two": the vowels fall on the beats')
    return replace(pattern, counts=counts) if changed else pattern


def _choice(label: str, value: T, words: Mapping[T, str], width: float, tip: str) -> T:
    """A list of a few words; returns what is chosen."""
    imgui.set_next_item_width(width)
    changed, index = imgui.combo(label, list(words).index(value), list(words.values()))
    theme.tooltip(tip)
    return list(words)[index] if changed else value
