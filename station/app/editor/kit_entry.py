"""What the kit writes into a draft: step by step at the cursor, or played over the click and recorded."""

from station.app.editor.open_draft import OpenDraft
from station.app.editor.read_draft import loop_of
from station.app.editor.step_entry import Step, stroke_written
from station.app.editor.take_recorder import TakeRecorder, TakeSetting, TakeView
from station.app.sessions.session_control import SessionControl
from station.core.errors import BadInput
from station.core.events import Hit
from station.drills.editing.grid_cursor import BarRange, Cursor
from station.drills.editing.take_options import TakeOptions
from station.drills.grid.stroke_settings import Velocities
from station.drills.lesson import Lesson
from station.engine.messages import EngineEvent


class KitEntry:
    """Writes by `options`; `sessions` lend the engine to a recording."""

    def __init__(self, sessions: SessionControl) -> None:
        self._sessions = sessions
        self.options = TakeOptions()
        self._begun: Step | None = None
        self._take: TakeRecorder | None = None
        self._heard: Lesson | None = None

    @property
    def records(self) -> bool:
        """Whether a recording runs."""
        return self._take is not None

    def view(self) -> TakeView | None:
        """The recording that runs."""
        return None if self._take is None else self._take.view()

    # --- step by step ------------------------------------------------------------------------------------------------

    def begin_steps(self) -> None:
        """The next stroke is a step of its own."""
        self._begun = None

    def write(self, draft: OpenDraft, cursor: Cursor, hit: Hit) -> bool:
        """Write a stroke at the cursor, or with those that were struck just before; returns whether it is a new step.

        Raises `BadInput`.
        """
        page = draft.now.page
        if cursor.grid >= len(page.grids) or not page.grids[cursor.grid].frames:
            return False
        is_new = self._begun is None or not self._begun.holds(hit)
        step = Step(hit.at_ns, cursor) if self._begun is None or is_new else self._begun
        draft.change(stroke_written(hit, step.at, page.grids[step.at.grid], _velocities(draft.lesson)))
        self._begun = step
        return is_new

    # --- recorded ----------------------------------------------------------------------------------------------------

    def record(self, draft: OpenDraft, cursor: Cursor, chosen: BarRange | None) -> None:
        """Begin to record over the chosen bars, all of the cursor's grid where none are; raises `StationError`."""
        draft.read_on()
        page = draft.now.page
        grid = page.grids[cursor.grid] if cursor.grid < len(page.grids) else None
        if grid is None or not grid.frames:
            raise BadInput(draft.file.name, "", "there are no bars to record over")
        bars = chosen or BarRange(cursor.grid, 0, grid.bar_count - 1)
        line, lesson = self._sessions.record(), draft.lesson
        setting = TakeSetting(
            grid=page.grids[bars.grid],
            bars=bars,
            loop=loop_of(draft.now, bars),
            count_in_bars=1 if lesson is None else lesson.count_in_bars,
            velocities=_velocities(lesson),
            click=line.click,
            latency=line.latency,
            options=self.options,
        )
        self._heard, self._take = lesson, TakeRecorder(setting, line.send)

    def handle(self, event: EngineEvent) -> None:
        """Take one event of the engine."""
        if self._take is not None:
            self._take.handle(event)

    def advance(self, draft: OpenDraft, now_ns: int) -> bool:
        """Move on: passes that were recorded are written, and heard in those to come; returns whether all is recorded.

        Raises `StationError` for a pass that cannot be written.
        """
        if self._take is None:
            return False
        for edit in self._take.advance(now_ns):
            draft.change(edit)
        if draft.now.lesson is not None and draft.now.lesson is not self._heard:
            self._heard = draft.now.lesson
            self._take.hear(loop_of(draft.now, self._take.bars))
        return self._take.is_over

    def end(self, draft: OpenDraft) -> None:
        """End the recording that runs: what was played of its last pass is written too."""
        take, self._take = self._take, None
        if take is not None:
            for edit in take.stop():
                draft.change(edit)

    def died(self) -> None:
        """The engine has ended, and a recording with it."""
        self._take = None


def _velocities(lesson: Lesson | None) -> Velocities:
    return Velocities() if lesson is None else lesson.velocities
