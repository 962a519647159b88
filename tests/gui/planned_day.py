"""The page Today as a student has it: the next block begins and ends, one is left out, a line is kept."""

import json
from datetime import date, timedelta

from imgui_bundle import imgui

from station.app.room_state import Stage
from station.app.window_state import State
from station.core.settings import Settings
from station.gui.panels.practice_panel import PRACTICE
from station.gui.panels.today_panel import LEAVE_OUT_LABEL, START_LABEL, TODAY
from station.practice.book.book_day import BookDay, BookFolder
from station.practice.own_data.catching_up import catch_up
from tests.gui.drive import Drive, open_panel


def planned_day(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """Everything in one window, after three days of practice."""
    seen, sessions = drive.seen, drive.state.settings.sessions_dir
    practised(drive.state.settings)
    open_panel(ctx, TODAY)
    drive.wait_until(ctx, lambda state: state.today.today is not None)
    ctx.yield_(5)
    plan = _plan(drive.state)
    seen["kinds"] = [item.kind.value for item in plan.items]
    seen["minutes"] = sum(item.minutes for item in plan.items)
    seen["unread"] = drive.unread(ctx)
    ctx.set_ref(f"//{TODAY}")
    ctx.item_click(f"**/{START_LABEL}")
    drive.wait_for(ctx, Stage.PLAYING)
    laid = drive.station.parts.sessions.practice.session.plan
    seen["planned"] = [plan.items[0].lesson, plan.items[0].beats_a_minute, plan.items[0].rise]
    seen["begun"] = [laid.lesson.name, round(laid.beats_a_minute, 3), str(laid.rise)]
    seen["unread while playing"] = drive.unread(ctx)
    ctx.yield_(60)
    ctx.set_ref("//Transport")
    ctx.item_click("Stop##stop")
    drive.wait_for(ctx, Stage.RESULT)
    drive.wait_until(ctx, lambda state: bool(state.today.today and state.today.today.sessions))
    ctx.yield_(3)
    seen["practised"] = [one.lesson for one in drive.state.today.today.sessions] if drive.state.today.today else []
    following = _next(drive.state)
    ctx.set_ref(f"//{TODAY}")
    ctx.item_click(f"**/{LEAVE_OUT_LABEL}")
    drive.wait_until(ctx, lambda state: _next(state) != following)
    seen["left out"] = _plan(drive.state).left_out == (following,)
    ctx.item_input_value("**/##line", "The left hand is late")
    drive.wait_until(ctx, lambda state: bool(state.today.today and state.today.today.kept.line))
    ctx.item_click(f"**/{(date.today() - timedelta(days=1)).day}##{date.today() - timedelta(days=1)}")
    drive.wait_until(ctx, lambda state: state.today.looked_at is not None)
    ctx.yield_(3)
    seen["unread of the book"] = drive.unread(ctx)
    kept, _ = BookFolder.of(sessions, "student").recall(date.today())
    seen["line"] = kept.line
    open_panel(ctx, PRACTICE)
    seen["unread of practice"] = drive.unread(ctx)


def practised(settings: Settings) -> None:
    """Three days of a student's book, and what was played on them."""
    sessions = settings.sessions_dir
    folder = BookFolder.of(sessions, "student")
    for ago, minutes in ((1, 18.0), (2, 9.0), (4, 21.0)):
        day = date.today() - timedelta(days=ago)
        folder.keep(BookDay(day, line="The kick came late all day." if ago < 3 else ""))
        report = {"score": 86.0, "session": {"lesson": "rock-1", "title": "Rock 1: eighths, backbeat, one and three"}}
        report["session"] |= {"complete": True, "beats_a_minute": 80, "played_s": 60 * minutes}  # type: ignore[operator]
        path = sessions / "student" / f"{day.isoformat()}T17-00-00_rock-1"
        path.mkdir(parents=True)
        (path / "report.json").write_text(json.dumps(report))
        if ago == 1:
            exam = {"schema": "drum-station/exam/1", "marks": {"total": 82.4, "band": "merit"}}
            (path / "exam.json").write_text(json.dumps(exam))
    catch_up(settings, list[str]().append)


def _plan(state: State) -> BookDay:
    assert state.today.today is not None
    return state.today.today.kept


def _next(state: State) -> int | None:
    following = None if state.today.today is None else state.today.today.progress.next
    return None if following is None else following.place
