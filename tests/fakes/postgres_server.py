"""A real PostgreSQL server of Debian's package, with a data folder of its own, on a socket of its own."""

import os
import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import count
from pathlib import Path
from urllib.parse import quote

_WITHIN_S = 60
_USER = "postgres"
WITH_PASSWORD = "pupil"
"""Of all users of the server, who has to say a password; a test that needs them makes them."""


def _programs() -> Path:
    """Where the newest server's programs are."""
    found = sorted(Path("/usr/lib/postgresql").glob("*/bin"), key=lambda path: int(path.parent.name))
    assert found, "PostgreSQL is not installed: make setup-test"
    return found[-1]


class PostgresServer:
    """A server that runs; every `new_database` of it is empty."""

    def __init__(self, folder: Path) -> None:
        self._folder, self._numbers = folder, count()
        self._free: list[str] = []

    def new_database(self, *options: str) -> str:
        """The URL of a new, empty database, made with `options` of createdb."""
        name = f"history_{next(self._numbers)}"
        _run(["createdb", "-h", str(self._folder), "-U", _USER, *options, name])
        return self.url(name)

    @contextmanager
    def lent_database(self) -> Iterator[str]:
        """The URL of an empty database, in which what others have left is gone; others get it after the block.

        A new one is a copy of seven megabytes in 300 files.
        """
        url = self._free.pop() if self._free else self.new_database()
        try:
            yield url
        finally:
            _empty(url)
            self._free.append(url)

    def url(self, name: str, user: str = _USER) -> str:
        """The URL of a database of that name for a user; one with a password is `user:password`."""
        return f"postgresql://{user}@/{name}?host={quote(str(self._folder))}"


def _empty(url: str) -> None:
    import psycopg  # most tests need no server

    others = "FROM pg_stat_activity WHERE datname = current_database() AND pid <> pg_backend_pid()"
    with psycopg.connect(url, autocommit=True, options="-c default_transaction_read_only=off") as connection:
        connection.execute(f"SELECT pg_terminate_backend(pid, 5000) {others}")
        connection.execute("SET client_min_messages = warning; DROP SCHEMA public CASCADE; CREATE SCHEMA public")
        connection.execute(f'ALTER DATABASE "{connection.info.dbname}" RESET ALL')
        connection.execute("GRANT USAGE ON SCHEMA public TO PUBLIC")  # as in a new one


@contextmanager
def postgres_server() -> Iterator[PostgresServer]:
    """A server until the block ends; nothing of it stays."""
    folder = Path(tempfile.mkdtemp(prefix="pg-"))  # short: a socket's path has 107 letters at most
    try:
        if os.geteuid() == 0:
            shutil.chown(folder, _USER)
        data = folder / "data"
        _run(["initdb", "-D", str(data), "-U", _USER, "-A", "trust", "-N", "-E", "UTF8", "--locale", "C.UTF-8"])
        access = data / "pg_hba.conf"
        access.write_text(f"local all {WITH_PASSWORD} scram-sha-256\n{access.read_text()}")
        options = f"-k {folder} -c listen_addresses= -c fsync=off -c max_connections=40"
        _run(["pg_ctl", "-D", str(data), "-w", "-l", str(folder / "log"), "-o", options, "start"])
        try:
            yield PostgresServer(folder)
        finally:
            _run(["pg_ctl", "-D", str(data), "-m", "immediate", "-w", "stop"])
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def _run(words: list[str]) -> None:
    """Run one of its programs: never as root, whom the server refuses."""
    user = _USER if os.geteuid() == 0 else None
    subprocess.run(
        [str(_programs() / words[0]), *words[1:]],
        check=True,
        stdout=subprocess.DEVNULL,
        timeout=_WITHIN_S,
        user=user,
        cwd="/",
    )
