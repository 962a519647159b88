"""Who is known here, by names that are written in one way or another; statements on one connection."""

from datetime import datetime

from sqlalchemy import Connection, delete, func, select

from station.store.rows import SessionState, StudentRow
from station.store.student_names import student_key
from station.store.tables import CAPTURES, SESSIONS, STUDENTS
from station.store.turns import alone, in_turn
from station.store.upserts import put_if_new


def student_id(connection: Connection, name: str) -> int:
    """The id of the student of that name, who is known from now on; nobody else writes for them meanwhile."""
    key = student_key(name)
    in_turn(connection, key)
    wanted = select(STUDENTS.c.id).where(STUDENTS.c.key == key)
    found = connection.execute(wanted).scalar()
    if found is None:
        put_if_new(connection, STUDENTS, [{"key": key, "name": name}], ["key"])
        found = connection.execute(wanted).scalar_one()
    return int(found)


def students_known(connection: Connection) -> list[StudentRow]:
    """Everyone, who played last first, and who never did last of all."""
    played = func.max(SESSIONS.c.started)
    kept = (SESSIONS.c.student_id == STUDENTS.c.id) & (SESSIONS.c.state == SessionState.KEPT.value)
    wanted = select(STUDENTS.c.name, played.label("last")).outerjoin(SESSIONS, kept).group_by(STUDENTS.c.id)
    rows = [StudentRow(each.name, each.last) for each in connection.execute(wanted)]
    rows.sort(key=lambda row: row.name)
    return sorted(rows, key=lambda row: (row.last is not None, row.last or datetime.min), reverse=True)


def delete_student(connection: Connection, name: str) -> bool:
    """Forget a student and all that is theirs; whether there was anything.

    A capture that another student's session has, too, stays for that one.
    """
    alone(connection)  # or another could keep a session by a capture that goes
    gone = connection.execute(delete(STUDENTS).where(STUDENTS.c.key == student_key(name)))
    used = select(SESSIONS.c.capture_sha256).where(SESSIONS.c.capture_sha256.is_not(None))
    connection.execute(delete(CAPTURES).where(CAPTURES.c.sha256.not_in(used)))
    return gone.rowcount > 0
