"""A history on each kind of database."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from station.store.database import Database
from station.store.database_url import sqlite_url
from station.store.history import History
from tests.fakes.postgres_server import PostgresServer


@pytest.fixture(params=["sqlite", "postgresql"])
def url(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[str]:
    """An empty database."""
    if request.param == "sqlite":
        yield sqlite_url(tmp_path / "history.sqlite3")
        return
    server: PostgresServer = request.getfixturevalue("postgres")
    with server.lent_database() as lent:
        yield lent


@pytest.fixture
def history(url: str) -> Iterator[History]:
    """A history in which nothing is kept."""
    made = History(Database(url))
    yield made
    made.database.close()
