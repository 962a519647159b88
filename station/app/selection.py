"""What is chosen but not begun: the lesson, its tempo and passes, which lessons are listed. A value."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from operator import attrgetter
from types import MappingProxyType

from station.app.room_state import FreeRequest, LessonCard, SessionRequest
from station.drills.course import Course
from station.drills.daily.daily_items import DailyItem
from station.practice.records.lesson_order import first_words, is_finished, is_mastered
from station.practice.records.lesson_progress import LessonProgress
from station.practice.session.cues.quiet_bars import QuietBars, gap_of
from station.practice.session.rising_tempo import Rise, rise_of
from station.scoring.matching.hit_windows import Level

MIN_TEMPO_BPM, MAX_TEMPO_BPM = 30, 260
"""The tempo slider's ends (our choice); a lesson outside widens them."""
MAX_LOOPS = 32


OWN = "Your own"
"""What lessons are called that do not ship."""


@dataclass(frozen=True, slots=True)
class LessonGroup:
    """Lessons that are listed under one `title`: a kind, or a part of a course (empty: it has no parts)."""

    title: str
    cards: tuple[LessonCard, ...]


@dataclass(frozen=True, slots=True)
class Selection:
    """What the lessons page shows: of `lessons` the `card` that is chosen, or `free`, just playing, in its place.

    `course` is the one whose lessons are listed, None for all; `progress` how far the student is and `levels` how
    strictly they are judged where they chose it or came to it, by the names of lessons; `bars` (first, last, from 1)
    are to be practised, None for the lesson's own; `first` what the window was opened on. With `gap` the click falls
    silent in some bars, with `rise` the tempo rises; both hold for the lesson that is chosen.
    """

    lessons: tuple[LessonCard, ...] = ()
    first: SessionRequest | None = None
    courses: tuple[Course, ...] = ()
    course: Course | None = None
    progress: Mapping[str, LessonProgress] = field(default_factory=lambda: MappingProxyType({}))
    levels: Mapping[str, Level] = field(default_factory=lambda: MappingProxyType({}))
    search: str = ""
    free: bool = False
    card: LessonCard | None = None
    tempo_bpm: float = 100.0
    loops: int = 4
    bars: tuple[int, int] | None = None
    adapt: bool = True
    click: bool = True
    gap: QuietBars | None = None
    rise: Rise | None = None

    @classmethod
    def of(cls, lessons: Sequence[LessonCard], first: SessionRequest | None = None) -> "Selection":
        """Begin with `first` where it is there, else with the first lesson."""
        selection = cls(tuple(lessons), first, click=first is None or first.click)
        if not lessons:
            return selection
        named = [card for card in lessons if first is not None and card.name == first.lesson]
        selection = selection.choose(named[0] if named else lessons[0])
        if first is None or not named:
            return selection
        asked = replace(selection, tempo_bpm=first.tempo_bpm, loops=first.loops, adapt=first.adapt)
        return replace(asked, bars=first.bars, gap=first.gap, rise=first.rise)

    def offer(self, lessons: Sequence[LessonCard], courses: Sequence[Course] = (), course: str = "") -> "Selection":
        """Choose among these from now on; the lesson that is chosen stays, and `course` is listed if there is one."""
        followed = next((one for one in courses if one.name == course), None)
        return replace(self, lessons=tuple(lessons), courses=tuple(courses), course=followed)

    def follow(self, course: Course | None) -> "Selection":
        """List a course, and choose its first lesson that is not finished yet, the last where all are."""
        listed = replace(self, course=course, search="")
        if course is None:
            return listed
        cards = listed.visible()
        ahead = [card for card in cards if not self._is_finished(course, card)] or cards[-1:]
        return listed.choose(ahead[0]) if ahead else listed

    def finished(self, course: Course, names: Sequence[str] | None = None) -> int:
        """How many lessons of a course are, all of it or of those `names`."""
        wanted = set(course.lesson_names if names is None else names)
        return sum(self._is_finished(course, card) for card in self.lessons if card.name in wanted)

    def _is_finished(self, course: Course, card: LessonCard) -> bool:
        return is_finished(course, card.name, self.progress, card.levels)

    def mastered(self, cards: Sequence[LessonCard]) -> int:
        """How many of some lessons are, at any level."""
        return sum(is_mastered(card.name, self.progress) for card in cards)

    def first_words(self, card: LessonCard) -> list[str]:
        """A line for each lesson that should come before: its title, and whether it is mastered."""
        titles = {each.name: each.title for each in self.lessons}
        return first_words(card.prerequisites, self.progress, lambda name: titles.get(name, name))

    def choose(self, card: LessonCard) -> "Selection":
        """Take a lesson at the tempo, with the passes and the bars that its author wants."""
        loops = min(card.passes, MAX_LOOPS)
        chosen = replace(self, free=False, card=card, tempo_bpm=card.tempo_bpm, loops=loops)
        return replace(chosen, bars=None, gap=None, rise=None)

    @property
    def level(self) -> Level | None:
        """How strictly the chosen lesson is judged, None where none is chosen."""
        return None if self.card is None else self.card.levels.level(reached=self.levels.get(self.card.name))

    def for_block(self, item: DailyItem) -> "Selection":
        """A block of the day's plan; the same where its lesson is not offered."""
        if not item.lesson:
            return replace(self, free=True)
        named = [card for card in self.lessons if card.name == item.lesson]
        if not named:
            return self
        chosen = replace(self.choose(named[0]), search="")
        return replace(
            chosen,
            tempo_bpm=item.beats_a_minute * chosen.beat_quarters,
            loops=min(item.passes, MAX_LOOPS),
            bars=(item.bars[0] + 1, item.bars[1] + 1),
            adapt=item.follows,
            click=True,
            gap=gap_of(item.gap) if item.gap and not item.follows else None,
            rise=rise_of(item.rise) if item.rise else None,
        )

    def at_beats(self, beats_a_minute: float) -> "Selection":
        """At a tempo in the beat that is counted; one that the slider does not reach is the nearest."""
        low, high = self.tempo_range
        return replace(self, tempo_bpm=min(high, max(low, beats_a_minute)) * self.beat_quarters)

    @property
    def tempo_range(self) -> tuple[int, int]:
        """The ends of the tempo's slider, in beats a minute."""
        beats = 100.0 if self.free or self.card is None else self.card.beats_a_minute
        return min(MIN_TEMPO_BPM, int(beats)), max(MAX_TEMPO_BPM, int(beats) + 1)

    @property
    def beats_a_minute(self) -> float:
        """The tempo in the beat that is counted."""
        return self.tempo_bpm / self.beat_quarters

    @property
    def beat_quarters(self) -> float:
        """How many quarter notes make the beat that is counted."""
        return 1.0 if self.free or self.card is None else self.card.beat_quarters

    def free_request(self) -> FreeRequest | None:
        """What to begin where just playing is chosen."""
        return FreeRequest(float(self.tempo_bpm), self.click) if self.free else None

    def groups(self) -> list[LessonGroup]:
        """The lessons whose words contain every word of the search: by kinds, or by the parts of a course, in order."""
        named = self._by_kind() if self.course is None else self._by_part(self.course)
        words = self.search.casefold().split()
        found = [(title, tuple(card for card in cards if _has(card, words))) for title, cards in named]
        return [LessonGroup(title, cards) for title, cards in found if cards]

    def _by_kind(self) -> list[tuple[str, list[LessonCard]]]:
        kinds: dict[str, list[LessonCard]] = {}
        for card in self.lessons:
            kinds.setdefault(card.kind, []).append(card)
        by_level = attrgetter("level")  # the newest of one's own come first within their level
        return [(kind.capitalize() or OWN, sorted(cards, key=by_level)) for kind, cards in kinds.items()]

    def _by_part(self, course: Course) -> list[tuple[str, list[LessonCard]]]:
        known = {card.name: card for card in self.lessons}
        return [(part.title, [known[name] for name in part.lesson_names if name in known]) for part in course.parts]

    def visible(self) -> list[LessonCard]:
        """The lessons of all groups."""
        return [card for group in self.groups() for card in group.cards]

    def request(self) -> SessionRequest | None:
        """What to start; None where no lesson is chosen."""
        if self.card is None or self.free:
            return None
        adapt = self.adapt and self.click and not self.card.is_song
        rise = self.rise if self.click and not adapt else None
        request = SessionRequest(
            self.card.name,
            float(self.tempo_bpm),
            self.loops,
            self.bars,
            adapt=adapt,
            click=self.click,
            gap=self.gap,
            rise=rise,
        )
        if self.first is not None and self.first.lesson == self.card.name:
            return replace(request, demonstrations=self.first.demonstrations)
        return request


def _has(card: LessonCard, words: Sequence[str]) -> bool:
    return all(word in _text(card) for word in words)


def _text(card: LessonCard) -> str:
    return " ".join([card.title, card.name, card.kind, card.author, card.level_words, *card.tags]).casefold()
