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

    def new_database(self, *options: str) -> str:
        """The URL of a new, empty database, made with `options` of createdb."""
        name = f"history_{next(self._numbers)}"
        _run(["createdb", "-h", str(self._folder), "-U", _USER, *options, name])
        return self.url(name)

    def url(self, name: str, user: str = _USER) -> str:
        """The URL of a database of that name for a user; one with a password is `user:password`."""
        return f"postgresql://{user}@/{name}?host={quote(str(self._folder))}"


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
