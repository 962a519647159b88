"""An assignment given, practised, returned, heard, overruled and answered in the window, by files alone."""

from collections.abc import Callable
from datetime import date, timedelta
from pathlib import Path

from imgui_bundle import imgui

from station.app.room_state import Stage
from station.app.window_state import State
from station.drills.library import find_lesson
from station.gui.panels.playback_row import TEACHER_LABEL
from station.gui.panels.teacher.assigned_panel import ASSIGNMENTS, LINE_LABEL, RETURN_LABEL
from station.gui.panels.teacher.give_part import ADD_LABEL, CLASS_LABEL, DUE_LABEL, GIVE_LABEL, TITLE_LABEL
from station.gui.panels.teacher.take_part import (
    NEXT_LABEL,
    REACHED_LABELS,
    WORDS_LABEL,
    WRITE_LABEL,
    stroke_label,
)
from station.gui.panels.teacher.teacher_panel import CHECK_LABEL, GIVE_TAB, LIST_LABEL, RETURNS_TAB, TEACHER
from station.practice.session.plan import PlanOptions, plan_practice
from tests.gui.drive import Drive, open_panel, to_options
from tests.gui.dropped_files import drop_files

TITLE, LESSON = "Week 3", "rock-1"
DUE = date.today() + timedelta(days=8)


def there_and_back(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """Teacher and student share one window here, and nothing but files goes between them."""
    ThereAndBack(drive, ctx, Path()).all()  # short names, for a field shows no more


class ThereAndBack:
    """The steps; files lie in `folder`, `look` is called where a page is worth a look."""

    def __init__(
        self,
        drive: Drive,
        ctx: imgui.test_engine.TestContext,
        folder: Path,
        look: Callable[[str], None] = lambda name: None,
    ) -> None:
        self.drive, self.ctx, self.folder, self.look = drive, ctx, folder, look
        self.seen = drive.seen

    def all(self) -> None:
        """From the teacher to the student and back."""
        for step in (self.gives, self.practises, self.returns, self.listens, self.answers, self.reads):
            step()

    def _press(self, panel: str, label: str) -> None:
        self.ctx.set_ref(f"//{panel}")
        self.ctx.item_click(f"**/{label}")
        self.ctx.yield_(2)

    def _type(self, panel: str, label: str, text: str) -> None:
        self.ctx.set_ref(f"//{panel}")
        self.ctx.item_input_value(f"**/{label}", text)
        self.ctx.yield_(2)

    def _seen_unread(self, name: str) -> None:
        self.seen[f"unread {name}"] = self.drive.unread(self.ctx)
        self.look(name)

    def gives(self) -> None:
        """The teacher puts an assignment together of the lesson that is chosen."""
        ctx = self.ctx
        open_panel(ctx, TEACHER)
        self._press(TEACHER, GIVE_TAB)
        self.ctx.set_ref("//Lessons")
        ctx.item_input_value("##search", find_lesson(LESSON).title.split(":")[0])
        ctx.item_click(f"**/###{LESSON}")
        for label, text in ((TITLE_LABEL, TITLE), (CLASS_LABEL, "Tuesday"), (DUE_LABEL, f"{DUE}")):
            self._type(TEACHER, label, text)
        self._press(TEACHER, ADD_LABEL)
        self._type(TEACHER, f"##path-{GIVE_LABEL}", str(self.folder / "week3"))
        self._seen_unread("giving")
        self._press(TEACHER, GIVE_LABEL)
        self.seen["given"] = (self.folder / "week3.drum-assignment").exists()
        self._press(TEACHER, RETURNS_TAB)

    def practises(self) -> None:
        """The student takes it and plays it once."""
        drive, ctx = self.drive, self.ctx
        drop_files([self.folder / "week3.drum-assignment"])
        drive.wait_until(ctx, lambda state: bool(state.assigned.rows))
        self.seen["due"] = drive.state.assigned.rows[0].due
        lesson = find_lesson(LESSON)
        self._press(ASSIGNMENTS, f"{lesson.title}##{LESSON}")
        to_options(ctx)
        ctx.item_input_value("##passes", 2)
        ctx.set_ref("//Lessons")
        drive.engine.plan = plan_practice(lesson, PlanOptions(lesson.tempo_bpm, 2))
        ctx.item_click("Start##start")
        drive.wait_for(ctx, Stage.RESULT)
        drive.answer(ctx)
        self.seen["score"] = drive.state.report.document["score"] if drive.state.report else None
        ctx.set_ref("//Transport")
        ctx.item_click("Back to the lessons##back")
        ctx.yield_(2)

    def returns(self) -> None:
        """The student sends what they played."""
        drive, ctx = self.drive, self.ctx
        drive.wait_until(ctx, lambda state: state.assigned.rows[0].sessions == 1)
        ctx.yield_(2)
        self._type(ASSIGNMENTS, LINE_LABEL, "bar 2 is hard")
        self._type(ASSIGNMENTS, f"##path-{RETURN_LABEL}", str(self.folder / "zoe.drum-return"))
        self._seen_unread("returning")
        self._press(ASSIGNMENTS, RETURN_LABEL)
        drive.wait_until(ctx, lambda state: "zoe.drum-return" in state.assigned.told)

    def listens(self) -> None:
        """The teacher gets it, checks it, opens the take and hears a bar."""
        drive, ctx = self.drive, self.ctx
        drop_files([self.folder / "zoe.drum-return"])
        drive.wait_until(ctx, lambda state: bool(state.teacher.rows))
        ctx.yield_(5)
        self._press(TEACHER, CHECK_LABEL)
        drive.wait_until(ctx, lambda state: state.teacher.rows[0].sessions[0].is_judged)
        (row,) = drive.state.teacher.rows
        (session,) = row.sessions
        assert session.heard is not None, session.fault
        self.seen["listed"] = [row.shelf, row.student, row.lesson, session.told.figures.score, row.words]
        self.seen["differences"] = list(session.heard.differences)
        self._seen_unread("the list")
        stem, number = session.key
        self._press(TEACHER, f"{session.told.played:%d %b %H:%M}##take-{stem}-{number}")
        drive.wait_until(ctx, _shows_take)
        ctx.yield_(5)
        self.seen["heat"] = bool(drive.state.report and drive.state.report.heat.bars)
        self._seen_unread("a take")
        sent = len(drive.engine.sent)
        self._press(TEACHER, f"{drive.state.room.student}##played")
        self.seen["heard"] = drive.room.listening
        drive.wait_until(ctx, lambda state: state.snapshot is not None and state.snapshot.double is not None)
        self.seen["sounds"] = [type(command).__name__ for command in drive.engine.sent[sent:]]
        self._press(TEACHER, TEACHER_LABEL)
        self.seen["teacher heard"] = drive.room.listening

    def answers(self) -> None:
        """The teacher lets a stroke not count, calls the goals reached, and writes the note."""
        drive = self.drive
        opened = drive.state.teacher.opened
        assert opened is not None
        stroke = next(one for one in opened.strokes if one.note is not None and one.bar == one.pass_number == 1)
        self.seen["stroke"] = [stroke.note, not stroke.is_right]
        self._press(TEACHER, stroke_label(stroke, is_overruled=False))
        self._press(TEACHER, REACHED_LABELS[True])
        self._type(TEACHER, WORDS_LABEL, "Well done.")
        self._type(TEACHER, NEXT_LABEL, "the same at 100")
        self._type(TEACHER, f"##path-{WRITE_LABEL}", str(self.folder / "zoe.drum-note"))
        self._seen_unread("a note")
        self._press(TEACHER, WRITE_LABEL)
        self.seen["told"] = drive.state.teacher.told
        self._press(TEACHER, LIST_LABEL)
        self.seen["answered"] = (self.folder / "zoe.drum-note").exists()

    def reads(self) -> None:
        """The student gets the note and reads it."""
        drive, ctx = self.drive, self.ctx
        ctx.set_ref("//Transport")
        ctx.item_click("Back to the lessons##back")
        drop_files([self.folder / "zoe.drum-note"])
        drive.wait_until(ctx, lambda state: bool(state.assigned.rows and state.assigned.rows[0].notes))
        ctx.yield_(3)
        self.seen["note"] = list(drive.state.assigned.rows[0].notes[0].lines)
        self._seen_unread("the note read")


def _shows_take(state: State) -> bool:
    return state.shows_result and bool(state.room.student)
