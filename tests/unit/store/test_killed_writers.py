"""Who keeps sessions may be killed at any moment: what was kept is kept whole, and nothing is kept by half."""

import random
import sqlite3
from contextlib import closing, suppress
from multiprocessing.connection import Connection

from station.store.database import Database
from station.store.history import History
from tests.fakes.history_children import history_children, keep_in_a_loop
from tests.fakes.whole_sessions import faults_in

_KILLS = 8
_MOST = 1_000


def _what_is_left(pipe: Connection) -> list[int]:
    """What a child that is gone has still told."""
    left = []
    with pipe, suppress(EOFError):
        while True:
            left.append(pipe.recv())
    return left


def test_nothing_that_was_kept_is_lost_by_a_kill(url: str) -> None:
    chance = random.Random(7)
    children = history_children()
    told: list[int] = []
    for _ in range(_KILLS):
        ours, theirs = children.Pipe(duplex=False)
        first = told[-1] + 2 if told else 1  # the one that was being kept may be there, or not
        child = children.Process(target=keep_in_a_loop, args=(url, "Ann", first, _MOST, theirs))
        child.start()
        theirs.close()
        told += [ours.recv() for _ in range(chance.randint(1, 3))]
        ours.poll(chance.random() * 0.02)  # into the middle of the next one
        child.kill()
        child.join()
        told += _what_is_left(ours)
    history = History(Database(url))
    assert {f"session-{number}" for number in told} <= history.session_names("Ann")
    assert len(history.session_names("Ann")) <= len(told) + _KILLS
    assert faults_in(history, "Ann") == []
    if history.database.path is not None:
        with closing(sqlite3.connect(history.database.path)) as file:
            assert file.execute("PRAGMA integrity_check").fetchall() == [("ok",)]
    history.database.close()
