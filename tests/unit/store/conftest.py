"""A history on each kind of database."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from station.store.database import Database
from station.store.database_url import sqlite_url
from station.store.history import History
from tests.fakes.postgres_server import PostgresServer, postgres_server


@pytest.fixture(scope="session")
def postgres() -> Iterator[PostgresServer]:
    """One server for all tests of a process."""
    with postgres_server() as server:
        yield server


@pytest.fixture(params=["sqlite", "postgresql"])
def url(request: pytest.FixtureRequest, tmp_path: Path) -> str:
    """A new database."""
    if request.param == "sqlite":
        return sqlite_url(tmp_path / "history.sqlite3")
    server: PostgresServer = request.getfixturevalue("postgres")
    return server.new_database()


@pytest.fixture
def history(url: str) -> Iterator[History]:
    """A history in which nothing is kept."""
    made = History(Database(url))
    yield made
    made.database.close()
