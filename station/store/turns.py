"""Whose turn it is to write: a SQLite file has one writer at a time anyway, PostgreSQL has one for each student.

So two stations that keep the same student's sessions never run into each other's rows, and a class is kept side by
side. Turns are held until the transaction ends; who waits longer than `PATIENCE_S` is refused by the server.
"""

import zlib

from sqlalchemy import Connection, text

from station.store.database import is_postgres

_OURS = 7312
"""Of all advisory locks of a database, the history's (our choice)."""


def alone(connection: Connection) -> None:
    """Nobody else writes: the tables themselves change, or what several students share."""
    if is_postgres(connection):
        connection.execute(text("SELECT pg_advisory_xact_lock(:ours)"), {"ours": _OURS})


def in_turn(connection: Connection, student_key: str) -> None:
    """Nobody else writes what is that student's. Who writes for several takes them in the order of their keys."""
    if is_postgres(connection):
        statement = text("SELECT pg_advisory_xact_lock_shared(:ours), pg_advisory_xact_lock(:ours, :student)")
        number = zlib.crc32(student_key.encode(errors="replace")) - 2**31
        connection.execute(statement, {"ours": _OURS, "student": number})
