"""What other programs do with a history, in processes of their own."""

from datetime import datetime, timedelta
from multiprocessing import get_context
from multiprocessing.connection import Connection
from multiprocessing.context import ForkServerContext
from multiprocessing.queues import SimpleQueue
from multiprocessing.synchronize import Barrier

from station.core.errors import StationError
from station.store.database import Database
from station.store.history import History
from station.store.rows import FigureRow, JudgementRow, KeptSession, MasteryRow, Part, SessionRow

_NOTES = 400
"""Of a session of five minutes."""


def history_children() -> ForkServerContext:
    """Where such processes are begun: each is there in some milliseconds, for what they import is loaded once."""
    context = get_context("forkserver")
    context.set_forkserver_preload([__name__, "psycopg", "sqlalchemy.dialects.postgresql.psycopg"])
    return context


def session_of(student: str, number: int, notes: int = _NOTES) -> KeptSession:
    """The session with that number of a student, whole: all that is in it follows from the number."""
    row = SessionRow(
        student,
        f"session-{number}",
        datetime(2026, 1, 1) + timedelta(minutes=number),
        f"/there/session-{number}",
        lesson="rock-1",
        title="Rock",
        score=float(number % 100),
        notes=notes,
    )
    figures = tuple(
        FigureRow(Part.PIECE, piece, notes, number, 0, 0, notes, -number / 7, 12.5)
        for piece in ("snare", "kick", "hihat")
    )
    judgements = tuple(
        JudgementRow(
            "match", 1, n // 8, n / 2, n, n / 4, 38, n, n / 4 + number / 1000, 38, "snare", "head", "normal", 64.0, None
        )
        for n in range(notes)
    )
    documents = {"report.json": f'{{"number": {number}}}'.encode() * 50, "pairs.csv": b"label,pass\n" * notes}
    return KeptSession(row, figures, judgements, documents, f"capture {number} ".encode() * 500)


def memory_of(number: int) -> MasteryRow:
    """What is learnt in it."""
    return MasteryRow(f"lesson-{number}", 0, 3, f'{{"session": {number}}}')


def open_at_once(url: str, number: int, together: Barrier, told: "SimpleQueue[str]") -> None:
    """Open a history at the same moment as others, keep something there, and tell how that went."""
    together.wait(60)
    try:
        database = Database(url)
        History(database).remember(f"student {number}", [memory_of(number)])
        database.close()
    except StationError as fault:
        told.put(str(fault))
    else:
        told.put("kept")


def keep_in_a_loop(url: str, student: str, first: int, most: int, told: Connection) -> None:
    """Keep sessions with what is learnt in them, and tell the number of each after it was kept; at last None."""
    database = Database(url)
    history = History(database)
    for number in range(first, first + most):
        try:
            history.keep(session_of(student, number), [memory_of(number)], {f"lesson-{number}": "beginner"})
        except StationError as fault:
            told.send(str(fault))
            break
        told.send(number)
    told.send(None)
    database.close()
