"""A click that falls silent in turn, from the wish to the report."""

from argparse import ArgumentTypeError
from dataclasses import replace
from typing import Any

import pytest

from station.cli.input.read_scores import bars_of_gap
from station.core.settings import Settings
from station.drills.library import find_lesson
from station.practice.headless.virtual_session import practise_virtually
from station.practice.records.report.session_report import practice_document
from station.practice.session.cues.click_pattern import PLAIN
from station.practice.session.cues.quiet_bars import Gap, QuietBars
from station.practice.session.plan import PlanOptions, plan_practice
from station.simulation.student_spec import parse_spec


def craft(gap: QuietBars | None) -> dict[str, Any]:
    """rock-1 is two bars, played eight times: 16 bars."""
    plan = plan_practice(find_lesson("rock-1"), PlanOptions(demonstrations=0, click=replace(PLAIN, gap=gap)))
    document: dict[str, Any] = practice_document(
        practise_virtually(plan, parse_spec("seed=2,sd_ms=8")).result, Settings()
    )
    found: dict[str, Any] = document["craft"]
    return found


def test_the_report_tells_the_way_out_of_every_silence() -> None:
    """Two on, one off over 16 bars: back in bars 4, 7, 10, 13 and 16, a bar of 3 s at 80 bpm each; no drift planted.

    Five means of three strokes of SD 8 about the median of some: within 8 ms of nothing.
    """
    gaps = craft(Gap(2, 1))["gaps"]
    assert [one["bar"] for one in gaps["returns"]] == [4, 7, 10, 13, 16]
    assert [one["quiet_s"] for one in gaps["returns"]] == [3.0] * 5
    assert gaps["drift_ms"]["mean"] == pytest.approx(0.0, abs=8.0)


def test_a_click_that_never_falls_silent_has_no_gaps() -> None:
    assert craft(None)["gaps"] is None


def test_gaps_as_people_write_them() -> None:
    assert bars_of_gap("2/1") == Gap(2, 1)
    for text in ("2", "2/0", "0/2", "a/b", "2/-1", ""):
        with pytest.raises(ArgumentTypeError, match="such as 4/1"):
            bars_of_gap(text)
