"""Who demonstrates a lesson: made when asked for, or beside what goes on where a lesson changes while it plays."""

from concurrent.futures import Executor, Future
from dataclasses import dataclass
from functools import cached_property

from station.drills.lesson import Lesson
from station.motion.drummer import Drummer
from station.motion.kit.kit import Kit
from station.motion.sticking.hand_notes import Hands
from station.motion.style.style import Style
from station.music.score import Score
from station.practice.session.cues.click_pattern import PLAIN, ClickPattern
from station.practice.session.leading_hand import with_sticking
from station.scenes.demonstrator import Demonstrator, as_taught


@dataclass(frozen=True, eq=False)
class DemonstratedLesson:
    """What is demonstrated: a lesson, on which kit and by whose leading hand, and what clicks."""

    lesson: Lesson
    kit: Kit
    hands: Hands | None = None
    click: ClickPattern = PLAIN

    @cached_property
    def score(self) -> Score:
        """The whole lesson at its own tempo, and its landing."""
        return self.lesson.played_once


@dataclass(frozen=True, eq=False)
class _Coming:
    """A drummer who is being made: of which score, in which style."""

    made: Future[Drummer]
    score: Score
    style: Style


class DemoDrummer:
    """Who plays the `watched` lesson as `demonstrator`; `maker` makes the next one where the lesson is revised."""

    def __init__(self, watched: DemonstratedLesson, demonstrator: Demonstrator, maker: Executor | None) -> None:
        self._watched, self._demonstrator, self._maker = watched, demonstrator, maker
        self._drummer: Drummer | None = None
        self._coming: _Coming | None = None
        self._style = demonstrator.style
        self.score = watched.score
        """What the drummer plays; of a revised lesson the score before, until the next one is ready."""

    def take(self, watched: DemonstratedLesson) -> None:
        """Play this lesson from now on; the same one on the same kit by the same hands stays theirs."""
        before, self._watched = self._watched, watched
        if watched.lesson is not before.lesson or watched.hands != before.hands or watched.kit != before.kit:
            self._dismiss()

    def revise(self, watched: DemonstratedLesson) -> None:
        """Have a drummer made who plays the lesson as it is now; the one before plays until then."""
        self._watched = watched
        if self._coming is not None:
            self._coming.made.cancel()
        self._coming = None
        if self._maker is None or self._drummer is None:
            self._dismiss()
            return
        made = self._maker.submit(_drummer_of, watched, self._demonstrator)
        self._coming = _Coming(made, watched.score, self._demonstrator.style)

    def perform_as(self, demonstrator: Demonstrator) -> None:
        """Let another body or manner demonstrate from now on."""
        if demonstrator.figure is not self._demonstrator.figure:
            self._dismiss()
        self._demonstrator = demonstrator

    def advance(self) -> None:
        """Let the drummer play who is ready now."""
        coming = self._coming
        if coming is not None and coming.made.done():
            self._drummer, self.score, self._style = coming.made.result(), coming.score, coming.style
            self._coming = None

    def now(self) -> Drummer:
        """Who plays the whole lesson, in the present style; made, and made anew, where need be."""
        style = self._demonstrator.style
        if self._drummer is None:
            self._drummer, self.score = _drummer_of(self._watched, self._demonstrator), self._watched.score
            self._style = style
        if self._style is not style:
            self._style = style
            self._drummer = self._drummer.with_style(as_taught(style, self._watched.lesson.cues))
        return self._drummer

    def _dismiss(self) -> None:
        """Nobody plays: who does is made when asked for."""
        self._drummer = self._coming = None


def _drummer_of(watched: DemonstratedLesson, demonstrator: Demonstrator) -> Drummer:
    """Who plays a whole lesson."""
    score = with_sticking(watched.score, watched.kit, watched.hands)
    style = as_taught(demonstrator.style, watched.lesson.cues)
    return Drummer(score, watched.kit, demonstrator.figure, style)
