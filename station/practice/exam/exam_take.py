"""One take: the plan of it, the runner that shows nothing while it is played, and its marks afterwards.

The piece is played once from beginning to end, after a count-in and with the click, and nothing is demonstrated. Who
stops early is marked over the whole piece.
"""

import numpy as np

from station.core.settings import Settings
from station.drills.exam.exam_marks import ExamTake, marks_of
from station.drills.exam.exam_piece import ExamPiece
from station.drills.exam.rubric import Criterion, Marks, Rubric, rubric_of
from station.drills.mastery.feedback_fading import Feedback
from station.engine.engine import KEYBOARD
from station.practice.records.report.session_report import feel_of
from station.practice.session.adaptation import Adaptation
from station.practice.session.device_latency import Latency
from station.practice.session.leading_hand import hands_of
from station.practice.session.plan import Plan, PlanOptions, plan_practice
from station.practice.session.runner import SessionRunner
from station.practice.session.session import SessionResult
from station.scoring.align import align
from station.scoring.matching.unheard import known_part, notes_within, with_unknown


def exam_plan(piece: ExamPiece, settings: Settings) -> Plan:
    """The take laid out: the whole piece once; raises `BadInput` for a tempo that cannot be."""
    bars = (1, piece.lesson.score.bar_count)
    hands, stands = hands_of(settings), settings.stands
    options = PlanOptions(piece.tempo_bpm, 1, bars, 0, hands=hands, level=piece.rubric.level, stands=stands)
    return plan_practice(piece.lesson, options)


def exam_runner(asked: Plan | Adaptation, latency: Latency) -> SessionRunner:
    """What plays it: nothing is shown of what was right or wrong, nothing pauses."""
    runner = SessionRunner(asked, latency)
    runner.session.feedback = Feedback.NONE
    return runner


def exam_marks(piece: ExamPiece, result: SessionResult) -> Marks:
    """The marks of the take, over the whole piece wherever it ended, but for what could not be heard."""
    plan = result.plan
    alignment = align(plan.score, result.performance, clocked=plan.click is not None)
    alignment = with_unknown(alignment, notes_within(plan.score, result.unheard))
    score, alignment, _ = known_part(plan.score, alignment)
    bars = np.array(plan.practised_bars)[score.bar]
    take = ExamTake(score, bars, result.performance, alignment, feel_of(piece.lesson.goals))
    return marks_of(_heard(piece.rubric, result.device), take)


def _heard(rubric: Rubric, device: str | None) -> Rubric:
    """The rubric without loudness where computer keys were played, which have none."""
    asked = any(line.criterion is Criterion.LOUDNESS for line in rubric.lines)
    return rubric_of(rubric.level, asked and device != KEYBOARD)
