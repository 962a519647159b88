"""Craft from end to end: played wrong on purpose by a virtual student, told rightly by the report of the session."""

from typing import Any

import pytest

from station.core.settings import Settings
from station.drills.library import find_lesson
from station.practice.headless.virtual_session import practise_virtually
from station.practice.records.report.session_report import practice_document, report_text, with_truth
from station.practice.session.plan import PlanOptions, plan_practice
from station.simulation.student_spec import parse_spec

SETTINGS = Settings(student="Ida")
HUMAN = "seed=3,sd_ms=8,velocity_sd=4"


def practised(lesson: str, spec: str) -> dict[str, Any]:
    plan = plan_practice(find_lesson(lesson), PlanOptions(demonstrations=0, loops=4))
    virtual = practise_virtually(plan, parse_spec(spec))
    return with_truth(practice_document(virtual.result, SETTINGS), virtual, SETTINGS)


def strokes_of(document: dict[str, Any]) -> int:
    """How many strokes the planted habit concerned, by the student's own account."""
    (fault,) = document["truth"]["faults"]
    return int(fault["strokes"])


@pytest.mark.parametrize("lesson", ["disco-1", "stops-1", "multiple-bounce-roll"])
def test_what_is_played_rightly_is_told_so(lesson: str) -> None:
    craft = practised(lesson, HUMAN)["craft"]
    if lesson == "disco-1":
        assert 0 < craft["hats"]["judged"] == craft["hats"]["right"]
    if lesson == "stops-1":
        assert 0 < craft["chokes"]["judged"] == craft["chokes"]["made"]
        assert craft["chokes"]["ring_ms"]["mean"] == pytest.approx(0.0, abs=10.0)
    if lesson == "multiple-bounce-roll":  # a module that sends one hit a roll tells nothing of its bounces
        assert craft["buzz_rolls"]["continuous"] is None


def test_an_open_hat_where_a_closed_one_is_written() -> None:
    right, wrong = practised("disco-1", HUMAN), practised("disco-1", f"{HUMAN},fault=open_hats:0.6")
    hats = wrong["craft"]["hats"]
    assert hats["judged"] - hats["right"] == strokes_of(wrong) > 0
    assert wrong["score"] < right["score"]
    assert f"Hi-hat: {hats['right']} of {hats['judged']} as open as written" in report_text(wrong)


def test_a_cymbal_that_is_grabbed_late() -> None:
    late = practised("stops-1", f"{HUMAN},fault=late_grabs:60")
    chokes = late["craft"]["chokes"]
    assert chokes["made"] == strokes_of(late) > 0
    assert chokes["ring_ms"]["mean"] == pytest.approx(60.0, abs=10.0)
    assert "ms late" in next(line for line in report_text(late).splitlines() if line.startswith("Grabbed"))


def test_a_cymbal_that_rings_on() -> None:
    """Grabbed 400 ms late, which is beyond 250 ms, and no other grab is written near by."""
    right, never = practised("stops-1", HUMAN), practised("stops-1", f"{HUMAN},fault=late_grabs:400")
    assert never["craft"]["chokes"]["made"] == 0
    assert never["score"] < right["score"]


@pytest.mark.parametrize("short_ms", [1.0, 60.0])
def test_a_buzz_that_ends_early(short_ms: float) -> None:
    document = practised("multiple-bounce-roll", f"{HUMAN},fault=short_buzz:{short_ms}")
    buzz = document["craft"]["buzz_rolls"]
    assert buzz["judged"] == buzz["continuous"] == strokes_of(document) > 0
    assert buzz["end_ms"]["mean"] == pytest.approx(-short_ms, abs=30.0)  # the bounces are 30 ms apart
    assert document["counts"] == document["truth"]["counts"], "bounces are nobody's, in both accounts"
