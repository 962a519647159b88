"""How long the window's pages of the history take with 1,000 sessions, on SQLite and on PostgreSQL: prints a table.

    xvfb-run -s "-screen 0 1920x1080x24 +extension GLX" python benchmarks/history_pages.py [--sessions N] [--rounds N]

Each page is turned to in the window itself, and the time goes until its first frame with what was read has been drawn.
Sessions are made up, with judgements, reports and captures as large as real ones. The picture behind the panels is
drawn by a graphics card elsewhere: here it stands still. PostgreSQL is Debian's, on a socket. "read again" is the page
that the panel opens with: all sessions are read anew. Ends with 1 where a page takes more than `MOST_MS`. A minute.
"""

import argparse
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from datetime import date
from pathlib import Path

from imgui_bundle import imgui

from station.app.actions.history_actions import Asked, HistorySection, ReadAgain, ShowPages
from station.app.window_state import State
from station.gui.panels.history.history_panel import HISTORY
from station.practice.progress.overview import WeekMeasure
from station.store.database_url import sqlite_url
from station.store.opening import history_of
from station.store.rows import Part
from tests.fakes.made_history import LESSONS, made_sessions
from tests.fakes.postgres_server import postgres_server
from tests.gui.drive import Drive, open_panel

MOST_MS = 300.0
JUDGED = 300
"""Judgements of a session: four minutes of eighth notes and some."""
STANDS = 10_000
"""The picture is drawn once."""
AGAIN = "calendar, read again"
PAGES = {
    AGAIN: Asked(),
    "calendar": Asked(),
    "sessions": Asked(HistorySection.SESSIONS),
    "trends": Asked(HistorySection.TRENDS),
    "trends of another lesson": Asked(HistorySection.TRENDS, lesson=LESSONS[3][0]),
    "weeks by limb": Asked(HistorySection.WEEKS),
    "weeks by piece, of a lesson": Asked(
        HistorySection.WEEKS, part=Part.PIECE, measure=WeekMeasure.HIT, lesson_of_weeks=LESSONS[0][0]
    ),
}
Taken = dict[str, list[float]]


def main() -> int:
    """Prints the table; returns whether a page was too slow."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sessions", type=int, default=1000)
    parser.add_argument("--rounds", type=int, default=20)
    parser.add_argument("--database", choices=("SQLite", "PostgreSQL"), help="this one alone")
    options = parser.parse_args()
    worst = 0.0
    print(f"{options.sessions} sessions; milliseconds from the click to the first frame with what was read")
    print(f"{'':12}{'page':30}{'median':>8}{'worst':>8}")
    for name in [options.database] if options.database else ["SQLite", "PostgreSQL"]:
        with tempfile.TemporaryDirectory() as folder, _database(name, Path(folder)) as url:
            for page, taken in _measured(url, Path(folder), options.sessions, options.rounds).items():
                print(f"{name:12}{page:30}{sorted(taken)[len(taken) // 2]:8.0f}{max(taken):8.0f}")
                worst = max(worst, *taken)
    return int(worst > MOST_MS)


@contextmanager
def _database(name: str, folder: Path) -> Iterator[str]:
    if name == "SQLite":
        yield sqlite_url(folder / "history.sqlite3")
        return
    with postgres_server() as server:
        yield server.new_database()


def _measured(url: str, folder: Path, sessions: int, rounds: int) -> Taken:
    drive = Drive(folder, None, STANDS, (1280, 720))
    store = drive.station.parts.store
    store.update(lambda settings: replace(settings, history=url))
    history = history_of(store.now)
    for kept in made_sessions(sessions, date.today(), store.now.student, JUDGED):
        history.keep(kept)
    taken: Taken = {page: [] for page in PAGES}

    def scenario(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
        open_panel(ctx, HISTORY)
        drive.station.dispatch(ReadAgain())
        drive.wait_until(ctx, lambda state: bool(state.history.pages and state.history.pages.sessions))
        for _ in range(rounds):
            for page, asked in PAGES.items():
                taken[page].append(_turned_to(drive, ctx, asked, anew=page == AGAIN))

    try:
        drive.run([scenario])
    finally:
        drive.station.close()
        history.database.close()
    assert not [seen["traceback"] for seen in drive.all_seen if "traceback" in seen], drive.all_seen
    return taken


def _turned_to(drive: Drive, ctx: imgui.test_engine.TestContext, asked: Asked, anew: bool) -> float:
    """Milliseconds until a page is drawn with what was read for it."""
    before = time.monotonic()
    drive.window.pages.history.section = asked.section
    drive.station.dispatch(ShowPages(asked))
    if anew:
        drive.station.dispatch(ReadAgain())

    def is_there(state: State) -> bool:
        return state.history.asked == asked and not state.history.reads

    drive.wait_until(ctx, is_there)
    frames = drive.window.frames
    while drive.window.frames == frames:
        ctx.yield_()
    return 1000 * (time.monotonic() - before)


if __name__ == "__main__":
    raise SystemExit(main())
