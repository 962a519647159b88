"""Practice with the click on every shipped lesson: the report against what the virtual student knows that it did."""

from zlib import crc32

import pytest

from station.drills.library import lesson_names
from station.music.judgement import Label
from station.practice.records.report.session_report import feel_of
from station.practice.session.plan import PlanOptions, plan_practice
from station.scoring.align import align
from station.scoring.analysis.summary import SummaryView, summarise
from station.simulation.student_spec import parse_spec
from station.simulation.virtual_student import play
from tests.shipped_lesson import shipped_lesson

SPEC = "seed={seed},sd_ms=12,bias_ms=-8,miss_pct=3,extra_pct=2"

PASSES = 4
"""Half of what a lesson asks for: a seed of its own for every lesson shows more than the same one for longer."""


@pytest.mark.parametrize("lesson", lesson_names())
def test_counts_and_timing_are_the_truth(lesson: str) -> None:
    score = plan_practice(shipped_lesson(lesson), PlanOptions(loops=PASSES)).score
    allowed = max(1.0, 0.01 * len(score))
    student = play(score, parse_spec(SPEC.format(seed=crc32(lesson.encode()))))
    alignment = align(score, student.performance, clocked=True)
    for label in (Label.MISS, Label.EXTRA):
        assert abs(alignment.count(label) - student.truth.count(label)) <= allowed
    told, true_ms = summarise(score, student.performance, alignment).timing, student.asynchrony_ms()
    assert told.mean_ms == pytest.approx(float(true_ms.mean()), abs=1.0)
    assert told.sd_ms == pytest.approx(float(true_ms.std(ddof=1)), abs=1.0)


@pytest.mark.parametrize("lesson", lesson_names())
def test_who_plays_exactly_what_is_written_has_100(lesson: str) -> None:
    """Openness, grabbed cymbals and grace strokes among it, as a General MIDI kit tells them."""
    found = shipped_lesson(lesson)
    score = plan_practice(found, PlanOptions(loops=1)).score
    student = play(score, parse_spec("seed=1,sd_ms=0,velocity_sd=0"))
    alignment = align(score, student.performance, clocked=True)
    assert summarise(
        score, student.performance, alignment, SummaryView(feel=feel_of(found.goals))
    ).points == pytest.approx(100)
