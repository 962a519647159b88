"""A drummer who plays a part of a session: its demonstrations, or its passes.

To plan a drummer takes about a tenth of a second for two bars; asked to be made `ahead`, one is planned on a thread
of its own, while the part before is played or counted in: no frame waits for it, nor does a window that closes.
"""

from collections.abc import Callable
from concurrent.futures import Future
from queue import SimpleQueue
from threading import Thread
from typing import TypeVar

from station.core.units import NS_PER_S
from station.motion.drummer import Drummer
from station.motion.style.automation_lanes import in_passes
from station.motion.style.style import Style
from station.music.score import Score
from station.practice.session.plan import Plan
from station.scenes.demonstrator import Demonstrator, as_taught
from station.scenes.score_words import bar_numbers

Made = TypeVar("Made")


class Ahead:
    """Makes drummers one after the other: two at once would only take each other's time.

    On a thread that the end of the program does not wait for, unlike those of `concurrent.futures`: a long drummer
    takes seconds, and nobody wants it any more.
    """

    def __init__(self) -> None:
        self._asked: SimpleQueue[Callable[[], None]] = SimpleQueue()
        self._thread: Thread | None = None

    def submit(self, make: Callable[[], Made]) -> Future[Made]:
        """What `make` will have made."""
        if self._thread is None:
            self._thread = Thread(target=self._work, name="drummer", daemon=True)
            self._thread.start()
        coming: Future[Made] = Future()
        self._asked.put(lambda: _complete(coming, make))
        return coming

    def _work(self) -> None:
        while True:
            self._asked.get()()


def _complete(coming: Future[Made], make: Callable[[], Made]) -> None:
    try:
        coming.set_result(make())
    except Exception as fault:  # it is raised where the drummer is wanted
        coming.set_exception(fault)


AHEAD = Ahead()


class SessionPart:
    """The drummer of the plan's section `times` times and its landing, who begins at `start_ns` of the transport."""

    def __init__(self, plan: Plan, score: Score, start_ns: int, demonstrator: Demonstrator) -> None:
        self.score = score
        self.start_ns = start_ns
        self._plan, self._demonstrator = plan, demonstrator
        self._bars = plan.first_bar, plan.section.bar_count, score.bar_count // plan.section.bar_count
        self.bar_numbers = bar_numbers(plan.lesson.sections, *self._bars)
        """The lesson's own numbers in every pass."""
        self._style = demonstrator.style
        self._drummer: Drummer | None = None
        self._coming: Future[Drummer] | None = None

    def ahead(self) -> None:
        """Let the drummer be made meanwhile."""
        if self._drummer is None and self._coming is None:
            self._coming = AHEAD.submit(self._made)

    @property
    def is_ready(self) -> bool:
        """Whether nobody has to wait for the drummer, who was not asked for ahead, or is made."""
        return self._coming is None or self._coming.done()

    @property
    def is_made(self) -> bool:
        """Whether there is a drummer."""
        return self._drummer is not None or (self._coming is not None and self._coming.done())

    def drummer(self, style: Style) -> Drummer:
        """The drummer in that style, made now if need be; what a change does not touch is not made again."""
        if self._drummer is None:
            self._drummer = self._made() if self._coming is None else self._coming.result()
        if style is not self._style:
            self._style, self._drummer = style, self._drummer.with_style(self._of_all_passes(style))
        return self._drummer

    def position_s(self, transport_ns: int) -> float:
        """Where in the score a transport time is."""
        return (transport_ns - self.start_ns) / NS_PER_S

    def _made(self) -> Drummer:
        style = self._of_all_passes(self._demonstrator.style)
        return Drummer(self.score, self._plan.kit, self._demonstrator.figure, style)

    def _of_all_passes(self, style: Style) -> Style:
        """The style as the lesson's teacher changes it, over the bars of the score."""
        return in_passes(as_taught(style, self._plan.lesson.cues), *self._bars)
