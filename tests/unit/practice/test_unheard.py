"""Moments in which no stroke could be heard: what was not answered in them is unknown, and counts neither way.

Quarters on the snare at 120 bpm, in bars of four: note i is due i · 0.5 s after the first beat.
"""

from collections import Counter
from collections.abc import Iterable

import pytest

from station.core.events import DeviceFound, DeviceLost, Hit
from station.core.pieces import Piece, Zone
from station.core.settings import Settings
from station.core.units import NS_PER_MS, NS_PER_S, PPQ
from station.devices.capture.capture import (
    Capture,
    CaptureRecord,
    RecordKind,
    device_record,
    parse_capture,
    start_record,
    stroke_record,
)
from station.drills.lesson import Lesson
from station.drills.mastery.pass_measures.pass_facts import measure_pass
from station.engine.messages import Annotate, Command, EngineEvent, Started, Unheard
from station.music.judgement import Judgement, Label
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.practice.records.rejudge import judge_again
from station.practice.records.report.session_pairs import session_pairs_csv
from station.practice.records.report.session_report import practice_document, report_text
from station.practice.session.cues.click_pattern import PLAIN
from station.practice.session.device_latency import Latency
from station.practice.session.plan import TAIL_NS, Plan, PlanOptions, plan_practice
from station.practice.session.runner import SessionRunner
from station.practice.session.session import SessionResult
from station.scenes.heat_map import heat_map
from tests.fakes.captures import capture_bytes

BEAT_NS = NS_PER_S // 2
ZERO_NS = 50 * NS_PER_S
FIRST_NS = ZERO_NS + 4 * BEAT_NS
"""Of a bar of count-in."""
NOTES = 32
KIT = "TD-17"
LOST = range(10, 13)
GONE = (FIRST_NS + 9 * BEAT_NS + 200 * NS_PER_MS, FIRST_NS + 12 * BEAT_NS + 200 * NS_PER_MS)
"""Notes 10 to 12 fall within."""


def plan(click: bool = True) -> Plan:
    score = Score.from_notes([Note(i * PPQ, Piece.SNARE) for i in range(4)], TempoMap.constant(120))
    lesson = Lesson(name="quarters", title="Quarters", score=score)
    return plan_practice(lesson, PlanOptions(demonstrations=0, loops=NOTES // 4, click=PLAIN if click else None))


def hit(note: int) -> Hit:
    return Hit(FIRST_NS + note * BEAT_NS, Piece.SNARE, Zone.HEAD, 80, device=KIT)


class Played:
    """A session in which every note is struck but those `left_out`; `events` come between, by their times."""

    def __init__(self, left_out: Iterable[int], events: Iterable[EngineEvent], click: bool = True) -> None:
        self.runner = SessionRunner(plan(click), Latency())
        self.kept: list[Command] = [*self.runner.start()]
        self.said: list[Judgement] = []
        struck = [hit(note) for note in range(NOTES) if note not in left_out]
        self._handle(Started(ZERO_NS))
        self._handle(DeviceFound(ZERO_NS, KIT))
        for event in sorted([*struck, *events], key=_when):
            self.said += self.runner.advance(_when(event)).judged
            self._handle(event)
        self.said += self.runner.advance(FIRST_NS + NOTES * BEAT_NS + TAIL_NS + NS_PER_S).judged
        self.kept += self.runner.stop()
        self.result: SessionResult = self.runner.finish()

    def _handle(self, event: EngineEvent) -> None:
        update = self.runner.handle(event)
        self.said += update.judged
        self.kept += update.commands

    @property
    def labels(self) -> list[Label]:
        return [Label(label) for label in self.result.alignment.note_label]


def _when(event: EngineEvent) -> int:
    if isinstance(event, Unheard):
        return event.until_ns
    assert isinstance(event, Hit | DeviceLost | DeviceFound)
    return event.at_ns


WAYS: dict[str, list[EngineEvent]] = {
    "the engine was killed": [Unheard(*GONE)],
    "the kit was unplugged": [DeviceLost(GONE[0], KIT), DeviceFound(GONE[1], KIT)],
    "killed twice": [Unheard(GONE[0], GONE[0] + BEAT_NS), Unheard(GONE[0] + BEAT_NS, GONE[1])],
}


@pytest.mark.parametrize("click", [True, False])
@pytest.mark.parametrize("events", WAYS.values(), ids=WAYS.keys())
def test_what_could_not_be_heard_is_unknown(events: list[EngineEvent], click: bool) -> None:
    labels = Played([*LOST, 20], events, click).labels
    assert [note for note, label in enumerate(labels) if label is Label.UNKNOWN] == list(LOST)
    assert [note for note, label in enumerate(labels) if label is Label.MISS] == [20]


def test_spans_that_overlap_are_told_as_one() -> None:
    """A kit that is lost with its sound server, and then the engine that is started anew for it."""
    events: list[EngineEvent] = [
        DeviceLost(GONE[0], KIT),
        DeviceFound(GONE[1] - BEAT_NS, KIT),
        Unheard(GONE[0] + BEAT_NS, GONE[1]),
    ]
    result = Played(LOST, events).result
    assert result.unheard == ((GONE[0] - FIRST_NS, GONE[1] - FIRST_NS),)


def test_what_was_heard_all_the_same_is_judged() -> None:
    labels = Played([11], WAYS["the engine was killed"]).labels
    assert Counter(labels) == {Label.MATCH: NOTES - 1, Label.UNKNOWN: 1}


def test_a_kit_that_stays_away_is_unknown_to_the_end() -> None:
    played = Played(range(10, NOTES), [DeviceLost(GONE[0], KIT)])
    assert played.labels == [Label.MATCH] * 10 + [Label.UNKNOWN] * (NOTES - 10)


def test_whoever_plays_on_elsewhere_is_heard() -> None:
    """From the first stroke on another kit on, what is left out is missed."""
    labels = Played([20], [DeviceLost(GONE[0], KIT)]).labels
    assert labels[20] is Label.MISS


def test_one_kit_of_two_leaves_the_other() -> None:
    other: list[EngineEvent] = [DeviceFound(ZERO_NS, "SPD-SX"), DeviceLost(GONE[0], KIT)]
    assert Label.UNKNOWN not in Played(LOST, other).labels


def test_the_report_counts_it_apart_and_the_score_leaves_it_out() -> None:
    """28 of the 29 notes that could be heard were played on time: 96.6 points."""
    result = Played([*LOST, 20], WAYS["the engine was killed"]).result
    document = practice_document(result, Settings())
    counts = document["counts"]
    assert isinstance(counts, dict)
    assert (counts["notes"], counts["matched"], counts["misses"], counts["unknown"]) == (29, 28, 1, 3)
    assert document["score"] == pytest.approx(100 * 28 / 29, abs=0.001)
    assert document["right"] == 28
    per_bar = document["per_bar"]
    assert isinstance(per_bar, list)
    assert sum(int(str(bar["notes"])) for bar in per_bar if isinstance(bar, dict)) == 29
    session = document["session"]
    assert isinstance(session, dict)
    assert session["unheard"] == [{"from_s": 4.7, "until_s": 6.2, "bars": [1, 1], "unknown": 3}]
    text = report_text(document)
    assert "Notes 29: 28 hit, 1 missed" in text
    assert "unknown, for they could not be heard: 3" in text
    assert "* from 4.7 s to 6.2 s (bar 1): 3 notes without a stroke are unknown, not missed" in text


def test_advice_mastery_and_tables_do_not_blame_it() -> None:
    """Half of the session was deaf: nothing is said of notes left out, and the pass is clean."""
    deaf: list[EngineEvent] = [Unheard(FIRST_NS + 8 * BEAT_NS - 100, FIRST_NS + 23 * BEAT_NS + 100)]
    result = Played(range(8, 24), deaf).result
    document = practice_document(result, Settings())
    assert document["score"] == pytest.approx(100)
    assert "missed" not in str(document["advice"])
    measured = measure_pass(result.score, result.performance, result.alignment)
    assert (measured.notes, measured.right) == (16, 16)
    assert measured.points == pytest.approx(100)
    rows = [line.split(",") for line in session_pairs_csv(result).splitlines()[1:]]
    assert Counter(row[0] for row in rows) == {"match": 16, "unknown": 16}
    assert [row[1] for row in rows] == [str(note) for note in range(NOTES)]  # each still by its own note
    assert all(cell.right == cell.notes for cell in heat_map(result).cells.values())


def test_a_miss_that_was_told_is_taken_back() -> None:
    said = Played(LOST, WAYS["the engine was killed"]).said
    told = [(one.label, one.corrects) for one in said if one.note_index == LOST[0]]
    assert told[:2] == [(Label.MISS, False), (Label.UNKNOWN, True)]


def test_an_unheard_moment_after_which_all_was_played_again_is_forgotten() -> None:
    runner = SessionRunner(plan(), Latency())
    runner.start()
    runner.handle(Started(ZERO_NS))
    for note in range(4):
        runner.handle(hit(note))
    runner.handle(Unheard(FIRST_NS + 4 * BEAT_NS + 100 * NS_PER_MS, FIRST_NS + 6 * BEAT_NS))
    runner.advance(FIRST_NS + 6 * BEAT_NS)
    runner.pause()
    runner.resume()  # from the first bar, the last that was played
    runner.handle(Started(ZERO_NS + 100 * NS_PER_S))
    runner.advance(ZERO_NS + 100 * NS_PER_S + (4 + NOTES) * BEAT_NS + TAIL_NS)
    assert Label.UNKNOWN not in {Label(label) for label in runner.finish().alignment.note_label}


def capture(kept: Iterable[Command], left_out: Iterable[int]) -> Capture:
    """What an engine would have recorded of the session that sent `kept`."""
    texts = [command.text for command in kept if isinstance(command, Annotate)]
    began, *rest = [CaptureRecord(RecordKind.ANNOTATION, 0, FIRST_NS, text.encode()) for text in texts]
    strokes = [stroke_record(1, hit(note)) for note in range(NOTES) if note not in left_out]
    zero = CaptureRecord(RecordKind.ZERO, 0, ZERO_NS)
    head = [start_record(ZERO_NS, 0), device_record(1, ZERO_NS, KIT, "general-midi"), began, zero]
    return parse_capture(capture_bytes([*head, *strokes, *rest]))


@pytest.mark.parametrize("events", WAYS.values(), ids=WAYS.keys())
def test_the_capture_alone_tells_it_again(events: list[EngineEvent]) -> None:
    played = Played([*LOST, 20], events)
    (again,) = judge_again(capture(played.kept, [*LOST, 20]))
    assert [Label(label) for label in again.result().alignment.note_label] == played.labels
    assert again.result().unheard == played.result.unheard
