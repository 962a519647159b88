"""A session judged again from its capture alone: pauses, passes that follow the student, an engine that was replaced.

What is to be had again is what the session of the day said of itself while its capture was written. The kit has mask
times, so that strokes are told late, and the session hears all of it some looks after the engine did, so that strokes
lie between a pause and the engine's word of it.
"""

import json
from collections import Counter, deque
from dataclasses import replace
from datetime import date
from pathlib import Path
from random import Random
from statistics import fmean
from types import MappingProxyType

import pytest

from station.cli.command_line import main
from station.core.errors import BadInput
from station.core.events import Hit
from station.core.pieces import Piece
from station.core.units import NS_PER_MS, NS_PER_S
from station.devices.capture.capture import CaptureRecord, RecordKind, parse_capture, read_capture
from station.devices.capture.replay import LoggedText
from station.devices.mapping.device_map import DeviceMap, Pad
from station.devices.mapping.presets import preset_named
from station.drills.library import find_lesson
from station.engine.engine import Engine
from station.engine.messages import Command, EngineEvent, Started
from station.engine.messages import RecordCapture as SetRecord
from station.music.judgement import Judgement
from station.music.score import NOTE_DTYPE
from station.practice.headless.virtual_session import practise_adaptively, practise_virtually
from station.practice.records.rejudge import judge_again
from station.practice.session.adaptation import Adaptation, ScoreRow
from station.practice.session.device_latency import KitLatency, Latency
from station.practice.session.event_log import PassBegan, said_in, text_of
from station.practice.session.pausing import start_of
from station.practice.session.plan import Plan, PlanOptions, plan_practice
from station.practice.session.session import Session, SessionResult
from station.scoring.align import align
from station.simulation.student_spec import parse_spec
from station.simulation.virtual_student import play
from tests.fakes.captures import capture_bytes

KIT = "TD-17"
GUARDED = replace(
    preset_named("general-midi"),
    name="own",
    base="general-midi",
    pads=MappingProxyType({piece: Pad(threshold=2, mask_ns=9 * NS_PER_MS) for piece in Piece}),
)
LATENCY = Latency(
    3 * NS_PER_MS + 7,
    11 * NS_PER_MS + 13,
    MappingProxyType({KIT: KitLatency(5 * NS_PER_MS, MappingProxyType({Piece.SNARE: 4 * NS_PER_MS + 1}))}),
)
STUDENT = "seed=4,bias_ms=-6,sd_ms=14,miss_pct=4,extra_pct=4,wrong_piece_pct=3"
STEP_NS, LOOK_NS = 2 * NS_PER_MS, 20 * NS_PER_MS
TODAY = date(2026, 3, 1)


class Day:
    """An engine that records, and a session that hears and commands it later than it happens."""

    def __init__(self, session: Session, capture: Path, lag_ns: int, own: DeviceMap = GUARDED) -> None:
        self.session, self._capture, self._lag_ns, self._own = session, capture, lag_ns, own
        self._engine, self.now_ns = Engine(own_kit=lambda _: own), 0
        self._engine.advance(0)
        self._engine.device_found(KIT, 0)
        self._told: deque[tuple[int, EngineEvent]] = deque()
        self._sent: deque[tuple[int, Command]] = deque()
        self._midi: deque[tuple[int, bytes]] = deque()
        self.hits: list[Hit] = []
        self.send(SetRecord(capture), *session.start())

    def send(self, *commands: Command) -> None:
        self._sent += [(self.now_ns + self._lag_ns // 3, command) for command in commands]

    def go(self, until_ns: int) -> None:
        """Everything goes its way until then."""
        while self.now_ns < until_ns and not self.session.over:
            self.now_ns += STEP_NS
            while self._midi and self._midi[0][0] <= self.now_ns:
                at_ns, data = self._midi.popleft()
                self._engine.feed(KIT, data, at_ns)
            self._told += [(self.now_ns + self._lag_ns, event) for event in self._engine.advance(self.now_ns)]
            while self._sent and self._sent[0][0] <= self.now_ns:
                self._engine.handle(self._sent.popleft()[1])
            if self.now_ns % LOOK_NS == 0:
                self._look()

    def _look(self) -> None:
        while self._told and self._told[0][0] <= self.now_ns:
            event = self._told.popleft()[1]
            if isinstance(event, Started):
                self._play_from(event.zero_ns)
            if isinstance(event, Hit):
                self.hits.append(event)
            self.session.handle(event)
        self.session.advance(self.now_ns)

    def _play_from(self, zero_ns: int) -> None:
        plan = self.session.plan
        from_ns, begins_ns = 0, plan.passes_start_ns
        if self.session.pauses:
            from_ns = start_of(plan.score, self.session.pauses[-1].bar)
            begins_ns = start_of(plan.score, 1)  # a bar of count-in
        start_ns = zero_ns + LATENCY.output_ns + begins_ns - from_ns
        sent = play(plan.score, parse_spec(STUDENT)).midi
        self._midi = deque((start_ns + at_ns, data) for at_ns, data in sent if at_ns >= from_ns)

    def another_engine(self) -> None:
        """The engine ends in order; another takes its place and continues the capture."""
        self._engine.close()
        self._told += [(self.now_ns, event) for event in self._engine.advance(self.now_ns)]
        zero_ns = self.session.heard.zero_ns
        assert zero_ns is not None
        self._engine = Engine(own_kit=lambda _: self._own)
        self._engine.advance(self.now_ns)
        self._engine.device_found(KIT, self.now_ns)
        self._engine.handle(SetRecord(self._capture))

    def end(self) -> None:
        self.send(*self.session.stop(), SetRecord(None))
        for _ in range(self._lag_ns // STEP_NS + 20):
            self.now_ns += STEP_NS
            self._told += [(self.now_ns, event) for event in self._engine.advance(self.now_ns)]
            while self._sent and self._sent[0][0] <= self.now_ns:
                self._engine.handle(self._sent.popleft()[1])
        while self._told:
            self.session.handle(self._told.popleft()[1])


def verdicts(session: Session) -> dict[int, Judgement]:
    """The newest verdict on every note; that it corrects one that came too soon is told by the hour of the look."""
    return {note: replace(verdict, corrects=False) for note, verdict in session.verdicts.items()}


def same(again: Session, live: Session) -> None:
    """Whether all that was judged is judged alike."""
    assert list(again.hits) == list(live.hits)
    assert verdicts(again) == verdicts(live)
    assert again.pauses == live.pauses
    same_result(again.result(), live.result())


def same_result(again: SessionResult, live: SessionResult) -> None:
    assert again.complete == live.complete
    assert again.score.onset_ns.tolist() == live.score.onset_ns.tolist()
    assert again.performance.hits.tobytes() == live.performance.hits.tobytes()
    assert again.performance.chokes.tobytes() == live.performance.chokes.tobytes()
    for name in ("hit_of_note", "note_of_hit", "note_label", "hit_label", "asynchrony_ns"):
        assert getattr(again.alignment, name).tolist() == getattr(live.alignment, name).tolist(), name
    assert (again.plan.lesson.name, again.plan.tempo_bpm) == (live.plan.lesson.name, live.plan.tempo_bpm)


def plan_of(lesson: str, loops: int) -> Plan:
    return plan_practice(find_lesson(lesson), PlanOptions(demonstrations=0, loops=loops, tempo_bpm=120))


def paused_day(path: Path, seed: int, lag_ms: int) -> Session:
    """A session with pauses anywhere, asked for by strokes, by a key or by silence; stopped early now and then."""
    rng, session = Random(seed), Session(plan_of("rock-1", 4), LATENCY)
    session.waits = seed % 2 == 0
    day = Day(session, path, lag_ms * NS_PER_MS)
    for _ in range(3):
        day.go(day.now_ns + rng.randrange(2 * NS_PER_S, 8 * NS_PER_S))
        day.send(*session.pause(day.hits[-rng.randrange(1, 3) :] if rng.random() < 0.7 else ()))
        day.go(day.now_ns + rng.randrange(0, 2 * NS_PER_S))
        if rng.random() < 0.9:
            day.send(*session.resume(asked=rng.random() < 0.5, whole=rng.random() < 0.2))
    day.go(day.now_ns + rng.choice([3, 60]) * NS_PER_S)
    day.end()
    return session


@pytest.mark.parametrize("seed", range(12))
def test_a_session_with_pauses(seed: int, tmp_path: Path) -> None:
    live = paused_day(tmp_path / "take.cap", seed, lag_ms=[0, 40, 150][seed % 3])
    (again,) = judge_again(read_capture(tmp_path / "take.cap"))
    same(again, live)


def test_the_pauses_are_really_there(tmp_path: Path) -> None:
    pauses = paused_day(tmp_path / "take.cap", 0, 40).pauses
    assert len(pauses) == 3
    assert sum(pause.strokes for pause in pauses) > 10


@pytest.mark.parametrize("lesson", ["rock-1", "single-paradiddle", "jazz-ride-1"])
def test_a_session_without_a_pause_or_without_a_click(lesson: str, tmp_path: Path) -> None:
    for number, options in enumerate(
        [PlanOptions(loops=2), PlanOptions(loops=2, click=None), PlanOptions(loops=3, bars=(1, 1))]
    ):
        plan = plan_practice(find_lesson(lesson), options)
        virtual = practise_virtually(plan, parse_spec(STUDENT), tmp_path / f"{number}.cap")
        (again,) = judge_again(read_capture(tmp_path / f"{number}.cap"))
        same_result(again.result(), virtual.result)


def test_practice_that_follows_the_student(tmp_path: Path) -> None:
    adaptation = Adaptation(find_lesson("rock-fill-1"), PlanOptions(loops=6), TODAY)
    virtual = practise_adaptively(adaptation, parse_spec(STUDENT), tmp_path / "take.cap")
    again = [session.result() for session in judge_again(read_capture(tmp_path / "take.cap"))]
    assert len(again) == len(adaptation.rounds) == 6
    assert len({round(one.plan.tempo_bpm) for one in again}) > 1, "the tempo has moved"
    for one, live in zip(again, adaptation.rounds, strict=True):
        same_result(one, live.result)
    row = ScoreRow(tuple(one.score for one in again))
    whole = align(row.score, row.performance(one.performance for one in again), clocked=True)
    assert whole.hit_of_note.tolist() == virtual.result.alignment.hit_of_note.tolist()
    assert whole.asynchrony_ns.tolist() == virtual.result.alignment.asynchrony_ns.tolist()


def test_the_command_tells_what_the_report_tells(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    virtual = ["--headless", "--virtual-student", STUDENT, "--loops", "2", "--report", str(tmp_path / "x")]
    assert main(["practice", "rock-1", *virtual, "--json", "--no-pictures"]) == 0
    report = json.loads(capsys.readouterr().out)
    assert main(["devices", "replay", str(tmp_path / "x" / "session.capture"), "--json"]) == 0
    (session,) = json.loads(capsys.readouterr().out)["sessions"]
    labels = Counter(row["label"] for row in session["judgements"])
    counts = report["counts"]
    assert (labels["match"], labels["miss"], labels["extra"]) == (counts["matched"], counts["misses"], counts["extras"])
    asked = ("lesson", "tempo_bpm", "bars", "passes", "complete", "pauses")
    assert [session[key] for key in asked] == [report["session"][key] for key in asked]
    played = [row["asynchrony_ns"] / 1e6 for row in session["judgements"] if row["label"] == "match"]
    assert fmean(played) == pytest.approx(report["timing"]["mean_signed_asynchrony_ms"], abs=0.01)
    assert main(["devices", "replay", str(tmp_path / "x" / "session.capture")]) == 0
    assert f"{counts['matched']} hit" in capsys.readouterr().err


def test_a_pass_that_was_refused_in_its_count_in_is_nobodys(tmp_path: Path) -> None:
    first, refused, second = (Session(plan_of("rock-1", 1), LATENCY) for _ in range(3))
    day = Day(first, tmp_path / "take.cap", 40 * NS_PER_MS)
    day.go(60 * NS_PER_S)
    for session, for_ns in ((refused, NS_PER_S), (second, 60 * NS_PER_S)):
        session.heard.go_on_from(day.session.heard)
        day.session = session
        day.send(*session.start())
        day.go(day.now_ns + for_ns)
    day.end()
    again = judge_again(read_capture(tmp_path / "take.cap"))
    assert len(again) == 2
    same(again[0], first)
    same(again[1], second)


def test_another_engine_continues_the_capture_and_the_count(tmp_path: Path) -> None:
    session = Session(plan_of("rock-1", 4), LATENCY)
    day = Day(session, tmp_path / "take.cap", 40 * NS_PER_MS)
    day.go(6 * NS_PER_S)
    day.another_engine()
    day.go(9 * NS_PER_S)
    day.send(*session.pause(day.hits[-2:]))
    day.go(10 * NS_PER_S)
    day.send(*session.resume())
    day.go(60 * NS_PER_S)
    day.end()
    (again,) = judge_again(read_capture(tmp_path / "take.cap"))
    same(again, session)


def test_a_capture_cut_short_is_judged_up_to_there(tmp_path: Path) -> None:
    live = paused_day(tmp_path / "take.cap", 3, 40)
    data = (tmp_path / "take.cap").read_bytes()
    for length in range(2000, len(data), len(data) // 20):
        for again in judge_again(parse_capture(data[:length])):
            assert again.result().performance is not None
            assert len(again.hits) <= len(live.hits) + sum(pause.strokes for pause in live.pauses)


def test_a_capture_from_before_there_were_remarks_holds_no_session() -> None:
    old = [
        CaptureRecord(RecordKind.START, 0, 0, bytes(8)),
        CaptureRecord(RecordKind.ZERO, 0, 700),
        CaptureRecord(RecordKind.END, 0, 900),
    ]
    assert judge_again(parse_capture(capture_bytes(old))) == []


@pytest.mark.parametrize(
    "text",
    [
        "",
        "[]",
        '{"said":"pass","strokes":0}',
        '{"said":"pause","strokes":0,"command":[[1]]}',
        '{"said":"go_on","strokes":0.5,"asked":true,"whole":true}',
        '{"said":"end","strokes":1e400}',
    ],
)
def test_a_damaged_remark_is_named(text: str) -> None:
    with pytest.raises(BadInput, match="remark at 5 ns"):
        said_in(LoggedText(5, text))


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("end_tick", 1),  # its notes lie behind it
        ("end_tick", 2**61),
        ("meters", [[0, 2**61, 4]]),
        ("passes", 1001),
        ("beat_ticks", 0),
        ("tempo_bpm", "nan"),
        (("notes", "lead_ms"), 1e308),
        (("notes", "tick"), 2**61),
        (("notes", "tick"), -1),
        (("notes", "openness"), 1e308),
        (("notes", "piece"), 99),
        (("notes", "swing_ticks"), 2**61),
        (("notes", "swing_ticks"), -1),
    ],
)
def test_a_score_that_none_can_be_is_named(key: str | tuple[str, str], value: object) -> None:
    """Each of these once ended in numpy's words, or asked for terabytes."""
    fields = json.loads(text_of(PassBegan(0, plan_of("rock-1", 1), LATENCY, waits=False)))
    assert isinstance(said_in(LoggedText(5, json.dumps(fields))), PassBegan)
    if isinstance(key, str):
        fields[key] = value
    else:
        fields[key[0]][0][(NOTE_DTYPE.names or ()).index(key[1])] = value
    with pytest.raises(BadInput, match="remark at 5 ns"):
        said_in(LoggedText(5, json.dumps(fields)))


def test_captures_from_before_swing_was_kept_with_the_strokes_can_be_read() -> None:
    plan = plan_of("rock-1", 1)
    fields = json.loads(text_of(PassBegan(0, plan, LATENCY, waits=False)))
    fields["notes"] = [row[:13] for row in fields["notes"]]
    said = said_in(LoggedText(5, json.dumps(fields)))
    assert isinstance(said, PassBegan)
    assert said.plan.section.notes.tobytes() == plan.section.notes.tobytes()


def test_what_a_later_version_says_is_passed_over() -> None:
    assert said_in(LoggedText(5, '{"said":"sang","strokes":"la"}')) is None
