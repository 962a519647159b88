"""How the chosen lesson is to be played: tempo, passes, how strictly it is judged, click; and what is just played."""

from collections.abc import Callable
from dataclasses import replace

from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.file_actions import FilmTake, Import
from station.app.actions.practice_actions import JudgeAt, Listen, TapBeat
from station.app.room_state import LessonCard, RoomState
from station.app.selection import MAX_LOOPS, Selection
from station.core.clock import monotonic_ns
from station.gui import theme
from station.gui.widgets.flow_row import FlowRow
from station.gui.widgets.level_choice import level_choice

ADAPT_LABEL = "the tempo follows me"
TAP_LABEL = "Tap##tap"
LISTEN_LABEL, STOP_LISTENING = "Listen back##listen", "Stop listening##listen"
FILM_LABEL = "Video of it##film"
LESSON_LABEL = "Lesson of it##take"
_WITHOUT_CLICK = "Without it you are counted in, then the score follows your own tempo and waits when you stop"
_BAND_ALONE = "Without it you are counted in, then the band alone keeps the time"
_FOLLOWS = (
    "Each pass begins where the last one led, and says why: faster when it is clean, slower when it is not. Untick it"
    " to choose a tempo"
)
_PASSES = 92
"""Design pixels of the passes' slider; the level has the rest of its line."""
_LEAST_LEVEL = 170
"""Design pixels that the level needs to be read; where it has less, it has a line of its own."""
_TAP, _HIGH, _AIR = 58, 34, 8
"""Design pixels: a button's width, a higher one's height, what a slider's words leave free."""


class LessonOptions:
    """The controls; what is asked for at once goes to `dispatch`."""

    def __init__(self, dispatch: Callable[[Action], None]) -> None:
        self._dispatch = dispatch

    def lesson(self, selection: Selection, card: LessonCard) -> Selection:
        """Draw what a lesson has; returns how it is chosen to be. It takes as much room whatever is ticked."""
        follows = selection.adapt and selection.click and not card.is_song
        imgui.begin_disabled(follows)
        selection = self._tempo(selection, "follows you" if follows else "tempo %.0f bpm")
        imgui.end_disabled()
        imgui.set_next_item_width(theme.points(_PASSES))
        selection = replace(
            selection, loops=theme.slider_int("##passes", selection.loops, 1, MAX_LOOPS, "passes %d")[1]
        )
        theme.tooltip("How often the loop is played")
        assert selection.level is not None, "a lesson is chosen"
        if imgui.get_content_region_avail().x - theme.points(_PASSES) >= theme.points(_LEAST_LEVEL):
            imgui.same_line()
        level = level_choice(card.levels, selection.level)
        if level is not None:
            self._dispatch(JudgeAt(card.name, level))
        row = FlowRow()
        row.place(0)
        selection = self._click(selection, _BAND_ALONE if card.is_song else _WITHOUT_CLICK)
        if not card.is_song:
            row.place(imgui.get_frame_height() + imgui.calc_text_size(ADAPT_LABEL).x + theme.points(8))
            selection = replace(selection, adapt=theme.checkbox(ADAPT_LABEL, selection.adapt)[1])
            theme.tooltip(_FOLLOWS)
        return selection

    def just_play(self, selection: Selection, room: RoomState) -> Selection:
        """Draw what just playing has, and what becomes of the last take."""
        imgui.begin_disabled(not selection.click)
        selection = self._tempo(selection, "tempo %.0f bpm")
        imgui.end_disabled()
        selection = self._click(selection, "As the settings say; without it there is silence")
        high = theme.points(_HIGH)
        imgui.begin_disabled(not (room.take or room.listening))
        if imgui.button(STOP_LISTENING if room.listening else LISTEN_LABEL, imgui.ImVec2(-1, high)):
            self._dispatch(Listen())
        imgui.end_disabled()
        theme.tooltip("The last take from its recording, through the station's own drums")
        imgui.begin_disabled(room.take is None)
        half = (imgui.get_content_region_avail().x - imgui.get_style().item_spacing.x) / 2
        widest = max(imgui.calc_text_size(each, True).x for each in (FILM_LABEL, LESSON_LABEL))
        is_wide = widest + 2 * imgui.get_style().frame_padding.x <= half
        width = half if is_wide else -1.0
        if imgui.button(FILM_LABEL, imgui.ImVec2(width, high)) and room.take is not None:
            self._dispatch(FilmTake(room.take))
        theme.tooltip("The drummer plays your last take, as MP4 beside its recording; it is filmed while you go on")
        if is_wide:
            imgui.same_line()
        if imgui.button(LESSON_LABEL, imgui.ImVec2(width, high)) and room.take is not None:
            self._dispatch(Import(str(room.take)))
        theme.tooltip("Your last take on the grid, as a lesson of your own; Export has it as MIDI, stroke by stroke")
        imgui.end_disabled()
        return selection

    @staticmethod
    def _click(selection: Selection, tip: str) -> Selection:
        clicks = imgui.checkbox("click", selection.click)[1]
        theme.tooltip(tip)
        return replace(selection, click=clicks)

    def _tempo(self, selection: Selection, words: str) -> Selection:
        tap = theme.points(_TAP)
        room = imgui.get_content_region_avail().x - tap - imgui.get_style().item_spacing.x
        if imgui.calc_text_size(words).x > room - theme.points(_AIR):
            words = words.removeprefix("tempo ")
        imgui.set_next_item_width(-(tap + imgui.get_style().item_spacing.x))
        moved, beats = theme.slider_float("##tempo", selection.beats_a_minute, *selection.tempo_range, words)
        if moved:
            selection = replace(selection, tempo_bpm=beats * selection.beat_quarters)
        theme.tooltip("How fast to practise; the lesson's own tempo is set when you choose it. Ctrl+click to type")
        imgui.same_line()
        if imgui.button(TAP_LABEL, imgui.ImVec2(tap, 0)):
            self._dispatch(TapBeat(monotonic_ns()))
        theme.tooltip("Click on every beat, twice or more: the tempo follows")
        return selection
