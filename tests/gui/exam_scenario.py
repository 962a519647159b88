"""An exam in the window: the rubric is read, an unseen piece looked at and played once, the marks stand beside it."""

from collections.abc import Callable

from imgui_bundle import imgui

from station.app.exam_page import ExamStage
from station.app.room_state import Stage
from station.app.window_state import State
from station.drills.exam.exam_piece import Unseen, reading_piece
from station.gui.panels.exam_notes import NOTES, READY_LABEL
from station.gui.panels.exam_panel import EXAM, LEVEL_LABEL, LOOK_LABEL, NEXT_LABEL, SEED_LABEL
from station.practice.exam.exam_take import exam_plan
from tests.gui.drive import Drive, open_panel

UNSEEN = Unseen(2, 11)
Look = Callable[[str], None]
"""Looks at the window, in which one is there."""


def exam(drive: Drive, ctx: imgui.test_engine.TestContext, look: Look = lambda _: None) -> None:
    """From the rubric to the marks, with a virtual student who reads well; `look` is told where one is."""
    seen = drive.seen
    open_panel(ctx, EXAM)
    drive.wait_until(ctx, lambda state: state.exam.piece is not None)
    ctx.set_ref(f"//{EXAM}")
    ctx.item_input_value(f"**/{LEVEL_LABEL}", UNSEEN.level)
    ctx.item_input_value(f"**/{SEED_LABEL}", UNSEEN.seed)
    drive.wait_until(ctx, lambda state: state.exam.unseen == UNSEEN)
    ctx.yield_(3)
    seen["rubric"] = ctx.item_exists(f"**/{LOOK_LABEL}")
    seen["unread of the rubric"] = drive.unread(ctx)
    look("asked")
    ctx.item_click(f"**/{LOOK_LABEL}")
    drive.wait_until(ctx, lambda state: state.exam.stage is ExamStage.LOOKING)
    ctx.yield_(20)
    seen["left_s"] = drive.state.exam.left_s
    seen["unread of the notes"] = drive.unread(ctx)
    seen["whole piece"] = _scrolls(f"{NOTES}") == 0.0
    look("looked at")
    drive.engine.plan = exam_plan(reading_piece(UNSEEN), drive.state.settings)
    ctx.set_ref(f"//{NOTES}")
    ctx.item_click(f"**/{READY_LABEL}")
    drive.wait_for(ctx, Stage.PLAYING)
    ctx.yield_(120)
    seen["notes while playing"] = drive.state.exam.shows_notes
    seen["told while playing"] = [drive.picture.hud.judged, drive.picture.double is None]
    look("played")
    drive.wait_for(ctx, Stage.RESULT)
    drive.wait_until(ctx, _is_marked)
    ctx.yield_(3)
    seen["question"] = drive.room.question
    marks = drive.state.exam.marks
    assert marks is not None
    seen["band"], seen["total"] = marks.band.name, marks.total
    seen["unread of the marks"] = drive.unread(ctx)
    seen["again"] = drive.state.choice is not None
    look("marked")
    ctx.set_ref(f"//{EXAM}")
    ctx.item_click(f"**/{NEXT_LABEL}")
    ctx.yield_(5)
    look("after")
    drive.wait_for(ctx, Stage.IDLE)
    seen["after"] = drive.state.exam.stage.name
    seen["lesson"] = drive.state.player.lesson.name


def _is_marked(state: State) -> bool:
    return state.exam.marks is not None


def _scrolls(panel: str) -> float:
    """How far the page in a panel can be scrolled."""
    children = [w for w in imgui.get_current_context().windows if w.name.startswith(f"{panel}/##exam-page")]
    assert children, "the page is drawn"
    return float(max(w.scroll_max.y for w in children))
