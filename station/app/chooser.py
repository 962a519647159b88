"""What the user has chosen of the catalog, and that it is what is shown before it begins."""

from collections.abc import Sequence
from concurrent.futures import Executor, Future
from dataclasses import replace
from pathlib import Path
from typing import assert_never

from station.app.actions.practice_actions import ChoiceAction, ChooseBars, JudgeAt, Select, TapBeat
from station.app.lesson_cards import request_of
from station.app.room_state import LessonCard, SessionRequest, Stage
from station.app.selection import Selection
from station.app.sessions.launch import Launch
from station.app.sessions.session_control import SessionControl
from station.app.settings.settings_store import SettingsStore
from station.core.errors import BadInput
from station.drills.daily.daily_items import DailyItem
from station.drills.library import lessons_dir, read_any
from station.practice.control.tap_tempo import TapTempo as Taps
from station.practice.records.report.next_steps import NextStep, StepKind


class Chooser:
    """The `selection`; at first what `launch` opens on, which `sessions` show already.

    The `reader` reads all other lessons beside what goes on, when they are asked for.
    """

    def __init__(self, sessions: SessionControl, store: SettingsStore, launch: Launch, reader: Executor) -> None:
        self._reader = reader
        self._reading: Future[Sequence[LessonCard]] | None = None
        self._sessions, self._store, self._taps = sessions, store, Taps()
        first = replace(request_of(launch.plan), adapt=launch.adapt)
        self.selection = Selection.of([sessions.catalog.first_card()], first)
        self._shown: tuple[str, tuple[int, int] | None] | None = (first.lesson, first.bars)
        self._has_catalog = False
        self._to_open: tuple[Path, ...] = ()
        sessions.player.repeat(first.bars)

    @property
    def bars(self) -> tuple[int, int]:
        """The bars, from 0, of the lesson on the player that are practised."""
        bars = self.selection.bars
        return self._sessions.player.lesson.loop if bars is None else (bars[0] - 1, bars[1] - 1)

    @property
    def lesson_name(self) -> str:
        """The lesson that is chosen, empty where none is."""
        request = self.selection.request()
        return "" if request is None else request.lesson

    def act(self, action: ChoiceAction) -> None:
        """Do what the user asks."""
        match action:
            case Select(selection):
                if selection.course is not self.selection.course:
                    course = "" if selection.course is None else selection.course.name
                    self._store.update(lambda settings: replace(settings, course=course))
                self.selection = selection
            case JudgeAt(lesson, level):
                self._sessions.catalog.judge_at(lesson, level)
                self.show_anew()
            case ChooseBars(bars):
                self.selection = replace(self.selection, bars=None if bars is None else (bars[0] + 1, bars[1] + 1))
            case TapBeat(at_ns):
                beats = self._taps.tap(at_ns)
                self.selection = self.selection if beats is None else self.selection.at_beats(beats)
            case _:
                assert_never(action)

    def take_block(self, item: DailyItem) -> None:
        """Choose what a block of the day's plan has; raises `BadInput` where its lesson is not there."""
        known = self.selection.for_block(item)
        if known is self.selection:
            still = "the lessons are still being read: again in a moment"
            raise BadInput(item.title, "", "this lesson is no longer there" if self._has_catalog else still)
        if known.course is not None and all(card.name != item.lesson for card in known.visible()):
            known = replace(known, course=None)
        self.selection = known

    def take_up(self, lesson: str, bars: tuple[int, int] | None = None) -> None:
        """Choose the lesson of that name, or `bars` (from 1) of it; raises `BadInput` where it is not there."""
        found = next((card for card in self.selection.lessons if card.name == lesson), None)
        if found is None:
            still = "the lessons are still being read: again in a moment"
            raise BadInput(lesson, "", "this lesson is no longer there" if self._has_catalog else still)
        is_listed = any(card.name == lesson for card in self.selection.visible())
        listed = self.selection if is_listed else replace(self.selection, course=None, search="")
        self.selection = replace(listed.choose(found), bars=bars)

    def for_step(self, begun: SessionRequest, step: NextStep) -> SessionRequest:
        """The session that `begun` becomes by a step; a tempo for the bars that are chosen is chosen from now on."""
        tempo_bpm = begun.tempo_bpm if step.tempo_bpm is None else step.tempo_bpm
        if step.kind is StepKind.TEMPO and begun.lesson == self.lesson_name and begun.bars == self.selection.bars:
            self.selection = replace(self.selection, tempo_bpm=tempo_bpm)
        asked = replace(begun, tempo_bpm=tempo_bpm, adapt=False)
        return asked if step.bars is None else replace(asked, bars=step.bars, rise=None)

    def offer_all(self) -> None:
        """Offer every lesson there is, as soon as they are read."""
        if self._reading is None and not self._has_catalog:
            self._sessions.catalog.courses()
            self._reading = self._reader.submit(self._sessions.catalog.cards)

    def _take_catalog(self) -> None:
        """Offer what was read; raises `BadInput` where a lesson that ships cannot be read."""
        if self._reading is not None and self._reading.done():
            reading, self._reading, self._has_catalog = self._reading, None, True
            courses, course = self._sessions.catalog.courses(), self._store.now.course
            self.selection = self.selection.offer(reading.result(), courses, course)

    def open(self, *paths: Path) -> None:
        """List the lessons in these files and choose the first, as soon as all others are listed and nobody plays."""
        self._to_open = paths

    def _choose_opened(self) -> None:
        """Raises `BadInput` where a file has gone bad meanwhile."""
        if not self._to_open or not self._has_catalog or self._sessions.practice.stage is not Stage.IDLE:
            return
        paths, self._to_open = self._to_open, ()
        catalog = self._sessions.catalog
        first, *_ = [self._listed(path) for path in paths]
        listed = replace(self.selection.offer(catalog.cards(), catalog.courses()), search="")
        self.selection = listed.choose(first)
        self._shown = None  # a lesson of that name may have been shown

    def _listed(self, path: Path) -> LessonCard:
        """The card of the lesson in that file, which is one of the user's own from now on unless it ships."""
        catalog = self._sessions.catalog
        shipped = {card.name: card for card in catalog.cards() if path.is_relative_to(lessons_dir())}
        return shipped[path.stem] if path.stem in shipped else catalog.add(read_any(path))

    def close(self) -> None:
        """End the reader; what it reads is dropped."""
        self._reader.shutdown(wait=False, cancel_futures=True)

    def update(self) -> None:
        """Show what is chosen, if something else is shown, how far the student is, and how strictly they are judged.

        A result is shown until it is left. Raises `StationError`.
        """
        self._take_catalog()
        self._choose_opened()
        if self._has_catalog:
            progress, levels = self._sessions.catalog.progress(), self._sessions.catalog.levels()
            if progress is not self.selection.progress or levels is not self.selection.levels:
                self.selection = replace(self.selection, progress=progress, levels=levels)
        request, player = self.selection.request(), self._sessions.player
        wanted = None if request is None else (request.lesson, request.bars)
        is_idle = self._sessions.practice.stage is Stage.IDLE
        if wanted == self._shown or not is_idle or not (request or self.selection.free):
            return
        if request is not None and self._shown is not None and request.lesson == self._shown[0]:
            player.repeat(request.bars)
            if player.player.playing:  # the rest can wait: nothing of it is seen
                return
        self._shown = wanted
        self._sessions.preview(request)

    def change_student(self) -> None:
        """Another one plays: their course is listed, the first lesson of it that they have not finished is chosen."""
        catalog, self._shown = self._sessions.catalog, None
        if not self._has_catalog:
            return
        listed = self.selection.offer(self.selection.lessons, catalog.courses(), self._store.now.course)
        listed = replace(listed, progress=catalog.progress(), levels=catalog.levels(), search="", bars=None)
        self.selection = listed if listed.course is None else listed.follow(listed.course)

    def show_anew(self) -> None:
        """Show the chosen lesson as it is to be played now, or when the result is left; raises `StationError`."""
        request = self.selection.request()
        if self._sessions.practice.stage is not Stage.IDLE:
            self._shown = None
        elif request is not None or self.selection.free:
            self._sessions.preview(request)

    def begin(self, bar: int | None = None) -> None:
        """Begin what is chosen, or practise one `bar` (from 1) of the lesson alone; raises `StationError`."""
        request, free = self.selection.request(), self.selection.free_request()
        if request is not None:
            self._sessions.start(request if bar is None else replace(request, bars=(bar, bar), adapt=False))
        elif free is not None and bar is None:
            self._sessions.just_play(free)
