"""Two stations that keep sessions at once while a report reads the whole time, on SQLite and on PostgreSQL.

    PYTHONPATH=. .venv/bin/python benchmarks/history_writers.py [--sessions 150]

Each station is a process that keeps sessions of five minutes for the same student, one after the other; a report holds
one state of the history and reads all judgements again and again until both are done. Then the history is copied.

Targets: nobody is refused, the report sees one state, nobody waits longer than `PATIENCE_S`, and the log beside a
SQLite file is small again when the report is done. The server writes without fsync (its test configuration), SQLite
with it.
"""

import argparse
import statistics
import tempfile
import time
from multiprocessing.connection import Connection
from pathlib import Path

from sqlalchemy import Connection as DatabaseConnection

from station.core.errors import StationError
from station.store.copying import copy_history
from station.store.database import Database
from station.store.database_url import sqlite_url
from station.store.history import History
from station.store.patience import PATIENCE_S
from station.store.rows import SessionState
from station.store.sessions import judgements_of, sessions_of
from station.store.student_names import student_key
from tests.fakes.history_children import history_children, memory_of, session_of
from tests.fakes.postgres_server import postgres_server
from tests.fakes.whole_sessions import faults_in

STUDENT = "Ann"


def keep_timed(url: str, first: int, sessions: int, told: Connection) -> None:
    """Keep sessions and tell how long each took, in ms; a refusal is told in its words, and None is the end."""
    database = Database(url)
    history = History(database)
    for number in range(first, first + sessions):
        kept = session_of(STUDENT, number)
        begun = time.perf_counter()
        try:
            history.keep(kept, [memory_of(number)], {f"lesson-{number}": "beginner"})
        except StationError as fault:
            told.send(str(fault))
        else:
            told.send(1000 * (time.perf_counter() - begun))
    told.send(None)
    database.close()


def side_by_side(url: str, sessions: int) -> History:
    """Run two stations and a report, and tell how it went; the history that they have written."""
    history = History(Database(url))
    for number in range(20):
        history.keep(session_of(STUDENT, number), [memory_of(number)], {f"lesson-{number}": "beginner"})
    pipes: list[Connection] = []
    reads, log_bytes, path = set(), 0, history.database.path
    log = None if path is None else path.with_name(f"{path.name}-wal")
    with history.database.reading() as report:
        reads.add(read(report))
        for station in (1, 2):
            ours, theirs = history_children().Pipe(duplex=False)
            first = 10_000 * station
            history_children().Process(target=keep_timed, args=(url, first, sessions, theirs), daemon=True).start()
            pipes.append(ours)
        told: list[float | str] = []
        while pipes:
            for pipe in [each for each in pipes if each.poll(0)]:
                if (word := pipe.recv()) is None:
                    pipes.remove(pipe)
                else:
                    told.append(word)
            reads.add(read(report))
            log_bytes = max(log_bytes, 0 if log is None else log.stat().st_size)
    took_ms = sorted(word for word in told if isinstance(word, float))
    refused = [word for word in told if isinstance(word, str)]
    worst = f"95 % within {took_ms[int(0.95 * len(took_ms))]:.0f} ms, at most {took_ms[-1]:.0f} ms"
    print(f"  {len(took_ms)} sessions kept by two stations: median {statistics.median(took_ms):.0f} ms, {worst}")
    print(f"  refused: {len(refused)} {refused[:2]}; waits end after {1000 * PATIENCE_S:.0f} ms")
    print(f"  states that the report saw: {len(reads)} (1)")
    if log is not None:
        with history.database.reading() as later:
            read(later)
            for number in (30_000, 30_001):
                history.keep(session_of(STUDENT, number), [memory_of(number)], {f"lesson-{number}": "beginner"})
            print(f"  log beside the report {log_bytes / 2**20:.1f} MiB, after it {log.stat().st_size / 2**20:.1f} MiB")
    return history


def read(report: DatabaseConnection) -> tuple[int, int]:
    """What a report reads: so many sessions, so many judgements."""
    rows = sessions_of(report, student_key(STUDENT), SessionState.KEPT, None, None)
    return len(rows), sum(len(judgements_of(report, row.id)) for row in rows)


def copied(source: History, url: str, what: str) -> None:
    """Copy a history and tell how long that took."""
    target = History(Database(url))
    begun = time.perf_counter()
    told = copy_history(source, target)
    took_s = time.perf_counter() - begun
    print(f"{what}: {told.added} sessions in {took_s:.1f} s; not whole: {faults_in(target, STUDENT)[:2]}")
    target.database.close()


def main() -> None:
    """Run both and tell."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sessions", type=int, default=150)
    sessions = parser.parse_args().sessions
    with tempfile.TemporaryDirectory() as name, postgres_server() as server:
        folder = Path(name)
        print("SQLite")
        file = side_by_side(sqlite_url(folder / "history.sqlite3"), sessions)
        print("PostgreSQL")
        served = side_by_side(server.new_database(), sessions)
        copied(file, sqlite_url(folder / "copy.sqlite3"), "SQLite to SQLite")
        copied(file, server.new_database(), "SQLite to PostgreSQL")
        copied(served, sqlite_url(folder / "back.sqlite3"), "PostgreSQL to SQLite")
        served.database.close()


if __name__ == "__main__":
    main()
