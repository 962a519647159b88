"""The track to play along to: a file, its tempo, where its bar 1 is, whether it follows the tempo of practice."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.sound_actions import (
    BringTrack,
    EstimateTrack,
    HearTrack,
    SetTrack,
    StartTrackHere,
    TapTrack,
)
from station.app.sound.sound_page import SoundView
from station.app.sound.track_desk import LONGEST_START_S, TrackView
from station.core.clock import monotonic_ns
from station.core.settings import Settings
from station.drills.songs.song_folder import SOUND_ENDINGS
from station.gui import theme
from station.gui.file_chooser import FileChooser, has_file_chooser
from station.gui.widgets.flow_row import FlowRow

PATH_LABEL, BRING_LABEL, CHOOSE_LABEL, NONE_LABEL = "##track", "Use it##track", "Choose…##track", "No track##track"
PLAYS_LABEL, STRETCH_LABEL = "play along to it", "at the tempo that I practise"
BPM_LABEL, TAP_LABEL, FIND_LABEL = "##track-bpm", "Tap##track", "Find##track"
START_LABEL, HEAR_LABEL, STOP_LABEL, HERE_LABEL = "##track-start", "Listen##track", "Stop##track", "Here##track"
NUDGES_MS = (-100, -10, 10, 100)
_MOST_BPM = 400.0
_BUTTON, _SMALL, _TINY, _NUMBER = 88.0, 54.0, 38.0, 88.0
"""Design pixels."""


class TrackPart:
    """Keeps the path that is typed; what the user does goes to `dispatch`."""

    def __init__(self, dispatch: Callable[[Action], None]) -> None:
        self._dispatch = dispatch
        self.path = ""
        self._chooser = FileChooser("A track to play along to", "Sounds", SOUND_ENDINGS) if has_file_chooser() else None

    def poll(self) -> None:
        """Take what the system's dialog has brought."""
        for path in ([] if self._chooser is None else self._chooser.chosen())[:1]:
            self._dispatch(BringTrack(path))

    def gui(self, view: SoundView, settings: Settings) -> None:
        """Draw it."""
        track = view.track
        theme.soft("Drop a sound file on this page, or:")
        self._ask()
        if track.fault:
            theme.warning(track.fault)
        elif track.busy:
            theme.soft(track.busy)
        if settings.track:
            self._track(view, track, settings)

    def _ask(self) -> None:
        imgui.set_next_item_width(-1)
        flags = imgui.InputTextFlags_.enter_returns_true
        entered, self.path = imgui.input_text_with_hint(PATH_LABEL, "an .mp3, .ogg or .wav", self.path, flags)
        theme.tooltip("Type or paste its path, then press Enter")
        row = FlowRow()
        imgui.begin_disabled(not self.path.strip())
        if row.button(BRING_LABEL, _BUTTON) or (entered and self.path.strip()):
            self._dispatch(BringTrack(self.path.strip()))
        imgui.end_disabled()
        theme.tooltip("It is listened to for its beat, and sessions play along to it")
        if self._chooser is not None:
            if row.button(CHOOSE_LABEL, _BUTTON):
                self._chooser.ask()
            theme.tooltip("Choose it in the system's own dialog")

    def _track(self, view: SoundView, track: TrackView, settings: Settings) -> None:
        theme.part("The track")
        length = "" if track.length_s is None else f", {track.length_s:.0f} s"
        imgui.text_wrapped(f"{Path(settings.track).name}{length}")
        asked = SetTrack(settings.with_track, settings.track_bpm, settings.track_start_s, settings.track_stretched)
        chosen = _ticks(asked)
        chosen = self._tempo(chosen)
        chosen = self._start(view, track, chosen)
        if chosen != asked:
            self._dispatch(chosen)
        theme.soft(
            "It plays with the lessons whose tempo stays: untick “the tempo follows me”. A song has its own band."
            " Its level is on the leaf Levels."
        )
        if imgui.button(NONE_LABEL, imgui.ImVec2(theme.points(_BUTTON), 0)):
            self._dispatch(BringTrack(""))
        theme.tooltip("Forget the track; the file stays where it is")

    def _tempo(self, chosen: SetTrack) -> SetTrack:
        row = FlowRow()
        row.place(theme.points(_NUMBER))
        imgui.set_next_item_width(theme.points(_NUMBER))
        changed, bpm = imgui.input_float(BPM_LABEL, chosen.bpm, 0.0, 0.0, "%.2f bpm")
        theme.tooltip("The track's own tempo, in the beat that your lesson counts; 0: the lesson's own tempo")
        if changed:
            chosen = replace(chosen, bpm=min(max(bpm, 0.0), _MOST_BPM))
        if row.button(TAP_LABEL, _SMALL):
            self._dispatch(TapTrack(monotonic_ns()))
        theme.tooltip("Tap its beats while you listen")
        if row.button(FIND_LABEL, _SMALL):
            self._dispatch(EstimateTrack())
        theme.tooltip("Listen for its tempo and its first beat once more")
        for label, factor in (("×2##track", 2.0), ("÷2##track", 0.5)):
            if row.button(label, _TINY) and 0.0 < chosen.bpm * factor <= _MOST_BPM:
                chosen = replace(chosen, bpm=chosen.bpm * factor)
            theme.tooltip("It is counted at double or half")
        return chosen

    def _start(self, view: SoundView, track: TrackView, chosen: SetTrack) -> SetTrack:
        theme.part("Where bar 1 is")
        row = FlowRow()
        row.place(theme.points(_NUMBER))
        imgui.set_next_item_width(theme.points(_NUMBER))
        changed, start_s = imgui.input_float(START_LABEL, chosen.start_s, 0.0, 0.0, "%.3f s")
        theme.tooltip("The place in the track at which the first pass begins")
        if changed:
            chosen = replace(chosen, start_s=_start(start_s))
        imgui.begin_disabled(view.is_playing)
        if track.at_s is None:
            if row.button(HEAR_LABEL, _BUTTON):
                self._dispatch(HearTrack(on=True))
            theme.tooltip("From there on, with a click at its tempo: right is where both fall together")
        elif row.button(STOP_LABEL, _BUTTON):
            self._dispatch(HearTrack(on=False))
        imgui.end_disabled()
        imgui.begin_disabled(track.at_s is None)
        if row.button(HERE_LABEL, _BUTTON):
            self._dispatch(StartTrackHere())
        imgui.end_disabled()
        theme.tooltip("Where it sounds now is bar 1")
        row = FlowRow()
        for ms in NUDGES_MS:
            if row.button(f"{ms:+d}##nudge", _SMALL):
                chosen = replace(chosen, start_s=_start(chosen.start_s + ms / 1000))
            theme.tooltip("Milliseconds later or earlier")
        if track.at_s is not None:
            theme.soft(f"at {track.at_s:.1f} s")
        return chosen


def _ticks(chosen: SetTrack) -> SetTrack:
    changed, plays = theme.checkbox(PLAYS_LABEL, chosen.plays)
    theme.tooltip("From the next session on")
    chosen = replace(chosen, plays=plays) if changed else chosen
    changed, stretched = theme.checkbox(STRETCH_LABEL, chosen.stretched)
    theme.tooltip("At half to one and a half of its tempo, with its pitch kept; else as it was recorded")
    return replace(chosen, stretched=stretched) if changed else chosen


def _start(start_s: float) -> float:
    return round(min(max(start_s, 0.0), LONGEST_START_S), 3)
