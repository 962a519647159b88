"""What is made ready before a session: its lesson, the plan as the settings ask for it, what is remembered, the track.

It holds the settings that sessions go by; whoever changes them sets `settings` anew, and what follows goes by those.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import date
from typing import TYPE_CHECKING

from station.app.deck import Watched
from station.app.lesson_cards import all_lessons, card
from station.app.model import LessonCard, Start
from station.core.errors import BadInput, DeviceError
from station.core.settings import Settings, setting_source
from station.drills.course import Course
from station.drills.lesson import Lesson
from station.drills.library import courses_in, find_lesson, shipped_courses
from station.motion.kit import Kit
from station.practice.click import ClickPattern
from station.practice.click_word import parse_click
from station.practice.lead import hands_of
from station.practice.memory import Memory, Remembered
from station.practice.plan import Plan, Wishes, plan_practice
from station.practice.progress import Progress, progress_of
from station.sound.track import PreparedTrack

if TYPE_CHECKING:
    from station.practice.backing import Backing, BackingWish


@dataclass(frozen=True, eq=False)
class LaidOut:
    """A session that can begin; where the tempo follows the student, `followed` lays out what comes after `plan`."""

    plan: Plan
    followed: Remembered | None = None


def _backing_of(wish: "BackingWish") -> "Backing":
    """Its keeper, which comes with libraries of sound: the window opens sooner without."""
    from station.practice.backing import Backing

    return Backing(wish)


class Preparation:
    """Lays out what is wished for by `settings`; sessions whose tempo stays play along to `backing`."""

    def __init__(self, settings: Settings, first: Lesson, backing: "BackingWish | None") -> None:
        self.settings = settings
        self._first = first
        self._shipped: dict[str, Lesson] | None = None
        self._backing = None if backing is None else _backing_of(backing)
        self._courses: Sequence[Course] | None = None
        self.faults: Sequence[BadInput] = ()
        """What was wrong with courses that were left out."""
        self._progress: tuple[str, Mapping[str, Progress]] | None = None

    @property
    def has_tracks(self) -> bool:
        """Whether sessions may play along to a track."""
        return self._backing is not None

    def cards(self) -> Sequence[LessonCard]:
        """Every shipped lesson, those of the user's own courses, and the one that the window was opened on."""
        if self._shipped is None:
            self._shipped = all_lessons(self._first, self.courses())
        return [card(lesson) for lesson in self._shipped.values()]

    def courses(self) -> Sequence[Course]:
        """The user's own courses, then those that ship; a file that cannot be read is left out."""
        if self._courses is None:
            own, self.faults = courses_in(self.settings.courses_dir)
            self._courses = (*own, *shipped_courses())
        return self._courses

    def progress(self) -> Mapping[str, Progress]:
        """How far the student is, by the names of lessons, when a session was kept last."""
        student = self.settings.student
        if self._progress is None or self._progress[0] != student:
            self._progress = student, progress_of(self.settings.sessions_dir, student)
        return self._progress[1]

    def learnt(self) -> None:
        """A session was kept: what is known of the progress is out of date."""
        self._progress = None

    def first_card(self) -> LessonCard:
        """That of the lesson that the window was opened on; no other needs to be read for it."""
        return card(self._first)

    def lesson(self, name: str) -> Lesson:
        """The lesson of a name or a file; raises `BadInput`."""
        known = {self._first.name: self._first} | (self._shipped or {})
        return known.get(name) or find_lesson(name)

    def laid_out(self, wish: Start) -> LaidOut:
        """What is wished for, from what is remembered where the tempo follows; raises `StationError`."""
        lesson, settings = self.lesson(wish.lesson), self.settings
        tempo_bpm = None if wish.adapt else wish.tempo_bpm
        click = self._click() if wish.click else None
        hands = hands_of(settings)
        wishes = Wishes(tempo_bpm, wish.loops, wish.bars, wish.demonstrations, click, settings.guide, hands)
        plan = plan_practice(lesson, wishes)
        if not wish.adapt:
            return LaidOut(plan)
        memory = Memory.of(settings.sessions_dir, settings.student, lesson.name, plan.bars)
        followed = Remembered.of(lesson, wishes, date.today(), memory)
        return LaidOut(followed.adaptation.plan, followed)

    def watched(self, lesson: Lesson, kit: Kit) -> Watched:
        """The lesson as its demonstration is played; raises `BadInput` for a click that is none."""
        return Watched(lesson, kit, hands_of(self.settings), self._click())

    def track(self, plan: Plan, rate_hz: int) -> PreparedTrack | None:
        """The track to play along to; raises `DeviceError` while it is being made ready, `BadInput` if it cannot be."""
        if self._backing is None:
            return None
        self._backing.ask(plan, rate_hz)
        track = self._backing.take()
        if track is None:
            raise DeviceError("the track is being made ready for this tempo: start again in a moment")
        return track

    def _click(self) -> ClickPattern:
        return parse_click(self.settings.click_pattern, setting_source("click_pattern"))
