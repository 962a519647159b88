"""The returns of a teacher: per student and lesson, judged again one after the other where that is asked."""

from dataclasses import replace
from pathlib import Path

import pytest

from station.app.teacher_desk.returns_desk import ReturnsDesk, looked
from station.cli.command_line import main
from station.drills.library import lesson_path
from station.practice.exchange.note_file import SessionVerdict
from station.practice.exchange.return_file import return_bytes
from station.practice.exchange.teacher_store import find_received, keep_given, keep_note_on, receive
from tests.fakes.stations import store_with
from tests.fakes.work_at_once import WorkAtOnce
from tests.parcels_made import ASSIGNMENT, NOTE, RETURN_ID, TEXT, a_return


@pytest.fixture(scope="module")
def take(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a session of a virtual student."""
    folder = tmp_path_factory.mktemp("take") / "x"
    words = ("practice", "rock-1", "--loops", "1", "--no-demonstration", "--headless", "--no-pictures")
    assert main([*words, "--virtual-student", "pro,seed=1", "--report", str(folder)]) == 0
    return folder


def test_a_return_is_listed_judged_and_answered(take: Path, tmp_path: Path) -> None:
    store = store_with(tmp_path)
    lesson = replace(ASSIGNMENT.lessons[0], name="rock-1", text=lesson_path("rock-1").read_text(encoding="utf-8"))
    keep_given(replace(ASSIGNMENT, lessons=(lesson,)), store.now)
    sent = a_return(take)
    better = replace(sent.sessions[0], lesson_text=TEXT)
    (tmp_path / "x.drum-return").write_bytes(return_bytes(replace(sent, sessions=(sent.sessions[0], better))))
    one, _ = receive(tmp_path / "x.drum-return", store.now)
    desk = ReturnsDesk(store, WorkAtOnce)
    assert desk.rows() == []
    desk.take(looked(store.now))
    assert desk.now.faults == ()
    (row,) = desk.rows()
    assert (row.shelf, row.student, row.title, row.lesson) == ("Tuesday group", "Zoë", "Week 3", "rock-1")
    assert [state.words for state in row.goals][1:3] == ["2 of 4 passes", "0.3 of 12.5 minutes"]
    assert [each.heard for each in row.sessions] == [None, None]
    desk.judge(each.key for each in row.sessions)
    while desk.advance():
        pass
    (row,) = desk.rows()
    first, second = row.sessions
    assert first.heard is not None
    assert (first.heard.differences, first.heard.figures.score) == ((), first.told.figures.score)
    assert second.fault is not None
    assert "session 2: its capture holds no session of rock-1 as it was sent" in second.fault
    assert not row.is_answered
    verdict = SessionVerdict(2, "rock-1", "again, please", reached=False)
    keep_note_on(one, replace(NOTE, return_id=RETURN_ID, sessions=(verdict,)))
    desk.take(looked(store.now))
    (row,) = desk.rows()
    assert row.is_answered
    assert [each.verdict for each in row.sessions] == [None, verdict]
    assert find_received(store.now, one.stem[:12]).note is not None
