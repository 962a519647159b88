"""Writers of a history that are killed in the middle, fifty times; nothing that was kept may be lost.

    PYTHONPATH=. .venv/bin/python benchmarks/history_kills.py [--times 50]

First a process keeps sessions in a loop, on SQLite and on PostgreSQL, and tells the number of each when it is kept; it
is killed (SIGKILL) at random moments. Every session that was told must be whole afterwards: its row, figures,
judgements, documents, its capture and what was learnt in it.

Then `station practice` is killed, at a random moment while a virtual student plays, in a folder where sessions were
kept before. After each kill the file must be sound, every row of the sessions kept before be as it was, and the session
that was cut off be offered; `station practice --recover` judges it, and it is kept from then on as the others are.

Targets: nothing lost, nothing kept by half, every session offered and judged.
"""

import argparse
import contextlib
import hashlib
import io
import os
import random
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time
from contextlib import closing
from pathlib import Path

from station.cli.command_line import main as station
from station.practice.history.session_files import CAPTURE_NAME, DOCUMENT_NAME
from station.store.database import Database
from station.store.database_url import sqlite_url
from station.store.history import History
from station.store.rows import SessionState
from tests.fakes.history_children import history_children, keep_in_a_loop
from tests.fakes.postgres_server import postgres_server
from tests.fakes.whole_sessions import faults_in

STUDENT = "virtual-student"
_PRACTISES = [
    "practice",
    "rock-1",
    "--headless",
    "--virtual-student",
    "pro,seed=3",
    "--no-pictures",
    "--no-demonstration",
    "--loops",
]
_WITHIN_S = 60.0
_PLAYS_S = 1.0
"""About what the virtual student takes for the session."""
_LOOPS = ("10", "40", "200")
"""The shorter ones are over, and being judged and kept, when some kills come."""
_STROKES_BYTES = 500
_TABLES = ("figures", "judgements", "documents")


def kills_of_a_loop(url: str, times: int, chance: random.Random) -> None:
    """Kill who keeps sessions in a loop, and tell what is left."""
    told: list[int] = []
    for _ in range(times):
        ours, theirs = history_children().Pipe(duplex=False)
        first = told[-1] + 2 if told else 1
        child = history_children().Process(target=keep_in_a_loop, args=(url, "Ann", first, 1_000, theirs))
        child.start()
        theirs.close()
        told += [ours.recv() for _ in range(chance.randint(1, 5))]
        time.sleep(chance.random() * 0.06)
        child.kill()
        child.join()
        with ours, contextlib.suppress(EOFError):
            while True:
                told.append(ours.recv())
    history = History(Database(url))
    names = history.session_names("Ann")
    lost = {f"session-{number}" for number in told} - names
    print(
        f"  {times} kills, {len(told)} sessions told: {len(lost)} lost (0), {len(names) - len(told)} kept and not told"
    )
    print(f"  not whole: {len(faults := faults_in(history, 'Ann'))} (0) {faults[:3]}")
    if history.database.path is not None:
        print(f"  integrity check: {integrity(history.database.path)}")
    history.database.close()


def integrity(path: Path) -> str:
    """What SQLite says of a file."""
    with closing(sqlite3.connect(path)) as file:
        return str(file.execute("PRAGMA integrity_check").fetchone()[0])


def kept_rows(path: Path) -> dict[str, str]:
    """A checksum of everything that is kept of each session, by its name."""
    with closing(sqlite3.connect(path)) as file:
        sums = {}
        for number, name, capture in file.execute("SELECT id, name, capture_sha256 FROM sessions WHERE state = 'kept'"):
            asked = [("SELECT * FROM sessions WHERE id = ?", number)]
            asked += [(f"SELECT * FROM {table} WHERE session_id = ? ORDER BY 2, 3", number) for table in _TABLES]
            asked += [("SELECT * FROM captures WHERE sha256 = ?", capture)]
            rows = [file.execute(words, (key,)).fetchall() for words, key in asked]
            sums[name] = hashlib.sha256(repr(rows).encode()).hexdigest()
    return sums


def killed_session(folder: Path, chance: random.Random) -> Path:
    """Kill a session at a random moment after its first strokes; its folder."""
    before = {*folder.iterdir()}
    command = [sys.executable, "-m", "station.cli.command_line", *_PRACTISES, chance.choice(_LOOPS)]
    writer = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
    until = time.monotonic() + _WITHIN_S
    while time.monotonic() < until:
        new = [each for each in folder.iterdir() if each not in before and _has_strokes(each / CAPTURE_NAME)]
        if new:
            time.sleep(chance.random() * _PLAYS_S)
            with contextlib.suppress(ProcessLookupError):
                os.killpg(writer.pid, signal.SIGKILL)
            writer.wait()
            return new[0]
        time.sleep(0.002)
    raise TimeoutError("nobody plays")


def _has_strokes(capture: Path) -> bool:
    return capture.is_file() and capture.stat().st_size > _STROKES_BYTES


def kills_of_practice(times: int, chance: random.Random, home: Path) -> None:
    """Kill sessions that are being played, recover each, and tell what is left."""
    path = home / "data" / "drum-station" / "history.sqlite3"
    for _ in range(2):
        _status([*_PRACTISES, "1"])
        time.sleep(1.0)  # a session's folder is named by its second
    history = History(Database(sqlite_url(path)))
    folder = Path(history.sessions(STUDENT)[0].folder).parent
    before = kept_rows(path)
    print(f"  {len(before)} sessions kept before")
    over: list[Path] = []
    cut_off = lost = unsound = not_offered = not_judged = 0
    for _ in range(times):
        session = killed_session(folder, chance)
        unsound += integrity(path) != "ok"
        now = kept_rows(path)
        lost += sum(now.get(name) != was for name, was in before.items())
        if (session / DOCUMENT_NAME).exists():  # judged before it was killed, kept or not
            over.append(session)
        else:
            cut_off += 1
            begun = {Path(row.folder) for row in history.sessions(STUDENT, state=SessionState.BEGUN)}
            not_offered += session not in begun
            status = _status(["practice", "--recover", str(session), "--no-pictures"])
            not_judged += status != 0 or session.name not in history.session_names(STUDENT)
        before = kept_rows(path)
    print(f"  {times} kills: {lost} kept sessions lost or changed (0), the file unsound {unsound} times (0)")
    print(f"  {cut_off} sessions cut off: {not_offered} not offered (0), {not_judged} not judged and kept (0)")
    _status([*_PRACTISES, "1"])
    missing = [each.name for each in over if each.name not in history.session_names(STUDENT)]
    print(f"  {len(over)} were over already: {len(missing)} not kept when the station is used again (0)")


def _status(words: list[str]) -> int:
    """The exit status of `station` with these words, whose output nobody reads."""
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        return station(words)


def main() -> None:
    """Kill and tell."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--times", type=int, default=50)
    times = parser.parse_args().times
    chance = random.Random(2)
    with tempfile.TemporaryDirectory() as name:
        home = Path(name)
        places = {"XDG_CONFIG_HOME": "config", "XDG_DATA_HOME": "data", "XDG_DOCUMENTS_DIR": "documents", "HOME": ""}
        os.environ.update({key: str(home / place) for key, place in places.items()})
        print("a loop that keeps sessions, SQLite")
        kills_of_a_loop(sqlite_url(home / "loop.sqlite3"), times, chance)
        with postgres_server() as server:
            print("a loop that keeps sessions, PostgreSQL")
            kills_of_a_loop(server.new_database(), times, chance)
        print("station practice")
        kills_of_practice(times, chance, home)


if __name__ == "__main__":
    main()
