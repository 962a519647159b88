from datetime import date
from types import MappingProxyType

import numpy as np
import pytest

from station.app.equipment.calibration_results import (
    CalibrationResult,
    CalibrationResults,
    document,
    outdated,
    rows_of_taps,
    text,
    with_rows,
)
from station.core.measured_latency import DeviceLatency, MeasuredLatency, StoredCalibration
from station.core.pieces import Piece
from station.engine.latency_measurement import Devices
from station.sound.calibration.latency_estimate import LatencyEstimate
from station.sound.calibration.stream_report import report_of
from station.sound.calibration.taps import Taps, taps
from station.sound.calibration.timeline import Timeline

DAY = date(2026, 1, 31)
GOOD = LatencyEstimate(4.0, 3.5, 4.5, 0.8, 20)
POOR = GOOD.doubted("it scatters")
OUTPUT, KIT = CalibrationResult("output", "card", GOOD), CalibrationResult("kit", "TD-17", GOOD)
PAD = CalibrationResult("pad", "TD-17", LatencyEstimate(6.0, 5.8, 6.2, 0.3, 10), Piece.SNARE)


def test_what_is_stored_goes_by_device_and_pad() -> None:
    after = with_rows(with_rows(StoredCalibration(), [OUTPUT], "loopback", DAY), [KIT, PAD], "strike", DAY)
    assert after.outputs["card"] == MeasuredLatency(4.0, 0.5, "loopback", DAY)
    assert after.kits["TD-17"].kit == MeasuredLatency(4.0, 0.5, "strike", DAY)
    assert after.kits["TD-17"].pads[Piece.SNARE] == MeasuredLatency(6.0, 0.2, "strike", DAY)


def test_doubts_are_stored_with_what_is_doubtful() -> None:
    assert (
        with_rows(StoredCalibration(), [CalibrationResult("output", "card", POOR)], "loopback", DAY)
        .outputs["card"]
        .doubts
        == "it scatters"
    )


def test_a_kit_that_is_measured_outdates_what_was_tapped() -> None:
    """The tapped latency of an output had the kit's in it; subtracting both would count the kit twice."""
    tapped, looped = MeasuredLatency(60.0, 30.0, "tap", DAY, "habit"), MeasuredLatency(2.0, 0.1, "loopback", DAY)
    before = StoredCalibration(MappingProxyType({"phones": tapped, "card": looped}))
    assert outdated(before, [KIT]) == ["phones"]
    assert dict(with_rows(before, [KIT], "strike", DAY).outputs) == {"card": looped}
    assert outdated(before, [OUTPUT]) == []


def followed(late_ms: float) -> Taps:
    """A player who follows the click, all taps late by so much and a little uneven."""
    clicks = 10**13 + np.arange(36) * 600_000_000
    off_ms = late_ms + 5.0 * np.random.default_rng(3).standard_normal(36)
    return taps(clicks + np.round(off_ms * 1e6).astype(np.int64), clicks)


HERE = Devices(kit="TD-17", output="card")
KIT_KNOWN = StoredCalibration().with_kit(
    "TD-17",
    DeviceLatency(
        MeasuredLatency(4.0, 0.5, "strike", DAY),
        MappingProxyType({Piece.SNARE: MeasuredLatency(6.0, 0.5, "strike", DAY)}),
    ),
)


@pytest.mark.parametrize(
    ("before", "what", "of_total_ms"),
    [
        (StoredCalibration(), "equipment", 15.0),  # the middle of the habits, 40 ms early to 10 ms late, is taken off
        (KIT_KNOWN, "equipment", 15.0 - 6.0),  # and what the pad is known to have
        (KIT_KNOWN.with_output("card", MeasuredLatency(-3.0, 0.1, "loopback", DAY)), "habit", -6.0 + 3.0),
        (KIT_KNOWN.with_output("card", MeasuredLatency(50.0, 25.0, "tap", DAY)), "equipment", 15.0 - 6.0),
    ],
)
def test_taps_are_shared_out_by_what_is_known(before: StoredCalibration, what: str, of_total_ms: float) -> None:
    found = followed(60.0)
    together, rest = rows_of_taps(found, Piece.SNARE, HERE, before)
    assert (together.what, rest.what) == ("together", what)
    assert rest.estimate.value_ms == pytest.approx(found.total.value_ms + of_total_ms)
    assert rest.device == ("TD-17" if what == "habit" else "card")


def test_habit_is_never_stored() -> None:
    whats = ("output", "kit", "pad", "equipment", "together", "habit")
    assert [what for what in whats if CalibrationResult(what, "x", GOOD).storable] == [
        "output",
        "kit",
        "pad",
        "equipment",
    ]


def test_the_text_is_signed_and_says_what_not_to_trust() -> None:
    said = text(
        CalibrationResults(Devices(kit="TD-17"), (CalibrationResult("kit", "TD-17", POOR), PAD)), StoredCalibration()
    )
    assert "TD-17: stamps strokes late by +4.0 ms (+3.5 to +4.5, 20 counted)" in said
    assert "don't trust this: it scatters" in said
    assert "snare +6.0 ms" in said


def test_the_streams_report_is_told_with_its_drift() -> None:
    frames = list(range(0, 480_000, 480))
    fast = [round(frame / 48_000 / 1.0001 * 1e9) for frame in frames]
    report = report_of(5.3, Timeline(np.array(frames), np.array(fast), 48_000), 0)
    assert report.drift_ppm == pytest.approx(100.0, abs=0.5)
    assert not report.doubts
    said = text(CalibrationResults(Devices(output="card"), stream=report), StoredCalibration())
    assert "card: reports a latency of 5.3 ms; its clock runs +100 ± 0 parts in a million fast" in said
    known = StoredCalibration(MappingProxyType({"card": MeasuredLatency(-3.0, 0.1, "loopback", DAY)}))
    assert "measured -3.0 ms more by loopback" in text(CalibrationResults(Devices(output="card"), stream=report), known)


@pytest.mark.parametrize(("latency_ms", "word"), [(None, "no latency"), (0.0, "no latency"), (250.0, "too long")])
def test_a_report_that_cannot_be_right_is_doubted(latency_ms: float | None, word: str) -> None:
    assert word in report_of(latency_ms, None, 0).doubts[0]


def test_the_document_has_every_figure() -> None:
    made = document("strike", CalibrationResults(Devices(kit="TD-17", input="mic"), (KIT, PAD)), stored=True)
    assert (made["schema"], made["by"], made["stored"]) == ("drum-station/calibrate/1", "strike", True)
    assert (made["kit"], made["output"], made["input"]) == ("TD-17", None, "mic")
    rows = made["results"]
    assert isinstance(rows, list)
    assert rows[1] == {
        "what": "pad",
        "device": "TD-17",
        "piece": "snare",
        "latency_ms": 6.0,
        "low_ms": 5.8,
        "high_ms": 6.2,
        "sd_ms": 0.3,
        "count": 10,
        "trusted": True,
        "doubts": [],
        "remarks": [],
    }


def test_a_kit_keeps_pads_that_were_measured_before() -> None:
    before = StoredCalibration(
        kits=MappingProxyType({"TD-17": DeviceLatency(MeasuredLatency(1.0, 1.0, "strike", DAY))})
    )
    after = with_rows(with_rows(before, [KIT, PAD], "strike", DAY), [KIT], "strike", DAY)
    assert set(after.kits["TD-17"].pads) == {Piece.SNARE}
