"""A history is opened wherever it may be; where it may not, one clear line says why and nothing is changed."""

import os
import shutil
import sqlite3
import stat
import subprocess
import sys
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from types import SimpleNamespace

import pytest
from sqlalchemy import Engine, event
from sqlalchemy.engine.interfaces import DBAPIConnection

from station.core.errors import BadInput, DeviceError
from station.store.database import Database
from station.store.database_url import sqlite_url
from station.store.history import History
from tests.fakes.history_children import history_children, open_at_once, session_of

_SAME_MOMENT = 10


def test_a_new_file_is_its_owners_alone(tmp_path: Path) -> None:
    path = tmp_path / "new" / "folder" / "history.sqlite3"
    history = History(Database(sqlite_url(path)))
    with history.database.reading() as connection:
        connection.exec_driver_sql("SELECT * FROM students").all()
        modes = {each.name: stat.S_IMODE(each.stat().st_mode) for each in path.parent.iterdir()}
    assert modes == dict.fromkeys(("history.sqlite3", "history.sqlite3-wal", "history.sqlite3-shm"), 0o600)


@pytest.mark.parametrize(
    "name", ["a b", "what?", "100%41", "#1", "Übung", "鼓", "a&b=c", "semi;colon", "q'uote\"", "ol\udce9"]
)
def test_a_file_may_have_any_name(tmp_path: Path, name: str) -> None:
    path = tmp_path / name / f"{name}.sqlite3"
    History(Database(sqlite_url(path))).remember("Ann", levels={"rock-1": "beginner"})
    assert path.is_file()
    assert History(Database(sqlite_url(path))).levels("Ann") == {"rock-1": "beginner"}
    assert [each.name for each in tmp_path.iterdir()] == [name]


def test_what_is_no_database_stays_as_it_is(tmp_path: Path) -> None:
    path = tmp_path / "history.sqlite3"
    path.write_bytes(b"My notes, which are longer than the first hundred bytes of a database. " * 20)
    before = path.read_bytes()
    with pytest.raises(DeviceError, match="file is not a database"):
        History(Database(sqlite_url(path)))
    assert path.read_bytes() == before
    with pytest.raises(DeviceError, match="Is a directory"):
        History(Database(sqlite_url(tmp_path)))
    with pytest.raises(DeviceError, match=r"Not a directory|File exists"):
        History(Database(sqlite_url(path / "history.sqlite3")))
    assert [each.name for each in tmp_path.iterdir()] == ["history.sqlite3"]


def test_another_programs_file_stays_as_it_is(tmp_path: Path) -> None:
    path = tmp_path / "songs.sqlite3"
    with closing(sqlite3.connect(path)) as songs:
        songs.execute("CREATE TABLE songs (name)")
    before = path.read_bytes()
    with pytest.raises(BadInput, match="is another program's database"):
        History(Database(sqlite_url(path)))
    assert path.read_bytes() == before
    assert [each.name for each in tmp_path.iterdir()] == ["songs.sqlite3"]


_READS_AND_WRITES = """
import sys
from pathlib import Path
from station.core.errors import StationError
from station.store.database import Database
from station.store.database_url import sqlite_url
from station.store.history import History
for path in sys.argv[1:]:
    try:
        History(Database(sqlite_url(Path(path)))).remember("Ann", levels={"rock-1": "beginner"})
    except StationError as fault:
        print(type(fault).__name__, fault)
    else:
        print("written")
"""


@pytest.mark.skipif(not hasattr(os, "geteuid"), reason="rights are told otherwise there")
def test_what_may_not_be_written_is_told_in_a_line(tmp_path: Path) -> None:
    file, folder = tmp_path / "file" / "history.sqlite3", tmp_path / "folder" / "history.sqlite3"
    for path in (file, folder):
        History(Database(sqlite_url(path)))
    missing = tmp_path / "folder" / "new.sqlite3"
    file.chmod(0o400)
    folder.parent.chmod(0o500)
    if os.geteuid() == 0:  # who may do everything otherwise
        if (setpriv := shutil.which("setpriv")) is None:
            pytest.skip("root may write everything")
        drop = [setpriv, "--inh-caps=-all", "--bounding-set=-all"]
    else:
        drop = []
    words = [*drop, sys.executable, "-c", _READS_AND_WRITES, str(file), str(folder), str(missing)]
    told = subprocess.run(words, capture_output=True, text=True, timeout=60, check=False)
    folder.parent.chmod(0o700)
    lines = told.stdout.splitlines()
    assert (told.stderr, len(lines)) == ("", 3), told
    assert all(line.startswith("DeviceError history ") for line in lines), lines
    assert "Permission denied" in lines[0]
    assert "Permission denied" in lines[2]


@contextmanager
def _room_for(engine: Engine, pages: int) -> Iterator[None]:
    """Until the block ends the file may have so many pages of 4 KiB, as on a disk that is full then."""

    def limited(connection: DBAPIConnection, _record: object) -> None:
        connection.cursor().execute(f"PRAGMA max_page_count = {pages}")

    event.listen(engine, "connect", limited)
    yield
    event.remove(engine, "connect", limited)


def test_a_full_disk_loses_nothing_that_was_kept(tmp_path: Path) -> None:
    history = History(Database(sqlite_url(tmp_path / "history.sqlite3")))
    with _room_for(history.database.engine, 100):
        for number in (1, 2, 3):
            history.keep(session_of("Ann", number, notes=100))
        with pytest.raises(DeviceError, match="database or disk is full"):
            history.keep(session_of("Ann", 4, notes=10_000))
    assert history.session_names("Ann") == {"session-1", "session-2", "session-3"}
    assert [len(history.judgements(row.id)) for row in history.sessions("Ann")] == [100] * 3
    history.keep(session_of("Ann", 4))
    assert len(history.session_names("Ann")) == 4


def test_a_file_that_many_make_at_the_same_moment(url: str) -> None:
    children = history_children()
    together = children.Barrier(_SAME_MOMENT)
    told = children.SimpleQueue()
    processes = [
        children.Process(target=open_at_once, args=(url, number, together, told)) for number in range(_SAME_MOMENT)
    ]
    for each in processes:
        each.start()
    for each in processes:
        each.join(60)
    assert sorted(told.get() for _ in processes) == ["kept"] * _SAME_MOMENT
    history = History(Database(url))
    assert len(history.students()) == _SAME_MOMENT
    history.database.close()


def test_a_full_disk_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    database = Database(sqlite_url(tmp_path / "history.sqlite3"))
    monkeypatch.setattr(shutil, "disk_usage", lambda _path: SimpleNamespace(free=0))  # as a full disk says it
    with pytest.raises(DeviceError, match="disk I/O error; the disk that it is on is full"), database.refusals():
        raise sqlite3.OperationalError("disk I/O error")
