"""A result that leaves a lag out: what the student says of it changes what is known of the devices, and the report."""

import json
from pathlib import Path
from typing import Any

import pytest

from station.app.actions.equipment_actions import AnswerLag
from station.app.actions.practice_actions import Begin
from station.app.controller import Controller
from station.app.equipment.lag_answer import last_lag
from station.app.room_state import Stage
from station.app.sessions.launch import Launch
from station.core.errors import DeviceError
from station.core.events import DeviceFound, Hit
from station.core.measured_latency import GROOVE, load_calibration
from station.core.pieces import Piece, Zone
from station.core.settings import Settings
from station.core.units import NS_PER_S
from station.drills.library import find_lesson
from station.engine.messages import Sounding, Started
from station.practice.session.device_latency import Latency, latency_of
from station.practice.session.plan import PlanOptions, plan_practice
from station.practice.session.rising_tempo import Rise
from station.store.opening import history_of
from tests.fakes.human_takes import Added, Human, human_hits
from tests.fakes.stations import Line, room, station_on, store_with

KIT, OUTPUT = "TD-17", "Headphones"
PLAN = plan_practice(find_lesson("first-groove"), PlanOptions(loops=6, demonstrations=0, rise=Rise(40, 6, 100)))


def played(sessions: Path, late_ms: float, seed: int = 4, latency: Latency | None = None) -> Controller:
    line = Line()
    station = station_on([line], store_with(sessions, ask_first=False), Launch(PLAN, latency=latency))
    station.dispatch(Begin())
    line.says += [DeviceFound(0, KIT), Sounding(OUTPUT), Started(NS_PER_S, OUTPUT)]
    rows = human_hits(PLAN.score, seed, Human(sd_ms=20.0, lean_sd_ms=3.0, stand_ms=-10.0), Added(shift_ms=late_ms))
    passes_ns = NS_PER_S + PLAN.passes_start_ns
    hits = [
        Hit(passes_ns + int(row["at_ns"]), Piece(row["piece"]), Zone(row["zone"]), int(row["velocity"]), device=KIT)
        for row in rows
    ]
    hits.sort(key=lambda hit: hit.at_ns)
    line.says += hits
    station.update(NS_PER_S + PLAN.end_ns + 2 * NS_PER_S)
    assert room(station).stage is Stage.RESULT
    return station


def document(station: Controller) -> dict[str, Any]:
    report = station.view().report
    assert report is not None
    return dict(report.document)


def kept(sessions: Path) -> dict[str, Any]:
    (path,) = sessions.glob("*/*/report.json")
    read: dict[str, Any] = json.loads(path.read_text())
    return read


@pytest.fixture(autouse=True)
def own_settings(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))


def test_taken_out_it_is_stored_and_the_next_session_is_on_time(tmp_path: Path) -> None:
    station = played(tmp_path / "a", 100.0)
    lag_ms = room(station).lag_ms
    assert lag_ms == pytest.approx(90.0, abs=10)
    before = document(station)
    assert before["score"] > 70
    station.dispatch(AnswerLag(take_out=True))
    assert room(station).lag_ms is None, "it is asked once"
    stored = load_calibration().outputs[OUTPUT]
    assert stored.by == GROOVE
    assert stored.latency_ms == pytest.approx(lag_ms, abs=0.01)
    after = document(station)
    assert after["score"] == before["score"]
    assert after["lag"]["answer"] == kept(tmp_path / "a")["lag"]["answer"] == "taken_out"
    assert after["session"]["output_latency_ms"] == pytest.approx(lag_ms, abs=0.01)
    station.close()
    next_one = played(tmp_path / "a", 100.0, latency=latency_of(Settings(), load_calibration()))
    assert room(next_one).lag_ms is None, "nor is the same lag found once more"
    assert document(next_one)["score"] > 70
    next_one.close()


def test_left_in_it_counts_and_nobody_asks_again(tmp_path: Path) -> None:
    station = played(tmp_path / "a", 100.0)
    fair = document(station)["score"]
    station.dispatch(AnswerLag(take_out=False))
    assert load_calibration().left == {OUTPUT}
    assert document(station)["score"] < fair - 20
    assert kept(tmp_path / "a")["lag"]["answer"] == "left"
    [row] = history_of(Settings()).sessions("student")
    assert row.score == kept(tmp_path / "a")["score"], "the history has the report that was written anew"
    station.close()
    again = played(tmp_path / "b", 100.0)
    assert room(again).lag_ms is None
    assert document(again)["lag"]["answer"] == "none"
    again.close()


def test_sessions_before_it_on_the_same_devices_make_it_surer(tmp_path: Path) -> None:
    widths = []
    for seed in (4, 5):
        station = played(tmp_path, 100.0, seed)
        low_ms, high_ms = document(station)["lag"]["ci"]
        widths.append(high_ms - low_ms)
        station.close()
        for folder in (tmp_path / "student").iterdir():  # the next one is on another day
            if not folder.name.startswith("2001"):
                folder.rename(folder.with_name(f"2001-01-01T10-00-0{seed}_first-groove"))
    assert document_lag(tmp_path)["answer"] == "open"
    once = document_lag(tmp_path)["runs"]
    assert [round(run["tempo_bpm"]) for run in once] == [100, 60], "its own runs alone are kept"
    assert widths[1] < widths[0]


def document_lag(sessions: Path) -> dict[str, Any]:
    """The lag in the last report."""
    last = sorted(sessions.glob("student/*/report.json"))[-1]
    lag: dict[str, Any] = json.loads(last.read_text())["lag"]
    return lag


def test_the_terminal_finds_the_lag_that_the_last_session_left_open(tmp_path: Path) -> None:
    station = played(tmp_path / "a", 100.0)
    settings = station.view().settings
    findings, target = last_lag(settings)
    (row,) = findings.rows
    assert (row.what, row.device, target.name) == ("equipment", OUTPUT, OUTPUT)
    assert row.estimate.value_ms == pytest.approx(room(station).lag_ms, abs=0.1)
    assert row.estimate.trusted, "it was the same on all pads at both tempi"
    assert "your habit is in it" in row.estimate.remarks[0]
    station.dispatch(AnswerLag(take_out=True))
    with pytest.raises(DeviceError, match="no lag is open"):
        last_lag(settings)
    station.close()
