"""The history as a student has it: empty at first, then a calendar, a list, trends and weeks, and a session opened."""

import shutil
from collections.abc import Callable
from dataclasses import replace
from datetime import date, datetime, timedelta
from pathlib import Path

from imgui_bundle import imgui

from station.app.actions.history_actions import HistorySection, ReadAgain
from station.app.actions.practice_actions import Dismiss
from station.app.actions.settings_actions import SetView
from station.app.room_state import Stage
from station.drills.library import find_lesson
from station.gui.panels.history.history_panel import AGAIN_LABEL, HISTORY
from station.gui.panels.history.sessions_part import ALL_LABEL, SEARCH_LABEL, session_label
from station.gui.panels.history.weeks_part import PART_LABELS
from station.practice.headless.virtual_session import practise_virtually
from station.practice.history.session_intake import take_in
from station.practice.history.student_history import StudentHistory
from station.practice.records.report.session_report import practice_document
from station.practice.records.save_session import SessionFolder
from station.practice.session.plan import PlanOptions, plan_practice
from station.simulation.student_spec import parse_spec
from station.store.database_url import sqlite_url
from station.store.opening import history_of
from station.store.rows import Part
from tests.fakes.made_history import made_sessions
from tests.gui.drive import Drive, open_panel

MADE = 120
OLD = datetime.combine(date.today() - timedelta(days=400), datetime.min.time())


def history(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """Everything in one window."""
    seen, sessions = drive.seen, drive.state.settings.sessions_dir
    store = drive.station.parts.store

    def unread(name: str) -> None:
        drive.wait_until(ctx, lambda state: not state.history.reads)
        seen[f"unread {name}"] = drive.unread(ctx)

    store.update(lambda settings: replace(settings, history="postgresql://nobody@127.0.0.1:1/none"))
    open_panel(ctx, HISTORY)
    drive.wait_until(ctx, lambda state: bool(state.history.fault))
    unread("unreachable")
    store.update(lambda settings: replace(settings, history=sqlite_url(sessions / "of-the-test.sqlite3")))
    ctx.set_ref(f"//{HISTORY}")
    ctx.item_click(f"**/{AGAIN_LABEL}")
    drive.wait_until(ctx, lambda state: state.history.pages is not None and not state.history.fault)
    unread("empty")
    number = _kept(drive, sessions)
    drive.station.dispatch(ReadAgain())
    drive.wait_until(ctx, lambda state: bool(state.history.pages and state.history.pages.sessions))
    unread("calendar")
    ctx.item_click(f"**/{date.today().day}##{date.today()}")
    ctx.yield_(2)
    part = drive.window.pages.history.sessions
    seen["day"] = [str(part.only.day) == str(date.today()), drive.window.pages.history.section.value]
    unread("day")
    ctx.item_click(f"**/{ALL_LABEL}")
    ctx.item_input_value(f"**/{SEARCH_LABEL}", f"rock {OLD:%Y}")
    ctx.yield_(2)
    seen["found"] = part.shown
    unread("sessions")
    _open_and_leave(drive, ctx, number)
    for section in (HistorySection.TRENDS, HistorySection.WEEKS):
        drive.window.pages.history.section = section
        ctx.yield_(2)
        unread(section.value)
    ctx.item_click(f"**/{PART_LABELS[Part.PIECE]}")
    ctx.yield_(2)
    unread("pieces")
    _in_large_letters(drive, ctx, unread)
    weeks = None if drive.state.history.pages is None else drive.state.history.pages.weeks
    seen["pieces"] = None if weeks is None else [weeks.part.value, len(weeks.rows)]


def _open_and_leave(drive: Drive, ctx: imgui.test_engine.TestContext, number: int) -> None:
    """Open a session and go back to the list, whose rows stay where they were."""
    seen = drive.seen
    row = f"**/{OLD.day} {OLD:%b} {OLD:%Y}{session_label(number)}"
    lies = ctx.item_info(row).rect_full.min.y
    ctx.item_click(row)
    seen["opening"] = drive.state.history.opening == number
    drive.wait_for(ctx, Stage.RESULT)
    ctx.yield_(3)
    state = drive.state
    seen["opened"] = [state.room.student, None if state.report is None else state.report.document["score"]]
    drive.wait_until(ctx, lambda state: not state.history.reads)
    seen["unread opened"] = drive.unread(ctx)
    drive.station.dispatch(Dismiss())
    drive.wait_for(ctx, Stage.IDLE)
    ctx.yield_(2)
    seen["moved"] = ctx.item_info(row).rect_full.min.y - lies


def _in_large_letters(drive: Drive, ctx: imgui.test_engine.TestContext, unread: Callable[[str], None]) -> None:
    drive.station.dispatch(SetView(replace(drive.state.view_settings, scale=2.0)))
    for section in HistorySection:
        drive.window.pages.history.section = section
        ctx.yield_(3)
        unread(f"{section.value}, large letters")


def _kept(drive: Drive, sessions: Path) -> int:
    """Years of practice, and far back a session that was really played, whose folder is gone; its id."""
    settings = drive.station.parts.store.now
    kept = history_of(settings)
    for made in made_sessions(MADE, date.today(), settings.student):
        kept.keep(made)
    folder = sessions / settings.student / f"{OLD:%Y-%m-%dT%H-%M-%S}_rock-1"
    folder.mkdir(parents=True)
    plan = plan_practice(find_lesson("rock-1"), PlanOptions(loops=2))
    played = practise_virtually(plan, parse_spec("seed=4,miss_pct=5"), folder / "session.capture")
    document = practice_document(played.result, settings)
    SessionFolder(folder, StudentHistory.of(settings), is_new=False).write(played.result, document)
    number = take_in(kept, settings.student, folder)
    assert number is not None
    drive.seen["score"] = document["score"]
    shutil.rmtree(folder)
    return number
