"""The main job, whole: a fake kit in another process plays a lesson through rtmidi, the station judges and sounds it.

Three real processes besides JACK's server: the station (with its engine's process), the kit and a recorder. Expected
values are the kit's own account of what it sent and when, and what the recorder heard.
"""

import json
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.signal import butter, sosfiltfilt

from station.core.errors import BadInput
from station.core.units import NS_PER_MS, NS_PER_S
from station.devices.capture.capture import read_capture
from station.devices.capture.replay import transport_zeros_ns
from station.drills.library import find_lesson
from station.music.judgement import Label
from station.practice.history.session_files import CAPTURE_NAME
from station.practice.records.rejudge import judge_again
from station.practice.session.plan import PlanOptions, plan_practice
from station.simulation.student_spec import parse_spec
from station.simulation.virtual_student import play
from tests.fakes.jack_recorder import JackRecorder, Recording
from tests.fakes.jack_server import JackServer, jackd_is_installed
from tests.fakes.kit_player import KitPlayer, Stroke
from tests.fakes.stillness import Stillness

pytestmark = [
    pytest.mark.jack,
    pytest.mark.skipif(not jackd_is_installed(), reason="jackd is not installed (make test installs it)"),
]

LESSON, TEMPO_BPM = "rock-1", 120.0
KICK, SNARE = 36, 38  # General MIDI
TIMING_TOLERANCE_MS = 2.0
"""JACK's MIDI through rtmidi is stamped within a period of 1.3 ms; the mean is steadier, but machines stall."""
SOUND_WITHIN_NS = 60 * NS_PER_MS
"""A kick's low end must begin so soon after the stroke was sent: two periods, the filter's blur, a stalled machine."""


MEASURED = """
[kits."Fake Kit:out"]
latency_ms = 12
half_ms = 0.5
by = "strike"
on = 2026-01-31
[outputs.system]
latency_ms = -4
half_ms = 0.5
by = "loopback"
on = 2026-01-31
"""
LATENCY_MS = 12.0 - 4.0
"""What practice must take out of every hit's time: the kit is late by so much, the sound early."""


def start_station(server: JackServer, folder: Path) -> "subprocess.Popen[str]":
    command = ["practice", LESSON, "--headless", "--json", "--no-demonstration", "--kit", "fake kit", "--loops", "1"]
    command += ["--tempo", str(TEMPO_BPM), "--report", str(folder), "--student", "somebody"]
    config = folder.parent / "config"
    (config / "drum-station").mkdir(parents=True)
    (config / "drum-station" / "calibration.toml").write_text(MEASURED)
    env = {**server.env, "XDG_CONFIG_HOME": str(config)}
    return subprocess.Popen(
        [sys.executable, "-m", "station.cli.command_line", *command],
        env=env,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def wait_for_zero_ns(capture: Path, station: "subprocess.Popen[str]") -> int:
    """When the station's transport was at zero, as soon as its capture says so."""
    while station.poll() is None:
        try:
            zeros = transport_zeros_ns(read_capture(capture))
        except BadInput:
            zeros = []
        if zeros:
            return zeros[0]
        time.sleep(0.02)
    pytest.fail(f"the station ended before it began: {station.stderr.read() if station.stderr else ''}")


def sent_at(sent: list[Stroke], note: int) -> list[int]:
    """When the kit sent this note."""
    return [stroke.at_ns for stroke in sent if stroke.data[:2] == bytes((0x99, note))]


def low_onsets_ns(heard: Recording, rate_hz: int) -> NDArray[np.int64]:
    """When the sound's low end (kick and snare have one, clicks and hi-hat do not) rises after a pause."""
    low = sosfiltfilt(butter(4, 90, "lowpass", fs=rate_hz, output="sos"), heard.sound.mean(axis=1))
    level = np.abs(low)
    loud = np.flatnonzero(level > 0.15 * level.max())
    first = np.concatenate([[True], np.diff(loud) > rate_hz // 10])
    onsets: NDArray[np.int64] = heard.at_ns[loud[first]]
    return onsets


def test_a_fake_kit_is_heard_judged_and_sounded(tmp_path: Path) -> None:
    plan = plan_practice(find_lesson(LESSON), PlanOptions(TEMPO_BPM, 1, None, 0))
    student = play(plan.score, parse_spec("seed=3,sd_ms=6,bias_ms=-15,miss_pct=6,extra_pct=4"))
    strokes = [Stroke(at_ns, data) for at_ns, data in student.midi]
    report = tmp_path / "session"
    with JackServer(patient=True) as server, KitPlayer(server, "Fake Kit", strokes, tmp_path) as kit:
        with (
            JackRecorder(server, tmp_path) as recorder,
            Stillness() as stillness,
            start_station(server, report) as station,
        ):
            zero_ns = wait_for_zero_ns(report / CAPTURE_NAME, station)
            start_ns = zero_ns + plan.passes_start_ns
            kit.play(start_ns)
            recorder.connect("PortAudio:.*")
            sent = kit.truth()
            out, err = station.communicate(timeout=60)
            heard = recorder.stop()
        assert station.returncode == 0, err
    document = json.loads(out)

    truth = student.truth
    assert document["counts"]["notes"] == len(plan.score)
    assert document["counts"]["hits"] <= len(student.performance)
    assert document["session"]["device"].startswith("Fake Kit")
    assert document["session"]["latency"] == "12 ms input (measured), -4 ms output (measured)"

    assert {path.name for path in report.iterdir()} >= {CAPTURE_NAME, "report.json", "report.txt", "pairs.csv"}
    (again,) = judge_again(read_capture(report / CAPTURE_NAME))
    alignment = again.result().alignment
    judged = [document["counts"][name] for name in ("matched", "misses", "extras", "wrong_piece")]
    assert [alignment.count(label) for label in (Label.MATCH, Label.MISS, Label.EXTRA, Label.WRONG_PIECE)] == judged
    again_ms = alignment.asynchrony_ns[(alignment.note_label == Label.MATCH) & ~plan.score.is_grace].mean() / NS_PER_MS
    assert document["timing"]["mean_signed_asynchrony_ms"] == pytest.approx(again_ms, abs=0.001)
    # where the machine stood still, the kit, too, played late, or all at once
    if stillness.stood(start_ns - NS_PER_S, sent[-1].at_ns + NS_PER_S):
        return
    assert document["counts"]["hits"] == len(student.performance)
    assert abs(document["counts"]["misses"] - truth.count(Label.MISS)) <= 1
    assert abs(document["counts"]["extras"] - truth.count(Label.EXTRA)) <= 1
    late_ns = [was.at_ns - start_ns - planned.at_ns for was, planned in zip(sent, strokes, strict=True)]
    matched = (truth.note_label == Label.MATCH) & ~plan.score.is_grace
    struck_ns = student.performance.hits["at_ns"][truth.hit_of_note[matched]]
    kit_late_ns = np.interp(struck_ns, [stroke.at_ns for stroke in strokes], late_ns).mean()
    expected_ms = float(student.asynchrony_ms().mean() + kit_late_ns / NS_PER_MS) - LATENCY_MS
    assert document["timing"]["mean_signed_asynchrony_ms"] == pytest.approx(expected_ms, abs=TIMING_TOLERANCE_MS)

    onsets_ns = low_onsets_ns(heard, 48_000)
    kicks_ns, snares_ns = sent_at(sent, KICK), sent_at(sent, SNARE)
    assert len(kicks_ns) >= 3
    for at_ns in kicks_ns:
        assert np.abs(onsets_ns - at_ns).min() < SOUND_WITHIN_NS
    for onset_ns in onsets_ns:
        assert np.abs(np.array(kicks_ns + snares_ns) - onset_ns).min() < SOUND_WITHIN_NS
    assert (heard.at_ns[-1] - heard.at_ns[0]) / NS_PER_S > 3
