"""A lesson file that asks something of a hand and of a fill, practised by virtual students: what the report says."""

import re
from datetime import date
from pathlib import Path

import pytest

from station.core.settings import Settings
from station.drills.lesson import Lesson
from station.drills.reading.lesson_file import parse_lesson
from station.practice.headless.virtual_session import practise_adaptively, practise_virtually
from station.practice.records.report.session_report import practice_document, report_text
from station.practice.session.adaptation import Adaptation
from station.practice.session.plan import PlanOptions, plan_practice
from station.scoring.report.assessment_document import Json
from station.simulation.student_spec import parse_spec

IDA = Settings(student="Ida")
ASKS = """
title = "Groove and fill"
tempo_bpm = 90
[goals]
level = "beginner"
[goals.left_hand]
max_loudness_error_db = 3
[[goals.bars]]
bars = [2, 2]
max_lean_ms = 20
[hints]
late_kick = "Heel up."
[[grid]]
name = "groove"
hihat    = "xxxx xxxx"
snare    = "--O- --O-"
sticking = "RRBR RRBR"
kick     = "o--- o---"
[[grid]]
name = "fill"
snare    = "ooOo ooOo"
sticking = "RRLR RRLR"
kick     = "o--- o---"
"""


def lesson() -> Lesson:
    reading = parse_lesson(ASKS, "asks.toml", "asks")
    assert reading.faults == []
    assert reading.lesson is not None
    return reading.lesson


def practised(spec: str) -> dict[str, Json]:
    plan = plan_practice(lesson(), PlanOptions(loops=12, demonstrations=0))
    return practice_document(practise_virtually(plan, parse_spec(spec)).result, IDA)


def missed(document: dict[str, Json]) -> list[tuple[object, object]]:
    session = document["session"]
    assert isinstance(session, dict)
    assert isinstance(session["goals_missed"], list)
    return [(one["goal"], one["part"]) for one in session["goals_missed"] if isinstance(one, dict)]


@pytest.mark.parametrize(
    ("spec", "expected"),
    [
        ("sd_ms=4,seed=1", []),
        ("sd_ms=4,seed=1,fault=weak_left:10", [("loudness", "left hand")]),
        ("sd_ms=4,seed=1,bias_ms=30", [("lean", "fill (bar 2)")]),
    ],
)
def test_a_goal_is_missed_by_the_part_that_misses_it(spec: str, expected: list[tuple[str, str]]) -> None:
    """A steady student reaches all; one whose left hand is soft, and one who plays 30 ms late, miss what they miss."""
    assert missed(practised(spec)) == expected


def test_the_report_says_the_part_and_the_figure() -> None:
    text = report_text(practised("sd_ms=4,seed=1,bias_ms=30"))
    assert re.search(r"\* In fill \(bar 2\) you are (29|30|31) ms late on average; the goal is 20\.", text)


def test_the_hint_follows_its_advice_in_the_report() -> None:
    document = practised("sd_ms=4,seed=1,fault=late_kick:45")
    assert "then add the rest. Heel up.\n" in report_text(document)
    advice = document["advice"]
    assert isinstance(advice, list)
    assert [one["hint"] for one in advice if isinstance(one, dict)] == ["Heel up."]


def test_a_pass_that_misses_a_parts_goal_is_not_clean_and_says_why() -> None:
    adaptation = Adaptation(lesson(), PlanOptions(loops=2, demonstrations=0), date(2026, 3, 1))
    practise_adaptively(adaptation, parse_spec("sd_ms=4,seed=1,fault=weak_left:10"))
    assert adaptation.rounds[1].step.why.startswith("Left hand: ")


def test_prerequisites_are_looked_for_beside_the_file(tmp_path: Path) -> None:
    from station.app.toml_files import check_files

    for name, before in (("one", "rock-1"), ("two", "one"), ("three", "tow"), ("four", "five"), ("five", "four")):
        (tmp_path / f"{name}.toml").write_text(f'prerequisites = ["{before}"]{ASKS}')
    faults, _ = check_files([str(tmp_path)])
    assert [(Path(one.source).stem, one.line, one.column, one.text) for one in faults] == [
        ("five", 1, 18, "prerequisites: a circle: five needs four needs five"),
        ("three", 1, 18, "prerequisites: no such lesson: tow; did you mean two?"),
    ]
