"""The phase of the sticks from their bytes to the report, and the same from the capture alone."""

import json
from pathlib import Path
from typing import Any

import pytest

from station.core.settings import Settings
from station.devices.capture.capture import read_capture
from station.practice.records.rejudge import judge_again
from station.practice.records.report.session_report import practice_document, report_text
from station.practice.session.device_latency import Latency
from station.practice.session.plan import PlanOptions, plan_practice
from station.practice.session.runner import SessionRunner
from station.scenes.result_tables import session_facts
from station.sync.drill.drummed_model import shipped_model
from tests.replay.test_sticks_again import PARADIDDLE, day, lesson

LOOPS = 6


def test_a_session_s_phase_is_reported_and_had_again_from_its_capture(tmp_path: Path) -> None:
    """A professional's timing on simulated sticks, which know nothing of the drummer whose motion is the model."""
    options = PlanOptions(demonstrations=0, loops=LOOPS, bars=(1, 1))
    runner, capture = SessionRunner(plan_practice(lesson(1), options), Latency()), tmp_path / "take.capture"
    made, section = runner.session, runner.session.plan.section
    day(made, capture, list(PARADIDDLE) * LOOPS, more=runner.track(section, shipped_model(section)))
    document: Any = practice_document(made.result(), Settings())
    phase = document["phase"]
    assert phase["locked_share"] > 0.5
    for hand in ("right_hand", "left_hand"):
        lean = phase["hands"][hand]
        assert lean["strokes"] >= 8
        assert abs(lean["late_ms"]) < 25
        assert lean["ci"][0] <= lean["late_ms"] <= lean["ci"][1]
        assert lean["late_beats"] == pytest.approx(lean["late_ms"] / 500, abs=0.01)
    text = report_text(document)
    shown = session_facts(made.result(), document).words.technique
    assert sum(line.startswith("Motion: ") and line in text for line in shown) == 3
    (again,) = judge_again(read_capture(capture), with_phase=True)
    assert json.dumps(practice_document(again.result(), Settings())) == json.dumps(document)
    (without,) = judge_again(read_capture(capture))
    assert without.result().phase is None
    assert without.result().felt == made.result().felt
