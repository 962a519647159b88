"""What the user has chosen but not begun: the lesson, its tempo and passes, what the list shows of it."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType

from station.app.model import FreeRequest, LessonCard, SessionRequest
from station.drills.course import Course
from station.practice.control.tap_tempo import TapTempo
from station.practice.records.lesson_progress import LessonProgress

MIN_TEMPO_BPM, MAX_TEMPO_BPM = 30, 260
"""The tempo slider's ends (our choice); a lesson outside widens them."""
MAX_LOOPS = 32


class Selection:
    """The state of the lessons page; `bars` (first, last, from 1) are to be practised, None for the lesson's own."""

    def __init__(self, lessons: Sequence[LessonCard], first: SessionRequest | None = None) -> None:
        """Begin with `first` where it is there, else with the first lesson."""
        self._lessons = tuple(lessons)
        self._first = first
        self._taps = TapTempo()
        self.courses: tuple[Course, ...] = ()
        self.course: Course | None = None
        """The one whose lessons are listed, None for all lessons."""
        self.progress: Mapping[str, LessonProgress] = MappingProxyType({})
        """How far the student is, by the names of lessons."""
        self.search = ""
        self.free = False
        """Whether just playing is chosen, in place of a lesson."""
        self.card: LessonCard | None = None
        self.tempo_bpm = 100.0
        self.loops = 4
        self.bars: tuple[int, int] | None = None
        self.adapt = True
        self.click = first is None or first.click
        if self._lessons:
            named = [card for card in self._lessons if first is not None and card.name == first.lesson]
            self.choose(named[0] if named else self._lessons[0])
            if first is not None and named:
                self.tempo_bpm, self.loops, self.adapt = first.tempo_bpm, first.loops, first.adapt
                self.bars = first.bars

    def offer(self, lessons: Sequence[LessonCard], courses: Sequence[Course] = (), course: str = "") -> None:
        """Choose among these from now on; the lesson that is chosen stays, and `course` is listed if there is one."""
        self._lessons = tuple(lessons)
        self.courses = tuple(courses)
        self.course = next((one for one in self.courses if one.name == course), None)

    def follow(self, course: Course | None) -> None:
        """List a course, and choose its first lesson that is not mastered yet, the last where all are."""
        self.course, self.search = course, ""
        if course is None:
            return
        cards = self.visible()
        ahead = [card for card in cards if not self._is_mastered(card.name)] or cards[-1:]
        if ahead:
            self.choose(ahead[0])

    def mastered(self, course: Course) -> int:
        """How many lessons of a course are mastered."""
        return sum(map(self._is_mastered, course.lesson_names))

    def _is_mastered(self, name: str) -> bool:
        return name in self.progress and self.progress[name].is_mastered

    def choose(self, card: LessonCard) -> None:
        """Take a lesson at the tempo, with the passes and the bars that its author wants."""
        self.free = False
        self.card, self.tempo_bpm, self.loops = card, card.tempo_bpm, min(card.passes, MAX_LOOPS)
        self.bars = None

    def tap(self, at_ns: int, within: tuple[float, float]) -> None:
        """Take a tap of the tempo, in beats of the lesson; a tempo outside `within` beats a minute is the nearest."""
        beats = self._taps.tap(at_ns)
        if beats is not None:
            self.tempo_bpm = min(within[1], max(within[0], beats)) * self.beat_quarters

    @property
    def beat_quarters(self) -> float:
        """How many quarter notes make the beat that is counted."""
        return 1.0 if self.free or self.card is None else self.card.beat_quarters

    def free_wish(self) -> FreeRequest | None:
        """What to begin where just playing is chosen."""
        return FreeRequest(float(self.tempo_bpm), self.click) if self.free else None

    def visible(self) -> list[LessonCard]:
        """The lessons, in a course's order or the list's, whose words contain every word of the search."""
        lessons: Sequence[LessonCard] = self._lessons
        if self.course is not None:
            known = {card.name: card for card in self._lessons}
            lessons = [known[name] for name in self.course.lesson_names if name in known]
        words = self.search.casefold().split()
        return [card for card in lessons if all(word in _text(card) for word in words)]

    def wish(self) -> SessionRequest | None:
        """What to start; None where no lesson is chosen."""
        if self.card is None or self.free:
            return None
        adapt = self.adapt and self.click
        wish = SessionRequest(
            self.card.name, float(self.tempo_bpm), self.loops, self.bars, adapt=adapt, click=self.click
        )
        if self._first is not None and self._first.lesson == self.card.name:
            return replace(wish, demonstrations=self._first.demonstrations)
        return wish


def _text(card: LessonCard) -> str:
    return " ".join([card.title, card.name, card.author, card.level_words, *card.tags]).casefold()
