"""What the user has chosen of the catalog, and that it is what is shown before it begins."""

from dataclasses import replace
from typing import assert_never

from station.app.actions import ChoiceAction, ChooseBars, Select, TapBeat
from station.app.lesson_cards import request_of
from station.app.room_state import Stage
from station.app.selection import Selection
from station.app.sessions.session_control import Launch, SessionControl
from station.app.settings_store import SettingsStore
from station.practice.control.tap_tempo import TapTempo as Taps


class Chooser:
    """The `choice`; at first what `launch` opens on, which `sessions` show already."""

    def __init__(self, sessions: SessionControl, store: SettingsStore, launch: Launch) -> None:
        self._sessions, self._store, self._taps = sessions, store, Taps()
        first = replace(request_of(launch.plan), adapt=launch.adapt)
        self.choice = Selection.of([sessions.catalog.first_card()], first)
        self._shown: tuple[str, tuple[int, int] | None] | None = (first.lesson, first.bars)
        self._has_catalog = False
        sessions.player.repeat(first.bars)

    @property
    def bars(self) -> tuple[int, int]:
        """The bars, from 0, of the lesson on the player that are practised."""
        bars = self.choice.bars
        return self._sessions.player.lesson.loop if bars is None else (bars[0] - 1, bars[1] - 1)

    def act(self, action: ChoiceAction) -> None:
        """Do what the user asks."""
        match action:
            case Select(choice):
                if choice.course is not self.choice.course:
                    course = "" if choice.course is None else choice.course.name
                    self._store.update(lambda settings: replace(settings, course=course))
                self.choice = choice
            case ChooseBars(bars):
                self.choice = replace(self.choice, bars=None if bars is None else (bars[0] + 1, bars[1] + 1))
            case TapBeat(at_ns):
                beats = self._taps.tap(at_ns)
                self.choice = self.choice if beats is None else self.choice.at_beats(beats)
            case _:
                assert_never(action)

    def offer_all(self) -> None:
        """Offer every lesson there is from now on; the first call takes a moment."""
        catalog = self._sessions.catalog
        if not self._has_catalog:
            self._has_catalog = True
            self.choice = self.choice.offer(catalog.cards(), catalog.courses(), self._store.now.course)

    def update(self) -> None:
        """Show what is chosen, if something else is shown, and how far the student is; raises `StationError`.

        A result is shown until it is left.
        """
        if self._has_catalog and (progress := self._sessions.catalog.progress()) is not self.choice.progress:
            self.choice = replace(self.choice, progress=progress)
        wish, player = self.choice.wish(), self._sessions.player
        wanted = None if wish is None else (wish.lesson, wish.bars)
        is_idle = self._sessions.practice.stage is Stage.IDLE
        if wanted == self._shown or not is_idle or not (wish or self.choice.free):
            return
        if wish is not None and self._shown is not None and wish.lesson == self._shown[0]:
            player.repeat(wish.bars)
            if player.player.playing:  # the rest can wait: nothing of it is seen
                return
        self._shown = wanted
        self._sessions.preview(wish)

    def show_anew(self) -> None:
        """Show the chosen lesson as it is to be played now, or when the result is left; raises `StationError`."""
        wish = self.choice.wish()
        if self._sessions.practice.stage is not Stage.IDLE:
            self._shown = None
        elif wish is not None:
            self._sessions.preview(wish)

    def begin(self, bar: int | None = None) -> None:
        """Begin what is chosen, or practise one `bar` (from 1) of the lesson alone; raises `StationError`."""
        wish, free = self.choice.wish(), self.choice.free_wish()
        if wish is not None:
            self._sessions.start(wish if bar is None else replace(wish, bars=(bar, bar), adapt=False))
        elif free is not None and bar is None:
            self._sessions.just_play(free)
