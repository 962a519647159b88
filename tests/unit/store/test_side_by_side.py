"""Stations that write and reports that read are never in each other's way."""

from pathlib import Path

import pytest

from station.core.errors import DeviceError
from station.store import sqlite_files
from station.store.database import Database
from station.store.database_url import sqlite_url
from station.store.history import History
from station.store.patience import in_a_hurry
from station.store.rows import SessionState
from station.store.sessions import session_names
from station.store.student_names import student_key
from station.store.turns import in_turn
from tests.fakes.history_children import history_children, keep_in_a_loop, session_of

_EACH = 12


def test_two_stations_write_while_a_report_reads_one_state(url: str) -> None:
    history = History(Database(url))
    history.keep(session_of("Ann", 1))
    children = history_children()
    pipes = []
    with history.database.reading() as report:
        before = session_names(report, "ann", SessionState.KEPT)
        for first in (100, 200):  # the same student at both
            ours, theirs = children.Pipe(duplex=False)
            children.Process(target=keep_in_a_loop, args=(url, "Ann", first, _EACH, theirs), daemon=True).start()
            pipes.append(ours)
        told = [list(iter(pipe.recv, None)) for pipe in pipes]
        assert session_names(report, "ann", SessionState.KEPT) == before == {"session-1"}
    assert told == [list(range(first, first + _EACH)) for first in (100, 200)]
    assert len(history.session_names("Ann")) == 1 + 2 * _EACH
    history.database.close()


def test_the_log_is_cut_when_a_long_reader_is_done(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    most = 100_000
    monkeypatch.setattr(sqlite_files, "_LONGEST_LOG", most)
    history = History(Database(sqlite_url(tmp_path / "history.sqlite3")))
    log = tmp_path / "history.sqlite3-wal"
    with history.database.reading() as report:
        assert session_names(report, "ann", SessionState.KEPT) == frozenset()
        for number in range(40):
            history.keep(session_of("Ann", number))
        grown = log.stat().st_size
        assert grown > 10 * most
    with history.database.reading() as report:  # so that the log stays for us to see
        history.keep(session_of("Ann", 40))
        history.keep(session_of("Ann", 41))
        assert log.stat().st_size < grown / 5


def test_who_is_in_a_hurry_is_refused_by_a_writer_at_work_and_nothing_is_half_kept(history: History, url: str) -> None:
    other = History(Database(url))
    with history.database.writing() as connection:
        in_turn(connection, student_key("Ann"))
        with in_a_hurry(0.1), pytest.raises(DeviceError, match=r"locked|has not answered"):
            other.keep(session_of("Ann", 1))
    assert history.session_names("Ann") == frozenset()
    other.keep(session_of("Ann", 1))
    assert history.session_names("Ann") == {"session-1"}
    other.database.close()
