"""A result as it is shown: one's own when a session is over, a student's when their return is opened."""

from dataclasses import dataclass, replace
from datetime import date

from station.app.room_state import ShownResult
from station.core.errors import StationError
from station.drills.exam.rubric import Marks
from station.practice.lag.fair_judgement import FairResult
from station.practice.records.previous_session import NONE_KEPT, PreviousSession
from station.practice.records.report.next_steps import NextStep, with_block
from station.practice.session.session import SessionResult
from station.scenes.heat_map import heat_map
from station.scenes.hit_table import every_hit
from station.scenes.result_tables import session_facts
from station.scenes.wrong_pads import wrong_pads
from station.scoring.report.assessment_document import Json


@dataclass(frozen=True, eq=False)
class SavedSession:
    """What a session that is over leaves: its `result`, the `report` of it, and what went wrong, if anything did.

    `marks` are those of an exam, `fair` is how it was judged where a lag was looked for, `steps` what comes next, the
    best first, none of an exam or of another student.
    """

    result: SessionResult
    report: ShownResult
    fault: StationError | None = None
    marks: Marks | None = None
    fair: FairResult | None = None
    steps: tuple[NextStep, ...] = ()

    def leading_to(self, block: NextStep) -> "SavedSession":
        """The same as a block of the day's plan, which has another behind it: that comes first, on the page too."""
        words = self.report.facts.words
        advice = (f"{block.label}.", *words.advice)[: max(len(words.advice), 1)]
        facts = replace(self.report.facts, words=replace(words, advice=advice))
        return replace(self, report=replace(self.report, facts=facts), steps=with_block(self.steps, block))


def shown_result(
    result: SessionResult,
    document: dict[str, Json],
    folder: str = "",
    before: PreviousSession | str = NONE_KEPT,
    student: str = "",
    day: date | None = None,
) -> ShownResult:
    """The `result` with the `document` of it in `folder`; `student` is who played, empty for whoever sits here.

    `day` is when, of a session of another day that they played themselves.
    """
    return ShownResult(
        facts=session_facts(result, document),
        document=document,
        folder=folder,
        heat=heat_map(result),
        hits=every_hit(result),
        before=before,
        wrong_pads=wrong_pads(result),
        student=student,
        day=day,
    )
