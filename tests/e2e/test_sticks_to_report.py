"""Sensors on both sticks, whole: a virtual drummer plays a rudiment with some wrong hands, and the report tells which.

Three ptys speak: a kit, and a sensor on each stick in a protocol of its own, their samples up to 5 ms late, 2 % of the
packets lost, one of them unplugged for a while. Expected values are the simulated sticks' own account.
"""

import json
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from station.core.pieces import Limb
from station.core.settings import Settings
from station.core.units import NS_PER_S
from station.devices.capture.capture import RecordKind, read_capture
from station.devices.mapping.stick_file import save_stick
from station.drills.library import find_lesson
from station.practice.history.session_files import CAPTURE_NAME
from station.practice.records.recovery import recovered
from station.practice.records.rejudge import judge_again
from station.practice.records.report.session_report import practice_document
from station.practice.session.plan import PlanOptions, plan_practice
from station.simulation.sticks.stick_swing import StickPair, play
from station.simulation.sticks.swing_score import PlayerSpec, spec_from_score
from station.simulation.sticks.swing_sensor import Link, SensorSpec
from tests.e2e.test_practice_jack import wait_for_zero_ns
from tests.fakes.imu_speech import csv_line, x_imu3
from tests.fakes.virtual_drummer import PLUG, UNPLUG, Deed, VirtualDrummer, measured, pads

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="ptys that speak as serial ports are Linux's")

LESSON, TEMPO_BPM, LOOPS, RATE_HZ = "single-paradiddle", 100.0, 6, 400.0
START_S = 3.0
AWAY_S = (6.0, 8.0)
"""When the left stick's sensor is unplugged: seconds after the first stroke."""
HANDS = {"right": Limb.RIGHT_HAND, "left": Limb.LEFT_HAND}
OTHER = {Limb.RIGHT_HAND: Limb.LEFT_HAND, Limb.LEFT_HAND: Limb.RIGHT_HAND}
WRONG_ROWS = (11, 19, 75, 83)
"""The second stroke of a pair: played by the other hand, which is free."""
SPEAK = {"right": x_imu3, "left": csv_line}


def test_the_report_names_the_hands_that_struck(tmp_path: Path) -> None:
    lesson = find_lesson(LESSON)
    plan = plan_practice(lesson, PlanOptions(tempo_bpm=TEMPO_BPM, loops=LOOPS, demonstrations=0))
    sensor = SensorSpec(rate_hz=RATE_HZ, link=Link(jitter_s=0.005, loss=0.02), clock_ppm=80.0)
    strokes = spec_from_score(plan.score, start_s=START_S, player=PlayerSpec(0.02, 0.004, 0.05), seed=3)
    for row in WRONG_ROWS:
        strokes[row] = replace(strokes[row], limb=OTHER[strokes[row].limb])
    played = play(strokes, pair=StickPair(dict.fromkeys(HANDS.values(), sensor)), seed=3)

    deeds = pads(played, START_S)
    for name, limb in HANDS.items():
        stick = played.sticks[limb]
        for row, arrival_ns in enumerate(stick.arrival_ns.tolist()):
            at_ns = arrival_ns - round(START_S * NS_PER_S)
            if not (name == "left" and AWAY_S[0] <= at_ns / NS_PER_S <= AWAY_S[1]):
                deeds.append(Deed(at_ns, name, SPEAK[name](measured(stick, row, RATE_HZ)).hex()))
    for moment_s, what in zip(AWAY_S, (UNPLUG, PLUG), strict=True):
        deeds.append(Deed(round(moment_s * NS_PER_S), "left", what))

    report = tmp_path / "report"
    with VirtualDrummer(tmp_path, deeds) as drummer:
        for name, limb in HANDS.items():
            save_stick(played.sticks[limb].mounting, drummer.port(name), tmp_path / "config/drum-station/sticks")
        station = start_station(drummer, report)
        zero_ns = wait_for_zero_ns(report / CAPTURE_NAME, station)
        drummer.play(zero_ns + plan.passes_start_ns)
        out, said = station.communicate(timeout=100)
    assert station.returncode == 0, said
    document = json.loads(out)

    capture = read_capture(report / CAPTURE_NAME)
    result = judge_again(capture)[-1].result()
    hits = result.performance.hits
    truth = played.truth[played.pad_truth]
    assert len(hits) == len(truth)
    limbs, at_s = hits["limb"], truth["at_s"] - START_S
    named = limbs != Limb.UNKNOWN
    # a port is looked for once a second, and a sensor needs a second to be followed
    (found_ns,) = (record.at_ns for record in capture.records if record.kind == RecordKind.FOUND)
    found_s = (found_ns - zero_ns - plan.passes_start_ns) / NS_PER_S
    both_there = (at_s < AWAY_S[0] - 0.1) | (at_s > found_s + 1.0)
    assert np.mean(limbs[named] == truth["limb"][named]) >= 0.99
    assert named[both_there].mean() >= 0.95

    counted = np.flatnonzero(named & np.isin(np.arange(len(hits)), result.alignment.hit_of_note))
    wrong = np.isin(counted, WRONG_ROWS)  # a busy machine may hear a stroke too late to count
    assert wrong.sum() >= len(WRONG_ROWS) - 1
    assert document["sticking"]["wrong"] == wrong.sum()
    assert document["sticking"]["right"] == np.sum(~wrong)
    assert document["phase"]["locked_share"] > 0.3  # one sensor is away for a while, four strokes are the other hand's
    assert set(document["phase"]["hands"]) == {"right_hand", "left_hand"}
    assert practice_document(recovered(report / CAPTURE_NAME), Settings())["phase"] == document["phase"]


def start_station(drummer: VirtualDrummer, report: Path) -> "subprocess.Popen[str]":
    command = ["practice", LESSON, "--headless", "--json", "--no-demonstration", "--loops", str(LOOPS)]
    command += ["--tempo", str(TEMPO_BPM), "--report", str(report), "--no-pictures", "--device", drummer.port("kit")]
    for name in HANDS:
        command += ["--sticks", drummer.port(name)]
    return subprocess.Popen(
        [sys.executable, "-m", "station.cli.command_line", *command],
        env={"XDG_CONFIG_HOME": str(report.parent / "config"), "HOME": str(report.parent)},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
