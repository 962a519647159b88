"""A session of the history judged again from its capture, as it was shown at its end: in a process of its own.

A lesson is read as for its page (`scenes.report.kept_session`); a take and a battle come from their captures, which the
history has where the session's folder is gone.
"""

import json
from dataclasses import dataclass
from datetime import date

from station.app.sessions.shown_result import SavedSession, shown_result
from station.core.errors import BadInput
from station.core.measured_latency import load_calibration
from station.core.settings import Settings
from station.devices.capture.capture import Capture, parse_capture
from station.music.performance import Performance
from station.practice.battle.battle_result import BattleResult
from station.practice.battle.records.judge_battle_again import judge_battle_again
from station.practice.history.session_choice import choose_session
from station.practice.history.session_files import BATTLE_NAME, TAKE_NAME
from station.practice.session.cues.click_pattern import PLAIN
from station.practice.session.device_latency import latency_of
from station.practice.session.free_play import FreeClick, take_of
from station.scenes.report.kept_session import kept_session
from station.scenes.report.session_place import session_place
from station.scoring.report.assessment_document import Json
from station.store.history import History
from station.store.opening import history_of
from station.store.rows import SessionKind, SessionRow

_NO_BEFORE = "it is a session of another day: open an earlier one from the history as well"
_ELSEWHERE = "it was a battle over the network: the friend's strokes are at their station, so it cannot be judged here"
_USUAL_BPM = 100.0


@dataclass(frozen=True, slots=True, eq=False)
class OpenedTake:
    """What was just played: the `take`, and the click that it was played to."""

    take: Performance
    click: FreeClick


@dataclass(frozen=True, slots=True, eq=False)
class OpenedBattle:
    """A battle that is over, and its `folder`, empty where it is gone."""

    result: BattleResult
    folder: str


@dataclass(frozen=True, slots=True, eq=False)
class Opened:
    """A session as it is opened: its row, and what it was."""

    row: SessionRow
    what: SavedSession | OpenedTake | OpenedBattle


def opened_session(number: int, settings: Settings) -> Opened:
    """The session with that id; raises `BadInput` where its capture is kept nowhere or unreadable, `DeviceError`."""
    history = history_of(settings)
    chosen = choose_session(history, settings.student, str(number))
    assert chosen.row is not None, "it was chosen by its number"
    folder = "" if chosen.folder is None else str(chosen.folder)
    if chosen.row.kind is SessionKind.LESSON:
        return Opened(chosen.row, _lesson(chosen.row, folder, settings))
    capture = parse_capture(chosen.capture_data(history), chosen.source)
    if chosen.row.kind is SessionKind.BATTLE:
        if "network" in _document(history, chosen.row, BATTLE_NAME):
            raise BadInput(chosen.source, "", _ELSEWHERE)
        return Opened(chosen.row, OpenedBattle(judge_battle_again(capture), folder))
    return Opened(chosen.row, _take(history, chosen.row, capture, settings))


def _lesson(row: SessionRow, folder: str, settings: Settings) -> SavedSession:
    kept = kept_session(session_place(str(row.id), settings), settings)
    day = row.started.date()
    shown = shown_result(kept.result, kept.document, folder, _NO_BEFORE, whose(day), day)
    return SavedSession(kept.result, shown)


def whose(day: date) -> str:
    """Who played a session of another day, as its page says it."""
    return f"you, {day.day} {day:%b %Y}"


def _take(history: History, row: SessionRow, capture: Capture, settings: Settings) -> OpenedTake:
    kept = _document(history, row, TAKE_NAME)
    tempo = kept.get("tempo_bpm")
    tempo_bpm = float(tempo) if isinstance(tempo, int | float) and tempo > 0 else _USUAL_BPM
    click = FreeClick(tempo_bpm, PLAIN if kept.get("click") is True else None)
    return OpenedTake(take_of(capture, latency_of(settings, load_calibration()), None), click)


def _document(history: History, row: SessionRow, name: str) -> dict[str, Json]:
    """A document of the session as it was kept; empty where it has none."""
    body = history.document(row.id, name)
    if body is None:
        return {}
    try:
        found = json.loads(body)
    except ValueError:
        found = None
    if not isinstance(found, dict):
        raise BadInput(f"session {row.id}", name, "is no JSON document")
    return found
