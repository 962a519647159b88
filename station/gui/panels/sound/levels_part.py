"""How loud each bus and each piece of the kit is, and on which side: a row each, at once, in a session too."""

from collections.abc import Callable
from dataclasses import replace

from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.sound_actions import MuteChannel, SetChannel, SoloChannel, SoundOwnStrokes
from station.app.sound.sound_page import SoundView
from station.core.labels import name_of
from station.core.settings import Settings
from station.engine.levels_option import BUSES, MASTER, PIECES, USUAL, ChannelLevel, most_of
from station.gui import theme
from station.render import palette

OWN_LABEL = "sound my strokes"
_BUS_NAMES = {
    MASTER: ("all", "All that sounds"),
    "student": ("you", "Your own strokes"),
    "demonstration": ("drummer", "The demonstration, and what is heard again"),
    "click": ("click", "The click and the counted words"),
    "track": ("track", "The track, or a song's band"),
}
assert set(_BUS_NAMES) == {MASTER, *BUSES}
_SMALL, _NAME, _PAN = 30.0, 96.0, 92.0
"""Design pixels: a button, a name, a pan."""
_MIDDLE = 0.02
"""Nearer to the middle than this is the middle (our choice: a slider's pixel or two)."""


class LevelsPart:
    """Draws it; what the user does goes to `dispatch`."""

    def __init__(self, dispatch: Callable[[Action], None]) -> None:
        self._dispatch = dispatch
        self._reset = ""  # the slider that was double-clicked, until the mouse lets it go

    def gui(self, view: SoundView, settings: Settings) -> None:
        """Draw it."""
        theme.part("Who is heard")
        for channel, (name, tip) in _BUS_NAMES.items():
            self._row(view, channel, name, tip)
        changed, on = theme.checkbox(OWN_LABEL, settings.own_sound)
        theme.tooltip("Off where your kit is heard from its own module: ours would come a little later")
        if changed:
            self._dispatch(SoundOwnStrokes(on))
        theme.part("The drum kit")
        for channel in PIECES:
            self._row(view, channel, name_of(channel), "Whoever plays it; up to twice what the kit has")
        theme.soft(
            "A double click goes back to 100 % in the middle. M: silent. S: heard alone, while this page is open."
        )

    def _row(self, view: SoundView, channel: str, name: str, tip: str) -> None:
        level = view.level(channel)
        is_narrow = theme.is_narrow()
        imgui.align_text_to_frame_padding()
        imgui.text(name)
        theme.tooltip(tip)
        if not is_narrow:
            imgui.same_line(theme.points(_NAME) + imgui.get_cursor_start_pos().x)
        has_pan = channel != MASTER
        buttons = 2 if has_pan else 1
        spacing = imgui.get_style().item_spacing.x
        room = imgui.get_content_region_avail().x - buttons * (theme.points(_SMALL) + spacing)
        pan_width = theme.points(_PAN) + spacing if has_pan else 0.0
        imgui.set_next_item_width(-1 if is_narrow and has_pan else room - pan_width)
        percent, most = round(100 * level.level), round(100 * most_of(channel))
        moved, percent = theme.slider_int(f"##level-{channel}", percent, 0, most, "%d %%")
        chosen = self._moved(f"level {channel}", level, replace(level, level=min(max(percent, 0), most) / 100), moved)
        theme.tooltip(f"{tip}: how loud")
        if has_pan:
            if not is_narrow:
                imgui.same_line()
            imgui.set_next_item_width(room if is_narrow else theme.points(_PAN))
            moved, pan = theme.slider_float(f"##pan-{channel}", level.pan, -1.0, 1.0, _pan_words(level.pan))
            pan = 0.0 if abs(pan) < _MIDDLE else round(min(max(pan, -1.0), 1.0), 2)
            chosen = self._moved(f"pan {channel}", chosen, replace(chosen, pan=pan), moved)
            theme.tooltip(f"{tip}: from left to right")
        if chosen != level:
            self._dispatch(SetChannel(channel, chosen))
        self._buttons(view, channel, has_solo=has_pan)

    def _moved(self, slider: str, before: ChannelLevel, after: ChannelLevel, moved: bool) -> ChannelLevel:
        """What the slider that was drawn last comes to; a double click goes back to the usual, and holds it there."""
        if imgui.is_item_hovered() and imgui.is_mouse_double_clicked(imgui.MouseButton_.left):
            self._reset = slider
        if self._reset == slider:
            if not imgui.is_mouse_down(imgui.MouseButton_.left):
                self._reset = ""
            return USUAL
        return after if moved else before

    def _buttons(self, view: SoundView, channel: str, has_solo: bool) -> None:
        imgui.same_line()
        if _toggle(f"M##mute-{channel}", view.level(channel).level == 0.0):
            self._dispatch(MuteChannel(channel))
        theme.tooltip("Silent, or as loud as before")
        if has_solo:
            imgui.same_line()
            if _toggle(f"S##solo-{channel}", channel in view.solo):
                self._dispatch(SoloChannel(channel))
            theme.tooltip("Hear it alone, or no longer; with others that have it")


def _toggle(label: str, is_on: bool) -> bool:
    """A small button, lit where it is on."""
    if is_on:
        imgui.push_style_color(
            imgui.Col_.button, imgui.ImVec4(*palette.with_opacity(theme.themed(palette.BRAND), 0.55))
        )
    imgui.push_style_var(imgui.StyleVar_.frame_padding, imgui.ImVec2(0.0, imgui.get_style().frame_padding.y))
    pressed = imgui.button(label, imgui.ImVec2(theme.points(_SMALL), 0))
    imgui.pop_style_var()
    if is_on:
        imgui.pop_style_color()
    return bool(pressed)


def _pan_words(pan: float) -> str:
    percent = round(100 * abs(pan))
    return "middle" if percent == 0 else f"{'left' if pan < 0 else 'right'} {percent}"
