"""The panel that pins a drum part to a band's sound: its outline, its bars, and how far each pin is off.

A click in the outline goes there; what stands under the orange line is pinned to a beat by "Pin".
"""

from collections.abc import Callable

import numpy as np
from imgui_bundle import imgui, implot

from station.app.actions.action import Action
from station.app.actions.song_actions import (
    MovePoint,
    OpenSong,
    PlaySong,
    RemovePoint,
    SaveSong,
    SetPoint,
    SnapPoint,
    TapAlong,
)
from station.app.songs.opened_song import OpenedSong
from station.app.songs.song_page import SongView
from station.drills.songs.song_file import SONG_ENDING
from station.drills.songs.song_folder import SOUND_ENDINGS
from station.gui import theme
from station.gui.file_chooser import FileChooser, has_file_chooser
from station.gui.widgets import plots
from station.gui.widgets.flow_row import FlowRow
from station.music.formats.format_table import FORMATS
from station.render import palette

SONG = "Song"
ABOUT = "A drum part and a band's sound become a song to practise"
HELP = (
    "Choose a part (any music file, a lesson, a song's folder of Clone Hero or a song file) and the band's sound, or"
    " drop the sound on the window. Then pin beats of the part to the sound, two at least and about five for a song"
    " that drifts: listen, stop or click where a beat is, say which bar and beat it is, and pin it; or tick Tap along,"
    " listen, and tap the beats from that bar on, on a pad or the keys that are drums. Between the pins the station"
    " hears where the band is, and the bars move there. The table says how far each pin is off; more than 20 ms is a"
    " wrong beat or a rough pin: nudge it, or take the nearest onset. What is kept stands among your lessons."
)
PART_LABEL, SOUND_LABEL, OPEN_LABEL = "##song-part", "##song-sound", "Open##song"
PLAY_LABEL, STOP_LABEL, PIN_LABEL, TAP_LABEL = "Listen##song", "Stop##song", "Pin##song", "Tap along##song"
ONSET_LABEL, REMOVE_LABEL, SAVE_LABEL = "Onset##song", "Remove##song", "Keep##song"
TITLE_LABEL, BAR_LABEL, BEAT_LABEL, PLOT = "##song-title", "##song-bar", "##song-beat", "##song-outline"
CHOOSE_LABEL = "…##song"
NUDGES_MS = (-5, -1, 1, 5)
_PATHS, _TITLE, _NUMBER, _BUTTON, _SMALL = (100.0, 260.0), 160.0, 46.0, 76.0, 62.0
"""Design pixels, wide; a path's field at least and at most."""
_OUTLINE, _BELOW = (90.0, 150.0), 330.0
"""Design pixels, high: the outline at least and at most, and what stands below it: the controls and five pins."""
_COLUMNS, _MOST_ONSETS = 700, 120
"""Columns of the outline that are drawn, and onsets that can be told apart in it (our choice)."""
_SHOWN_WEIGHT = 0.5
"""An onset half as strong as usual is shown (our choice)."""
_SEEN_S = 16.0
"""What is seen at first (our choice: eight bars at 120)."""
_ENDINGS = (*dict.fromkeys(ending for form in FORMATS for ending in form.endings), ".toml", SONG_ENDING, *SOUND_ENDINGS)
_TIP = "Click: go there. Wheel: nearer. Drag: to and fro. Double click: all of it"


class SongPanel:
    """Keeps what is typed, where the line stands and which pin is chosen; what the user does goes to `dispatch`."""

    def __init__(self, dispatch: Callable[[Action], None]) -> None:
        self._dispatch = dispatch
        self.part = self.sound = self.title = ""
        self.bar, self.beat, self.chosen = 1, 1.0, 0
        self.at_s = 0.0
        """Where the line stands, in seconds of the sound."""
        self.clicks = True
        self._opened: OpenedSong | None = None
        self._dropped = ""
        self._low, self._high = implot.BoxedValue(0.0), implot.BoxedValue(_SEEN_S)
        self._time_s = np.empty(0)
        self._chooser = FileChooser("A part, a song or its sound", "Songs", _ENDINGS) if has_file_chooser() else None

    def poll(self) -> None:
        """Take what the system's dialog has brought, whether or not the panel is seen."""
        for path in [] if self._chooser is None else self._chooser.chosen():
            if path.lower().endswith(SOUND_ENDINGS):
                self.sound = path
            else:
                self.part = path

    def gui(self, view: SongView, can_play: bool) -> None:
        """Draw the panel and do what the user does in it."""
        if view.sound != self._dropped:
            self.sound = self._dropped = view.sound
        row = FlowRow()
        self._files(view, row)
        if view.opened is None:
            _said(view)
            return
        if view.opened is not self._opened:
            self._meet(view.opened)
        if view.at_s is not None:
            self._follow(view.at_s)
        _said(view)
        room = imgui.get_content_region_avail()
        least, most = map(theme.points, _OUTLINE)
        self._outline(view, view.opened, (room.x, min(max(room.y - theme.points(_BELOW), least), most)))
        self._controls(view, can_play)
        self._table(view)

    def _meet(self, opened: OpenedSong) -> None:
        self._opened, self.title, self.at_s, self.chosen = opened, opened.song.title, 0.0, 0
        self._time_s = np.linspace(0.0, opened.length_s, len(opened.peaks), endpoint=False)
        self._low.value, self._high.value = 0.0, min(_SEEN_S, opened.length_s)

    def _follow(self, at_s: float) -> None:
        """Keep the line that moves within sight."""
        self.at_s = at_s
        wide = self._high.value - self._low.value
        if not self._low.value <= at_s <= self._high.value - 0.1 * wide:
            self._low.value = at_s - 0.1 * wide
            self._high.value = self._low.value + wide

    # --- rows of controls --------------------------------------------------------------------------------------------

    def _files(self, view: SongView, row: FlowRow) -> None:
        wide = self._path_width()
        for label, name, says in (
            (PART_LABEL, "part", "The part: a music file, a lesson, a song's folder or a song file"),
            (SOUND_LABEL, "sound", "The band's sound: .ogg, .mp3, .wav …; none with a song file or a song's folder"),
        ):
            row.place(wide)
            imgui.set_next_item_width(wide)
            _, typed = imgui.input_text_with_hint(label, f"{name} …", getattr(self, name))
            setattr(self, name, typed)
            theme.tooltip(says)
        if self._chooser is not None:
            if row.button(CHOOSE_LABEL, _SMALL):
                self._chooser.ask()
            theme.tooltip("Choose the part or the sound among your files")
        imgui.begin_disabled(not self.part or view.busy == "reading…")
        if row.button(OPEN_LABEL, _BUTTON):
            self._dispatch(OpenSong(self.part, self.sound))
        imgui.end_disabled()
        theme.tooltip("Read the part and the sound. A song file and a folder of Clone Hero bring their own sound")

    def _path_width(self) -> float:
        """So wide that both files stand in one row with the buttons, or one of them where there is less room."""
        buttons = (_BUTTON,) if self._chooser is None else (_SMALL, _BUTTON)
        gaps = (1 + len(buttons)) * imgui.get_style().item_spacing.x
        left = imgui.get_content_region_avail().x - sum(map(theme.points, buttons)) - gaps
        least, most = map(theme.points, _PATHS)
        return min(left / 2 if left / 2 >= least else max(left, least), most)

    def _controls(self, view: SongView, can_play: bool) -> None:
        row = FlowRow()
        imgui.begin_disabled(not can_play)
        if row.button(PLAY_LABEL if view.at_s is None else STOP_LABEL, _BUTTON):
            self._dispatch(PlaySong(self.at_s if view.at_s is None else None, self.clicks))
        imgui.end_disabled()
        theme.tooltip("Hear the band from the line on")
        row.place(theme.points(_BUTTON))
        _, self.clicks = theme.checkbox("Click##song", self.clicks)
        theme.tooltip("A click on the beats as they are pinned now: it should lie in the band")
        self._tapping(view, row)
        self._pinning(view, FlowRow())
        self._chosen_pin(view, FlowRow())
        self._keeping(FlowRow())

    def _pinning(self, view: SongView, row: FlowRow) -> None:
        self._which_beat(row)
        if row.button(PIN_LABEL, _SMALL):
            self._dispatch(SetPoint(self.bar, self.beat, self.at_s))
        theme.tooltip("The band plays this beat where the line stands")
        imgui.begin_disabled(not view.points)
        if row.button(ONSET_LABEL, _BUTTON):
            self._dispatch(SnapPoint(self._chosen_of(view)))
        imgui.end_disabled()
        theme.tooltip("Move the pin that is chosen in the table to the onset that is meant: strong, and within 60 ms")

    def _tapping(self, view: SongView, row: FlowRow) -> None:
        row.place(theme.points(_BUTTON))
        is_changed, taps = theme.checkbox(TAP_LABEL, view.taps_from is not None)
        if is_changed or (taps and view.taps_from != self.bar and view.at_s is None):
            self._dispatch(TapAlong(self.bar if taps else None))
        theme.tooltip("While it plays: a stroke on a pad or a key is beat 1 of this bar, each other the next beat")

    def _keeping(self, row: FlowRow) -> None:
        row.place(theme.points(_TITLE))
        imgui.set_next_item_width(theme.points(_TITLE))
        _, self.title = imgui.input_text_with_hint(TITLE_LABEL, "title", self.title)
        if row.button(SAVE_LABEL, _BUTTON):
            self._dispatch(SaveSong(self.title))
        theme.tooltip("Keep the song among your own lessons, and choose it to practise")

    def _which_beat(self, row: FlowRow) -> None:
        row.place(theme.points(_NUMBER + 30.0))
        imgui.align_text_to_frame_padding()
        imgui.text("Bar")
        imgui.same_line()
        imgui.set_next_item_width(theme.points(_NUMBER))
        _, bar = imgui.input_int(BAR_LABEL, self.bar, 0)
        self.bar = max(1, bar)
        row.place(theme.points(_NUMBER + 36.0))
        imgui.align_text_to_frame_padding()
        imgui.text("Beat")
        imgui.same_line()
        imgui.set_next_item_width(theme.points(_NUMBER))
        _, beat = imgui.input_float(BEAT_LABEL, self.beat, 0.0, 0.0, "%g")
        self.beat = max(1.0, beat)

    def _chosen_of(self, view: SongView) -> int:
        return min(self.chosen, len(view.points) - 1)

    def _chosen_pin(self, view: SongView, row: FlowRow) -> None:
        """What can be done with the pin that is chosen in the table."""
        index = self._chosen_of(view)
        imgui.begin_disabled(not view.points)
        for by_ms in NUDGES_MS:
            if row.button(f"{by_ms:+d} ms##song", _SMALL):
                self._dispatch(MovePoint(index, by_ms / 1e3))
            theme.tooltip("Move the pin that is chosen in the table")
        if row.button(REMOVE_LABEL, _BUTTON):
            self._dispatch(RemovePoint(index))
        imgui.end_disabled()

    # --- the sound ---------------------------------------------------------------------------------------------------

    def _outline(self, view: SongView, opened: OpenedSong, size: tuple[float, float]) -> None:
        if not implot.begin_plot(PLOT, imgui.ImVec2(*size), plots.FREE | implot.Flags_.no_legend):
            return
        plots.axis(implot.ImAxis_.x1)
        implot.setup_axis_links(implot.ImAxis_.x1, self._low, self._high)
        implot.setup_axis_limits_constraints(implot.ImAxis_.x1, -5.0, opened.length_s + 5.0)
        implot.setup_axis_zoom_constraints(implot.ImAxis_.x1, 0.2, opened.length_s + 10.0)
        plots.fixed(implot.ImAxis_.y1, -1.05, 1.3, plots.BARE)
        self._bar_ticks(view)
        self._sound(opened)
        self._marks(view, opened)
        if implot.is_plot_hovered() and imgui.is_mouse_released(0) and not _is_dragged():
            self.at_s = min(max(implot.get_plot_mouse_pos().x, 0.0), opened.length_s)
            if view.at_s is not None:
                self._dispatch(PlaySong(self.at_s, self.clicks))
        implot.end_plot()
        theme.tooltip(_TIP)

    def _bar_ticks(self, view: SongView) -> None:
        """Bars by their numbers, as many as have room."""
        bars = [(at_s, bar) for bar, at_s in enumerate(view.bar_s, 1) if self._low.value <= at_s <= self._high.value]
        step = max(1, -(-len(bars) // 16))
        shown = [(at_s, f"{bar}") for at_s, bar in bars if (bar - 1) % step == 0]
        if shown:
            implot.setup_axis_ticks(implot.ImAxis_.x1, [at_s for at_s, _ in shown], [word for _, word in shown])

    def _sound(self, opened: OpenedSong) -> None:
        first, end = np.searchsorted(self._time_s, [self._low.value, self._high.value])
        step = max(1, int(end - first) // _COLUMNS)
        last = first + (end - first) // step * step
        peaks = opened.peaks[first:last].reshape(-1, step).max(axis=1).astype(np.float64)
        at_s = np.ascontiguousarray(self._time_s[first:last:step])
        if len(at_s) > 1:
            look = plots.spec(palette.with_opacity(palette.INK, 0.55))
            implot.plot_shaded("##sound", at_s, np.ascontiguousarray(-peaks), np.ascontiguousarray(peaks), look)

    def _marks(self, view: SongView, opened: OpenedSong) -> None:
        is_seen = (opened.onsets_s >= self._low.value) & (opened.onsets_s <= self._high.value)
        near = is_seen & (opened.weights >= _SHOWN_WEIGHT)
        if 0 < near.sum() <= _MOST_ONSETS:
            ends = np.ascontiguousarray(opened.onsets_s[near])
            implot.plot_scatter(
                "##onsets",
                ends,
                np.full(len(ends), 1.12),
                plots.spec(palette.GOOD, size=2.0, marker=implot.Marker_.down),
            )
        for index, one in enumerate(view.points):
            colour = palette.WRONG if one.is_off else palette.GOOD
            weight = 3.0 if index == self.chosen else 1.5
            implot.plot_inf_lines(f"##pin{index}", np.array([one.point.at_s]), plots.spec(colour, weight))
        implot.plot_inf_lines("##line", np.array([self.at_s]), plots.spec(palette.BRAND, 2.0))

    # --- the pins ----------------------------------------------------------------------------------------------------

    def _table(self, view: SongView) -> None:
        flags = imgui.TableFlags_.row_bg | imgui.TableFlags_.sizing_stretch_same
        if view.points and imgui.begin_table("##pins", 3, flags):
            for title in ("Beat", "Second", "Off by"):
                imgui.table_setup_column(title)
            imgui.table_headers_row()
            for index, one in enumerate(view.points):
                imgui.table_next_row()
                imgui.table_next_column()
                label = f"{one.point.bar}.{one.point.beat:g}##pin{index}"
                if imgui.selectable(label, index == self.chosen, imgui.SelectableFlags_.span_all_columns)[0]:
                    self.chosen, self.at_s = index, one.point.at_s
                    self.bar, self.beat = one.point.bar, one.point.beat
                imgui.table_next_column()
                imgui.text(f"{one.point.at_s:.3f}")
                imgui.table_next_column()
                words = f"{one.residual_ms:+.0f} ms"
                theme.warning(words) if one.is_off else imgui.text(words)
            imgui.end_table()


def _is_dragged() -> bool:
    """Whether the mouse moved between press and release: then the plot was shifted, not clicked."""
    return imgui.get_mouse_drag_delta(0, 3.0).x != 0.0


def _said(view: SongView) -> None:
    """What goes on, what went wrong, and what to do next."""
    if view.busy:
        theme.soft(view.busy[:1].upper() + view.busy[1:])
    elif view.fault:
        theme.warning(view.fault)
    elif view.opened is None:
        theme.soft("Choose a drum part and the band's sound; or drop the sound on the window.")
    elif len(view.points) < 2:
        theme.soft("Pin two beats at least: near the beginning, and near the end.")
    elif view.is_followed:
        theme.soft("The bars follow the band.")
