"""Which bar is heard and seen, and whose: the teacher's, the student's in one pass, or that of an earlier session.

One row for every panel that shows it: they share the bar and the pass.
"""

from collections.abc import Callable

from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.practice_actions import HearBar, Listen
from station.app.room_state import ShownResult
from station.gui import theme
from station.gui.widgets.flow_row import FlowRow
from station.practice.demonstration.compare_by_ear import Whose
from station.practice.records.previous_session import PreviousSession
from station.scenes.hit_table import EveryHit

TEACHER_LABEL, STUDENT_LABEL, STOP_LABEL = "Teacher##playback", "You##playback", "Stop##playback"
THEN_LABEL = "You then##playback"
"""Of a session of another day."""
PREVIOUS_LABEL = "###previous"
"""What stands before it is the day."""
_WIDE = 90.0


class PlaybackRow:
    """The controls; `bar` and `pass_number`, from 1, are chosen to be heard, `is_listening` while one of them is."""

    def __init__(self, dispatch: Callable[[Action], None]) -> None:
        self._dispatch = dispatch
        self.is_listening = False
        self._shown: EveryHit | None = None
        self.bar = self.pass_number = 1

    def gui(self, report: ShownResult, row: FlowRow) -> None:
        """Draw them into `row` and do what the user does."""
        hits = report.hits
        if hits is not self._shown:
            self._shown = hits
            self.bar, self.pass_number = hits.bars[0], 1
        first, last = hits.bars
        passes = int(hits.dots["pass"].max())
        self.bar = _slider("bar", self.bar, (first, last), row)
        theme.tooltip("The bar to hear and see; a click on a dot of Every hit chooses its bar and pass")
        self.pass_number = _slider("pass", self.pass_number, (1, passes), row)
        theme.tooltip("Which pass of yours")
        here = hits.dots[(hits.dots["bar"] == self.bar) & (hits.dots["pass"] == self.pass_number)]
        imgui.begin_disabled(not len(here))
        row_bar = int(here["row_bar"][0]) if len(here) else 0
        self._button(TEACHER_LABEL, Whose.TEACHER, row_bar, row)
        theme.tooltip("The bar as the teacher plays it, with the click")
        self._students(report, row_bar, row)
        if not report.student:
            self._previous(report.before, row_bar, row)
        imgui.end_disabled()
        if self.is_listening:
            row.place(theme.points(70))
            if imgui.button(STOP_LABEL, imgui.ImVec2(theme.points(70), 0)):
                self._dispatch(Listen())
            theme.tooltip("Enough")

    def show(self, report: ShownResult, bar: int, pass_number: int) -> None:
        """Choose a bar and a pass, and hear and see what the student played there."""
        self._shown, self.bar, self.pass_number = report.hits, bar, pass_number
        here = report.hits.dots[(report.hits.dots["bar"] == bar) & (report.hits.dots["pass"] == pass_number)]
        if len(here):
            self._dispatch(HearBar(int(here["row_bar"][0]), Whose.STUDENT))

    def _students(self, report: ShownResult, row_bar: int, row: FlowRow) -> None:
        student, day = report.student, report.day
        if day is not None:
            self._button(THEN_LABEL, Whose.STUDENT, row_bar, row)
            when = f"{day.day} {day:%B %Y}"
            theme.tooltip(
                f"This pass over the bar as you played it on {when}, with the click; translucent sticks are yours"
            )
            return
        if not student:
            self._button(STUDENT_LABEL, Whose.STUDENT, row_bar, row)
            theme.tooltip("The bar as you played it in this pass, with the click; translucent sticks are yours")
            return
        short = theme.one_line(student, theme.points(_WIDE) - 2 * imgui.get_style().frame_padding.x)
        self._button(f"{short}##played", Whose.STUDENT, row_bar, row)
        theme.tooltip(f"This pass over the bar as {student} played it, with the click; translucent sticks are theirs")

    def _previous(self, before: PreviousSession | str, row_bar: int, row: FlowRow) -> None:
        if isinstance(before, str):
            imgui.begin_disabled()
            self._button(f"Yesterday{PREVIOUS_LABEL}", Whose.PREVIOUS, row_bar, row)
            imgui.end_disabled()
            theme.tooltip(f"{before[0].upper()}{before[1:]}.")
            return
        day = f"{before.day[0].upper()}{before.day[1:]}"
        imgui.begin_disabled(not before.has_bar(self.bar))
        self._button(f"{day}{PREVIOUS_LABEL}", Whose.PREVIOUS, row_bar, row)
        imgui.end_disabled()
        when = f"{day} at {before.when:%H:%M}"
        said = "your last pass over the bar, as translucent sticks" if before.has_bar(self.bar) else "not this bar"
        theme.tooltip(f"{when}: {said}")

    def _button(self, label: str, whose: Whose, row_bar: int, row: FlowRow) -> None:
        row.place(theme.points(_WIDE))
        if imgui.button(label, imgui.ImVec2(theme.points(_WIDE), 0)):
            self._dispatch(HearBar(row_bar, whose))


def _slider(label: str, value: int, ends: tuple[int, int], row: FlowRow) -> int:
    row.place(theme.points(_WIDE))
    imgui.set_next_item_width(theme.points(_WIDE))
    return theme.slider_int(f"##playback-{label}", value, *ends, f"{label} %d")[1]
