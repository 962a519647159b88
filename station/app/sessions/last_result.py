"""What the last session left: its report, the question before it, its curves, and its bars to be heard again.

A student who first judges their own error learns more (`practice.session.self_estimate`): while the question is open
nothing of the result is shown.
"""

from bisect import bisect_right
from collections.abc import Mapping

from station.app.room_state import ShownResult
from station.app.sessions.shown_result import SavedSession
from station.drills.exam.rubric import Marks
from station.practice.demonstration.compare_by_ear import (
    Whose,
    bar_by_ear,
    previous_bar,
    previous_tempo,
    students_bar,
)
from station.practice.records.report.next_steps import NextStep
from station.practice.session.cues.listening import Listening
from station.practice.session.self_estimate import QUESTION, SelfEstimate, answered, is_worth_asking
from station.render.snapshot import Snapshot
from station.scenes.comparison import Comparison, Replayed
from station.scenes.curves import ScoreCurves
from station.scenes.demonstrator import Demonstrator
from station.scenes.session_scene import result_curves


class LastResult:
    """The session that ended last, none at first; `is_asking` while its question is open."""

    def __init__(self) -> None:
        self._saved: SavedSession | None = None
        self._curves: ScoreCurves | None = None
        self._asked: set[str] = set()
        self._compared: Comparison | None = None
        self._from_ns = 0
        self.is_asking = False

    def keep(self, saved: SavedSession, may_ask: bool) -> None:
        """From now on this is the last one; a question is opened where the student `may` be asked one."""
        self.put(saved)
        self.is_asking = may_ask and self._is_new(saved.result.plan.lesson.name, saved.report.document)

    def _is_new(self, lesson: str, document: Mapping[str, object]) -> bool:
        """Whether to ask: at most once a lesson, and only what the report can answer."""
        if lesson in self._asked or not is_worth_asking(document):
            return False
        self._asked.add(lesson)
        return True

    @property
    def question(self) -> str:
        """What is to be answered first, empty where nothing is."""
        return QUESTION if self.is_asking else ""

    @property
    def report(self) -> ShownResult | None:
        """What may be shown of it now."""
        return None if self.is_asking or self._saved is None else self._saved.report

    @property
    def saved(self) -> SavedSession | None:
        """The session that ended last."""
        return self._saved

    @property
    def lag_ms(self) -> float | None:
        """The lag that it leaves out until somebody has said whose it is."""
        fair = None if self._saved is None else self._saved.fair
        return fair.lag.found.lag_ms if fair is not None and fair.is_open and fair.lag is not None else None

    def put(self, saved: SavedSession) -> None:
        """The same session, judged again."""
        self._saved, self._curves, self._compared = saved, None, None

    @property
    def steps(self) -> tuple[NextStep, ...]:
        """What comes next, the best first; none while the question is open."""
        return () if self.is_asking or self._saved is None else self._saved.steps

    @property
    def marks(self) -> Marks | None:
        """The marks where it was an exam."""
        return None if self._saved is None else self._saved.marks

    def answer(self, guess: SelfEstimate) -> str | None:
        """Close the question; returns the guess beside what was measured, None where nothing was asked."""
        if not self.is_asking or self._saved is None:
            return None
        self.is_asking = False
        return answered(guess, self._saved.report.document)

    def leave(self) -> None:
        """The student turns to something else: a question stays unanswered."""
        self.is_asking = False

    def curves(self, demonstrator: Demonstrator) -> ScoreCurves | None:
        """The whole of it as the graph shows it, demonstrated by `demonstrator`, once it may be seen."""
        if self._curves is None and self._saved is not None and not self.is_asking:
            self._curves = result_curves(self._saved.result, demonstrator)
        return self._curves

    def hear(self, bar: int, whose: Whose, demonstrator: Demonstrator) -> Listening | None:
        """A bar (from 0) of its score to be heard, and seen as `demonstrator` plays it; None where there is none."""
        if self._saved is None or self.is_asking:
            return None
        result, before = self._saved.result, self._saved.report.before
        played, shown = None, Replayed("the teacher")
        if whose is Whose.STUDENT:
            played = students_bar(result, bar)
            number = bisect_right(result.plan.pass_starts, bar)
            which = f", pass {number} of {result.plan.passes}" if result.plan.passes > 1 else ""
            shown = Replayed(f"{self._saved.report.student or 'you'}{which}")
        elif whose is Whose.PREVIOUS:
            if isinstance(before, str):
                return None
            played = previous_bar(result, bar, before)
            shown = Replayed(f"you, {before.day}", previous_tempo(result, bar, before))
        self._compared = Comparison(result, bar, played, demonstrator, shown, whose is Whose.STUDENT)
        listening = bar_by_ear(result, bar, played)
        self._from_ns = listening.from_ns
        return listening

    def compared(self, heard_ns: int | None) -> Snapshot | None:
        """The picture of what is heard, at its place in the result's score; None before it has begun there."""
        if self._compared is None:
            return None
        return self._compared.snapshot(self._from_ns if heard_ns is None else heard_ns)
