"""A session judged again from its capture alone: the same strokes, pauses and passes give the same judgements.

The capture's bytes go through the decoders again, and a session of the same plan hears what comes of them; what the
session of the day said of itself (`session.event_log`) takes its place among the strokes. A pass that was refused in
its count-in was judged by nobody, and is left out here too. Free takes, and captures from before there was a log, hold
no session.
"""

from collections import deque
from collections.abc import Iterable
from contextlib import suppress

from station.core.errors import BadInput
from station.core.events import (
    Choke,
    DeviceFound,
    DeviceLost,
    Hit,
    SensorEvent,
    SensorLost,
    SensorMounted,
    SensorSamples,
    SensorStatus,
)
from station.core.pieces import word
from station.devices.capture.capture import Capture
from station.devices.capture.replay import CaptureBegan, Entry, LoggedText, OutputChanged, TransportZero, replay_all
from station.engine.messages import EngineEvent, Sounding, Started, Unheard
from station.music.judgement import Label
from station.music.score import Score
from station.practice.session.event_log import (
    Ended,
    PassBegan,
    Paused,
    Said,
    Tracked,
    WasUnheard,
    WentOn,
    said_in,
    stroke_key,
)
from station.practice.session.session import Session, SessionResult
from station.scoring.matching.alignment import judgements
from station.scoring.report.assessment_document import Json
from station.sync.drill.drill_model import DrillModel
from station.sync.drill.drummed_model import shipped_model
from station.sync.sticks import Sticks


def judge_again(capture: Capture, with_phase: bool = False) -> list[Session]:
    """The sessions that `capture` holds, in order, each as it was when it ended.

    Practice that follows the student has one a pass. `with_phase` the sticks are tracked as they were on the day, which
    takes some seconds. Raises `BadInput` where a record or a log text cannot be read.
    """
    until_ns = capture.records[-1].at_ns if capture.records else 0
    return RejudgedSessions(replay_all(capture), with_phase).sessions(until_ns)


class RejudgedSessions:
    """Sessions as they come out of the `entries` of a capture."""

    def __init__(self, entries: Iterable[Entry], with_phase: bool = False) -> None:
        self._entries = list(entries)
        self._with_phase = with_phase
        self._tracked: dict[LoggedText, Tracked] = {}
        self._due = deque(self._log_texts())
        self._drill: DrillModel | None = None
        self._done: list[Session] = []
        self._session: Session | None = None
        self._hits: list[Hit] = []
        self._part = self._strokes = 0
        self._output: str | None = None
        self._is_ended = False
        self._sticks = Sticks()

    def _log_texts(self) -> Iterable[tuple[int, LoggedText, Said | None]]:
        """Every text of the log, with the part of the capture that it is in: each part counts its strokes from 0."""
        part = 0
        for entry in self._entries:
            part += isinstance(entry, CaptureBegan)
            if isinstance(entry, LoggedText):
                said = said_in(entry)
                if isinstance(said, Tracked):
                    self._tracked[entry] = said  # it has its place among the samples
                else:
                    yield part, entry, said

    def sessions(self, until_ns: int) -> list[Session]:
        """All of them; one that nobody ended, for the power went, lasts `until_ns`."""
        for entry in self._entries:
            self._handle(entry)
        if self._session is not None:
            if not self._is_ended:
                self._session.advance(until_ns)
            self._done.append(self._session)
            self._session = None
        return self._done

    def _handle(self, entry: Entry) -> None:
        match entry:
            case CaptureBegan():
                self._part, self._strokes = self._part + 1, 0
            case LoggedText() if entry in self._tracked:
                if self._with_phase:
                    self._track(self._tracked[entry].section)
            case LoggedText():
                if any(logged is entry for _, logged, _ in self._due):  # else it was due before, among the strokes
                    while self._apply_next() is not entry:
                        pass
            case TransportZero(at_ns):
                self._hand_over(Started(at_ns, self._output))
            case OutputChanged(output):
                self._output = output
                self._hand_over(Sounding(output))
            case Hit() | Choke():
                self._struck(entry)
            case SensorMounted() | SensorLost() | SensorSamples() | SensorStatus():
                self._sensed(entry)
            case DeviceLost() | DeviceFound():
                pass  # what could not be heard meanwhile the log says
            case _:
                self._hand_over(entry)

    def _struck(self, entry: Hit | Choke) -> None:
        while self._due and self._due[0][0] == self._part and self._is_due(self._due[0][2]):
            self._apply_next()
        if isinstance(entry, Hit):
            self._hits.append(entry)
        self._hand_over(entry)
        self._strokes += 1

    def _sensed(self, entry: SensorEvent) -> None:
        for told in self._sticks.handle(entry):
            if not isinstance(told, Hit):  # a stroke in the air has a record of its own
                self._hand_over(told)

    def _track(self, section: Score) -> None:
        with suppress(BadInput):  # there was a model on the day, but a drummer who has changed since may give none
            self._drill = shipped_model(section)
            self._sticks.track_drill(self._drill)
            if self._session is not None:
                self._session.phases.model = self._drill

    def _is_due(self, said: Said | None) -> bool:
        return said is None or said.strokes <= self._strokes

    def _hand_over(self, event: EngineEvent) -> None:
        if self._session is not None:
            self._session.handle(event)

    def _apply_next(self) -> LoggedText:
        _, logged, said = self._due.popleft()
        if isinstance(said, PassBegan):
            self._begin(said, logged.at_ns)
        elif said is not None and self._session is not None:
            self._apply(self._session, said)
        return logged

    def _begin(self, said: PassBegan, at_ns: int) -> None:
        before = self._session
        if before is not None:
            before.advance(at_ns)
            if before.over:
                self._done.append(before)
        self._is_ended = False
        self._session = Session(said.plan, said.latency, waits=said.waits)
        self._session.phases.model = self._drill
        self._hand_over(Sounding(self._output))

    def _apply(self, session: Session, said: Paused | WentOn | Ended | WasUnheard) -> None:
        match said:
            case Paused(_, now_ns, command):
                session.advance(now_ns)
                session.pause([hit for hit in self._hits if stroke_key(hit) in command])
            case WentOn(_, asked, whole):
                session.resume(asked, whole)
            case WasUnheard(_, from_ns, until_ns):
                session.handle(Unheard(from_ns, until_ns))
            case Ended(_, now_ns):
                session.advance(now_ns)
                self._is_ended = True


# --- in words ---------------------------------------------------------------------------------------------------------


def session_document(result: SessionResult) -> dict[str, Json]:
    """A session judged again, for programs; times are ns from the first beat of its first pass."""
    plan, hit_ns = result.plan, result.performance.hits["at_ns"]
    rows: list[Json] = [
        {
            "label": word(one.label),
            "note_index": one.note_index,
            "hit_index": one.hit_index,
            "note_ns": None if one.note_index is None else int(result.score.onset_ns[one.note_index]),
            "hit_ns": None if one.hit_index is None else int(hit_ns[one.hit_index]),
            "asynchrony_ns": one.asynchrony_ns,
        }
        for one in judgements(result.score, result.performance, result.alignment)
    ]
    return {
        "lesson": plan.lesson.name,
        "tempo_bpm": round(plan.tempo_bpm, 3),
        "bars": [plan.bars[0] + 1, plan.bars[1] + 1],
        "passes": plan.passes,
        "complete": result.complete,
        "pauses": [
            {"bar": plan.bar_names[pause.bar] + 1, "asked": pause.asked, "strokes_again": pause.strokes}
            for pause in result.pauses
        ],
        "judgements": rows,
    }


def session_line(result: SessionResult) -> str:
    """A session judged again, in a line."""
    plan, count = result.plan, result.alignment.count
    counted = (f"{count(label)} {_WORDS[label]}" for label in _WORDS if count(label))
    pauses = f", {len(result.pauses)} x paused" if result.pauses else ""
    early = "" if result.complete else ", stopped early"
    bars = f"bars {plan.bars[0] + 1}-{plan.bars[1] + 1}"
    return f"{plan.lesson.title} at {plan.beats_a_minute:g} bpm, {bars}{early}{pauses}: {', '.join(counted)}"


_WORDS = {
    Label.MATCH: "hit",
    Label.MISS: "missed",
    Label.UNKNOWN: "unknown",
    Label.WRONG_PIECE: "on a wrong piece",
    Label.EXTRA: "extra",
    Label.IGNORED: "not counted",
    Label.PLAYED_AGAIN: "played again",
}
