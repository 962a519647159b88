"""The inner clock and the hand of human drummers, beside published figures.

HUMANS has σ_M of 4–8 ms, and σ_C of 8 ms at 250 ms between strokes that falls with the interval; professionals hold the
instruments of one slot within 15–20 ms in most takes.
"""

from pathlib import Path

import pytest

from station.scoring.align import align
from station.scoring.analysis.technique.synchrony import synchrony
from station.scoring.analysis.technique.wing_kristofferson import WingKristofferson, wing_kristofferson
from tests.real_data import real_files
from tests.recordings.test_assess_gmd import quantised

FILES = real_files("gmd/*/eval_session/*.mid")


def told(path: Path) -> tuple[WingKristofferson, float | None]:
    score, performance, _ = quantised(path)
    alignment = align(score, performance, clocked=False)
    limbs = synchrony(score, alignment)
    return wing_kristofferson(score, performance, alignment), None if limbs is None else limbs.sd_ms.sd


@pytest.mark.parametrize("path", FILES)
def test_clock_and_hand_are_human_or_not_told(path: Path) -> None:
    found, together_ms = told(path)
    assert (found.timekeeper is None) == (found.motor is None) == (found.cannot_tell is not None)
    if found.timekeeper is not None and found.motor is not None:
        assert 2.0 <= found.motor.sd_ms <= 9.0
        assert 3.0 <= found.timekeeper.sd_ms <= 12.0
        assert found.interval_ms is not None
        assert found.interval_ms < 400
    assert together_ms is not None
    assert 3.0 <= together_ms <= 25.0
