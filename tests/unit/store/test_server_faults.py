"""A server that is away, refuses or breaks off: one clear line without the password, and the next use works again."""

import os
import signal
import socket
from collections.abc import Iterator

import pytest
from sqlalchemy import text

from station.core.errors import BadInput, DeviceError
from station.store import server_links
from station.store.database import Database
from station.store.history import History
from station.store.turns import in_turn
from tests.fakes.history_children import memory_of, session_of
from tests.fakes.postgres_server import WITH_PASSWORD, PostgresServer

_PASSWORD = "s3cret"


@pytest.fixture
def url(postgres: PostgresServer) -> Iterator[str]:
    """An empty database of the server."""
    with postgres.lent_database() as lent:
        yield lent


@pytest.fixture
def history(url: str) -> Iterator[History]:
    """A history on the server."""
    made = History(Database(url))
    yield made
    made.database.close()


@pytest.fixture
def other(history: History, url: str) -> Iterator[History]:
    """The same history, by another station."""
    made = History(Database(url))
    yield made
    made.database.close()


def _refused(url: str) -> str:
    with pytest.raises(DeviceError) as fault:
        History(Database(url))
    told = str(fault.value)
    assert told.startswith("history postgresql://")
    assert _PASSWORD not in told
    return told


def _pid(history: History) -> int:
    """The process of the server that answers the station's only connection."""
    with history.database.reading() as connection:
        return int(connection.execute(text("SELECT pg_backend_pid()")).scalar_one())


def _terminate(other: History, pid: int) -> None:
    with other.database.writing() as connection:
        assert connection.execute(text("SELECT pg_terminate_backend(:pid, 10000)"), {"pid": pid}).scalar_one()


def test_a_server_that_is_not_there() -> None:
    with socket.create_server(("127.0.0.1", 0)) as unused:
        port = unused.getsockname()[1]
    told = _refused(f"postgresql://ann:{_PASSWORD}@127.0.0.1:{port}/drums")
    assert "Connection refused" in told
    assert f"ann@127.0.0.1:{port}/drums" in told


def test_a_server_that_takes_a_call_and_never_answers(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(server_links, "CONNECT_S", 2)  # the least that libpq takes
    with socket.create_server(("127.0.0.1", 0)) as silent:
        told = _refused(f"postgresql://ann:{_PASSWORD}@127.0.0.1:{silent.getsockname()[1]}/drums")
    assert "timeout expired" in told


def test_whom_a_server_refuses(postgres: PostgresServer, history: History) -> None:
    name = history.database.url.database or ""
    with history.database.writing() as connection:
        connection.exec_driver_sql(f"CREATE ROLE {WITH_PASSWORD} LOGIN PASSWORD 'right'")
    assert 'database "nowhere" does not exist' in _refused(postgres.url("nowhere"))
    assert 'role "nobody" does not exist' in _refused(postgres.url(name, f"nobody:{_PASSWORD}"))
    assert "password authentication failed" in _refused(postgres.url(name, f"{WITH_PASSWORD}:{_PASSWORD}"))
    unasked = _refused(postgres.url(name, WITH_PASSWORD))
    assert "no password supplied: it belongs in the file ~/.pgpass" in unasked
    assert "fe_sendauth" not in unasked
    assert "permission denied" in _refused(postgres.url(name, f"{WITH_PASSWORD}:right"))


def test_a_database_that_cannot_hold_every_name(postgres: PostgresServer) -> None:
    url = postgres.new_database("-E", "LATIN1", "--locale=C", "-T", "template0")
    with pytest.raises(BadInput, match=r"encoding LATIN1: .*createdb -E UTF8"):
        History(Database(url))


def test_a_connection_that_is_lost_while_it_rests_is_made_anew(history: History, other: History) -> None:
    history.keep(session_of("Ann", 1))
    _terminate(other, _pid(history))
    assert history.session_names("Ann") == {"session-1"}


def test_a_connection_that_is_lost_in_a_transaction_keeps_nothing_of_it(history: History, other: History) -> None:
    def lose_it() -> None:
        with history.database.writing() as connection:
            in_turn(connection, "ann")
            connection.exec_driver_sql("INSERT INTO students (key, name) VALUES ('ann', 'Ann')")
            pid = connection.exec_driver_sql("SELECT pg_backend_pid()").scalar_one()
            _terminate(other, pid)
            connection.exec_driver_sql("INSERT INTO students (key, name) VALUES ('ben', 'Ben')")

    with pytest.raises(DeviceError, match="terminating connection"):
        lose_it()
    assert history.students() == []
    history.keep(session_of("Ann", 1))
    assert history.session_names("Ann") == {"session-1"}


def test_a_server_that_falls_silent_is_given_up(
    history: History, other: History, monkeypatch: pytest.MonkeyPatch
) -> None:
    history.keep(session_of("Ann", 1))
    pid = _pid(history)
    monkeypatch.setattr(server_links, "ANSWER_S", 0.0)
    monkeypatch.setattr(server_links, "CONNECT_S", 0.3)
    os.kill(pid, signal.SIGSTOP)
    try:
        with history.database.engine.connect() as connection:
            assert connection is not None  # the silent one was given up by itself, and another one was made
        assert history.session_names("Ann") == {"session-1"}
    finally:
        os.kill(pid, signal.SIGCONT)

    def fall_silent() -> None:
        with history.database.writing() as connection:
            pid = connection.exec_driver_sql("SELECT pg_backend_pid()").scalar_one()
            os.kill(pid, signal.SIGSTOP)
            try:
                connection.exec_driver_sql("INSERT INTO students (key, name) VALUES ('ben', 'Ben')")
            finally:
                os.kill(pid, signal.SIGCONT)

    with pytest.raises(DeviceError, match="the server has not answered for"):
        fall_silent()
    assert [each.name for each in history.students()] == ["Ann"]


def test_one_student_has_one_writer_and_each_student_their_own(
    url: str, history: History, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(server_links, "PATIENCE_S", 0.2)
    hasty = History(Database(url))
    with history.database.writing() as connection:
        in_turn(connection, "ann")
        with pytest.raises(DeviceError, match="lock timeout"):
            hasty.remember("Ann", [memory_of(1)])
        hasty.remember("Ben", [memory_of(1)])
        with pytest.raises(DeviceError, match="lock timeout"):
            hasty.delete_student("Ben")
    assert hasty.delete_student("Ben")
    hasty.database.close()


def test_the_server_itself_ends_what_takes_too_long(history: History) -> None:
    with history.database.reading() as connection:
        shown = {
            name: connection.exec_driver_sql(f"SHOW {name}").scalar_one()
            for name in ("lock_timeout", "statement_timeout", "idle_in_transaction_session_timeout")
        }
    assert shown == {
        "lock_timeout": "10s",
        "statement_timeout": "1min",
        "idle_in_transaction_session_timeout": "1min",
    }
