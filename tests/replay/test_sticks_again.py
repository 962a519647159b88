"""Sensors on the sticks from their bytes to the report: hands named, sticking judged, and the same from the capture.

The sticks are simulated (`simulation.sticks`): they know who strikes what, and nothing of what hears them. Their
samples travel as CSV lines over a serial line that delays them by up to 5 ms and loses 2 % of its packets; in one
session the left sensor is unplugged for a while.
"""

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from station.core.imu import STANDARD_GRAVITY_M_S2, Mounting
from station.core.pieces import Limb, Piece
from station.core.settings import Settings
from station.core.units import NS_PER_MS, NS_PER_S, PPQ
from station.devices.capture.capture import read_capture
from station.drills.lesson import Lesson
from station.engine.engine import Engine
from station.engine.messages import Command, RecordCapture
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.practice.records.rejudge import judge_again
from station.practice.records.report.session_report import practice_document, report_text
from station.practice.session.plan import PlanOptions, plan_practice
from station.practice.session.session import LEAD_IN_NS, Session
from station.scenes.result_tables import session_facts
from station.simulation.sticks.stick_swing import HANDS, SimulatedSticks, StickPair, play
from station.simulation.sticks.swing_sensor import Link, SensorSpec
from station.simulation.sticks.swing_spec import StickStrokeSpec

R, L = Limb.RIGHT_HAND, Limb.LEFT_HAND
PARADIDDLE = (R, L, R, R, L, R, L, L)
KIT = "TD-17"
START_NS = 2 * NS_PER_S
MIDI = {Piece.SNARE: 38, Piece.TOM_1: 48}


def lesson(bars: int) -> Lesson:
    """Paradiddles in eighths at 120 bpm, two strokes of each on the tom."""
    notes = [
        Note(k * PPQ // 2, Piece.TOM_1 if k % 8 in (0, 4) else Piece.SNARE, limb=PARADIDDLE[k % 8])
        for k in range(8 * bars)
    ]
    return Lesson(name="paradiddles", title="Paradiddles", score=Score.from_notes(notes, TempoMap.constant(120)))


def session(bars: int) -> Session:
    return Session(plan_practice(lesson(bars), PlanOptions(demonstrations=0, loops=1, bars=(1, bars))))


def sticks(made: Session, hands: list[Limb], begins_s: float, away_s: tuple[float, float] | None) -> SimulatedSticks:
    """The notes of the session's score, played by these hands by somebody who strays by 8 ms."""
    score, random = made.plan.score, np.random.default_rng(3)
    strokes = [
        StickStrokeSpec(begins_s + onset_s + random.normal(0, 0.008), hand, piece=note.piece, speed_m_s=3.0)
        for onset_s, hand, note in zip(score.onset_s.tolist(), hands, score, strict=True)
    ]
    spans = {R: (), L: () if away_s is None else (away_s,)}
    sensors = {hand: SensorSpec(200.0, link=Link(jitter_s=0.005, loss=0.02, away_s=spans[hand])) for hand in HANDS}
    return play(strokes, pair=StickPair(sensors=sensors), seed=5)


def csv_line(at_us: int, acceleration: list[float], rate: list[float]) -> bytes:
    """PROTOCOLS.md § 4: µs, g, °/s."""
    g = [each / STANDARD_GRAVITY_M_S2 for each in acceleration]
    numbers = [*g, *np.degrees(rate).tolist()]
    return f"{at_us},{','.join(f'{each:.5f}' for each in numbers)}\n".encode()


def bytes_of(simulated: SimulatedSticks) -> list[tuple[int, str, bytes]]:
    """All that came from both sensors and the kit, in order of arrival."""
    said = []
    for stick in simulated.sticks.values():
        assert stick.rate is not None
        rows = zip(stick.time_s, stick.arrival_ns, stick.acceleration.tolist(), stick.rate.tolist(), strict=True)
        said += [(int(at_ns), stick.device, csv_line(round(t * 1e6), a, w)) for t, at_ns, a, w in rows]
    said += [
        (hit.at_ns, KIT, bytes([0x99, MIDI[hit.piece], hit.velocity, 0x89, MIDI[hit.piece], 0]))
        for hit in simulated.pad_hits
    ]
    return sorted(said)


def day(
    made: Session,
    capture: Path,
    hands: list[Limb],
    away_s: tuple[float, float] | None = None,
    more: tuple[Command, ...] = (),
) -> SimulatedSticks:
    """An engine that records and a session that hears it, from the first click to the end; `more` is sent at first."""
    begins_ns = START_NS + LEAD_IN_NS + made.plan.passes_start_ns
    simulated = sticks(made, hands, begins_ns / NS_PER_S, away_s)
    mountings = {stick.device: replace(stick.mounting, learnt=True) for stick in simulated.sticks.values()}
    engine = Engine(own_stick=lambda device: mountings.get(device, Mounting()))
    engine.advance(0)
    engine.device_found(KIT, 0)
    for device in mountings:
        engine.sensor_found(device, 0)
    engine.handle(RecordCapture(capture))
    engine.advance(START_NS)
    for command in (*made.start(), *more):
        engine.handle(command)
    last_ns = START_NS
    for at_ns, device, data in bytes_of(simulated):
        if at_ns < START_NS:
            continue
        engine.feed(device, data, at_ns)
        if at_ns - last_ns > 5 * NS_PER_MS:
            last_ns = at_ns
            hear(engine, made, at_ns)
    hear(engine, made, last_ns + 3 * NS_PER_S)
    for command in (*made.stop(), RecordCapture(None)):
        engine.handle(command)
    hear(engine, made, last_ns + 4 * NS_PER_S)
    return simulated


def hear(engine: Engine, made: Session, now_ns: int) -> None:
    for event in engine.advance(now_ns):
        made.handle(event)
    made.advance(now_ns)


def named(made: Session, hands: list[Limb]) -> tuple[float, float]:
    """The share of notes whose hand is named, and of these the share that is right."""
    result = made.result()
    matched = np.flatnonzero(result.alignment.hit_of_note >= 0)
    said = result.performance.hits["limb"][result.alignment.hit_of_note[matched]]
    known = said != Limb.UNKNOWN
    return float(known.mean()), float((said[known] == np.array(hands)[matched][known]).mean())


def test_hands_are_named_judged_reported_and_had_again(tmp_path: Path) -> None:
    """In the second and third bar singles are played for paradiddles: the strokes 4, 6, 7 of eight, counted from 1."""
    made, capture = session(4), tmp_path / "take.capture"
    played = [*PARADIDDLE, *[R, L] * 8, *PARADIDDLE]
    day(made, capture, played)
    share, right = named(made, played)
    assert share >= 0.95
    assert right >= 0.99
    document: Any = practice_document(made.result(), Settings())
    sticking = document["sticking"]
    assert sticking["wrong"] == pytest.approx(2 * 4, abs=1)
    assert [one["bar"] for one in sticking["wrong_bars"]] == [2, 3]
    assert "wrong_sticking" in [one["fault"] for one in document["advice"]]
    text = report_text(document)
    assert "Sticking: " in text
    assert "right hand: " in text
    shown = session_facts(made.result(), document).words.technique
    assert shown[0] in text
    assert shown[0].startswith("Sticking: ")
    again = judge_again(read_capture(capture))
    assert len(again) == 1
    assert again[0].result().felt == made.result().felt
    assert json.dumps(practice_document(again[0].result(), Settings())) == json.dumps(document)


def test_a_sensor_that_goes_leaves_its_strokes_open_and_comes_back(tmp_path: Path) -> None:
    made, capture = session(4), tmp_path / "take.capture"
    hands = list(PARADIDDLE) * 4
    begins_s = (START_NS + LEAD_IN_NS + made.plan.passes_start_ns) / NS_PER_S
    day(made, capture, hands, (begins_s + 2.0, begins_s + 3.5))
    result = made.result()
    share, right = named(made, hands)
    assert right >= 0.99
    assert 0.75 <= share < 1.0
    limbs = result.performance.hits["limb"]
    at_s = result.performance.hits["at_ns"] / 1e9
    assert (limbs[at_s > 4.0] != Limb.UNKNOWN).mean() > 0.9
    assert judge_again(read_capture(capture))[0].result().felt == result.felt
