"""A take of a student, opened: a bar to hear, what the teacher judges otherwise, and the note on the return."""

from collections.abc import Callable
from dataclasses import replace

from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.teacher_actions import OpenTake, Overrule, SayToStudent, WriteNote
from station.app.teacher_desk.open_take import OpenedTake
from station.app.teacher_desk.parcel_out import proposed_path
from station.app.teacher_desk.returns_desk import LessonRow
from station.app.teacher_desk.stroke_lines import StrokeLine
from station.app.teacher_desk.teacher_page import Answer, TeacherView
from station.app.window_state import State
from station.core.disk.file_names import folder_name
from station.gui import theme
from station.gui.panels.playback_row import PlaybackRow
from station.gui.panels.teacher.save_row import SaveRow
from station.gui.widgets.flow_row import FlowRow
from station.practice.exchange.note_file import MOST_STROKES, SessionVerdict, StrokeVerdict
from station.practice.exchange.parcel import Kind
from station.practice.exchange.plain_words import LONGEST_WORDS

WORDS_LABEL, NEXT_LABEL, ABOUT_LABEL = "##note-words", "##note-next", "##take-words"
NAME_LABEL, SCORE_LABEL, WRITE_LABEL = "##note-teacher", "My score##take", "Write the note##note"
SHOW_LABEL = "Show it again##take"
REACHED_LABELS = {None: "as judged##reached", True: "reached##reached", False: "not yet##reached"}
_LINES = 3
_SCORE_AT_FIRST = 80.0


class TakePart:
    """Keeps what is typed; what the teacher does goes to `dispatch`."""

    def __init__(self, dispatch: Callable[[Action], None], playback: PlaybackRow) -> None:
        self._dispatch, self._playback = dispatch, playback
        self._stem = ""
        self.words = self.next = self.about = self.name = ""
        self._about_of: object = None
        self.save = SaveRow("Where the note is written", Kind.NOTE, WRITE_LABEL)

    def poll(self) -> None:
        """Take what the system's dialog has brought."""
        self.save.poll()

    def gui(self, state: State, view: TeacherView) -> None:
        """Draw the take that is opened, and the note on its return."""
        assert view.key is not None, "it is opened"
        assert view.opened is not None, "it is opened"
        (stem, number), opened = view.key, view.opened
        row = next((each for each in view.rows if (stem, number) in [one.key for one in each.sessions]), None)
        if row is None:
            theme.soft("This return is no longer there.")
            return
        answer = view.answers.get(stem, Answer())
        self._meet(stem, number, row, answer, state)
        self._head(row, number, opened)
        report = opened.saved.report
        if state.shows_result and state.report is report:
            self._playback.is_listening = state.room.listening
            if len(report.hits.dots):
                self._playback.gui(report, FlowRow())
        elif imgui.button(SHOW_LABEL):
            self._dispatch(OpenTake(stem, number))
        before = answer.verdicts.get(number, SessionVerdict(number, row.lesson))
        verdict = self._verdict(before, opened)
        if verdict != before:
            self._dispatch(Overrule(stem, verdict))
        self._note(stem, row, answer, view)

    def _meet(self, stem: str, number: int, row: LessonRow, answer: Answer, state: State) -> None:
        if stem != self._stem:
            self._stem, self.words, self.next = stem, answer.words, answer.next
            name = f"{folder_name(row.student)}-{folder_name(row.title)}"
            self.save.propose(proposed_path(name, Kind.NOTE))
            self.name = self.name or state.settings.student
        if self._about_of != (stem, number):
            self._about_of = stem, number
            verdict = answer.verdicts.get(number)
            self.about = "" if verdict is None else verdict.words

    def _head(self, row: LessonRow, number: int, opened: OpenedTake) -> None:
        theme.heading(f"{row.student}: {row.lesson}", 20)
        session = next(one for one in row.sessions if one.key[1] == number)
        figures = opened.heard.figures
        score = "no score" if figures.score is None else f"score {figures.score:.0f}"
        theme.soft(
            f"{session.told.played:%d %B, %H:%M} · {figures.beats_a_minute:g} bpm · {score} ·"
            f" {figures.right} of {figures.notes} right, judged as {figures.level}"
        )
        for line in opened.heard.differences:
            theme.warning(line)
        if not opened.heard.differences:
            theme.soft("Their report is what the capture gives.")

    # --- what is judged otherwise ------------------------------------------------------------------------------------

    def _verdict(self, verdict: SessionVerdict, opened: OpenedTake) -> SessionVerdict:
        theme.part("What you judge otherwise")
        imgui.text("Goals")
        row = FlowRow()
        for reached, label in REACHED_LABELS.items():
            row.place(imgui.calc_text_size(label, True).x + theme.points(36))
            if imgui.radio_button(label, verdict.reached is reached):
                verdict = replace(verdict, reached=reached)
        verdict = self._score(verdict, opened.heard.figures.score)
        verdict = self._strokes(verdict, opened)
        imgui.set_next_item_width(-1)
        _, self.about = imgui.input_text_with_hint(ABOUT_LABEL, "a line about this take", self.about)
        if imgui.is_item_deactivated_after_edit():
            verdict = replace(verdict, words=self.about[:LONGEST_WORDS])
        return verdict

    def _score(self, verdict: SessionVerdict, heard: float | None) -> SessionVerdict:
        is_changed, mine = theme.checkbox(SCORE_LABEL, verdict.score is not None)
        if is_changed:
            first = round(_SCORE_AT_FIRST if heard is None else heard)
            verdict = replace(verdict, score=float(first) if mine else None)
        if verdict.score is not None:
            imgui.set_next_item_width(-1)
            _, score = theme.slider_int("##take-score", round(verdict.score), 0, 100, "score %d")
            verdict = verdict if score == round(verdict.score) else replace(verdict, score=float(score))
        return verdict

    def _strokes(self, verdict: SessionVerdict, opened: OpenedTake) -> SessionVerdict:
        """The strokes of the bar and the pass that are chosen to be heard: a tick is a stroke that counts."""
        bar, pass_number = self._playback.bar, self._playback.pass_number
        here = [one for one in opened.strokes if (one.bar, one.pass_number) == (bar, pass_number)]
        imgui.text_wrapped(f"Strokes of bar {bar}, pass {pass_number}: a tick counts")
        for stroke in sorted(here, key=lambda one: one.words):
            before = overruled(verdict, stroke)
            counts = stroke.is_right if before is None else before
            changed, ticked = imgui.checkbox(stroke_label(stroke, before is not None), counts)
            if changed:
                verdict = with_stroke(verdict, stroke, bool(ticked))
        return verdict

    # --- the note ----------------------------------------------------------------------------------------------------

    def _note(self, stem: str, row: LessonRow, answer: Answer, view: TeacherView) -> None:
        theme.part(f"The note to {row.student}")
        width, line = imgui.get_content_region_avail().x, imgui.get_text_line_height()
        size = imgui.ImVec2(width, _LINES * line + 2 * imgui.get_style().frame_padding.y)
        _, self.words = imgui.input_text_multiline(WORDS_LABEL, self.words, size, imgui.InputTextFlags_.word_wrap)
        is_said = imgui.is_item_deactivated_after_edit()
        theme.tooltip("What you say to the whole return")
        imgui.set_next_item_width(-1)
        _, self.next = imgui.input_text_with_hint(NEXT_LABEL, "what to do next", self.next)
        is_said |= imgui.is_item_deactivated_after_edit()
        imgui.set_next_item_width(-1)
        _, self.name = imgui.input_text_with_hint(NAME_LABEL, "your name", self.name)
        theme.tooltip("Your name, as the student reads it")
        if is_said:
            self._say(stem)
        if self.save.gui():
            self._say(stem)
            self._dispatch(WriteNote(stem, self.save.path, self.name))
        if view.told:
            imgui.text_wrapped(view.told)
        elif answer.verdicts and not answer.is_written:
            theme.soft("Not written yet.")

    def _say(self, stem: str) -> None:
        self._dispatch(SayToStudent(stem, self.words[:LONGEST_WORDS], self.next[:LONGEST_WORDS]))


def stroke_label(stroke: StrokeLine, is_overruled: bool) -> str:
    """What stands beside a stroke's tick."""
    which = f"note{stroke.note}" if stroke.note is not None else f"hit{stroke.hit}"
    return f"{stroke.words}{' (yours)' if is_overruled else ''}##{which}"


def overruled(verdict: SessionVerdict, stroke: StrokeLine) -> bool | None:
    """Whether the teacher lets a stroke count; None where they leave it as it was judged."""
    found = (one.counts for one in verdict.strokes if (one.note, one.hit) == (stroke.note, stroke.hit))
    return next(found, None)


def with_stroke(verdict: SessionVerdict, stroke: StrokeLine, counts: bool) -> SessionVerdict:
    """The verdict with that stroke judged so; as it was judged anyway, it is no longer in it."""
    others = tuple(one for one in verdict.strokes if (one.note, one.hit) != (stroke.note, stroke.hit))
    if counts == stroke.is_right or len(others) >= MOST_STROKES:
        return replace(verdict, strokes=others)
    return replace(verdict, strokes=(*others, StrokeVerdict(counts, stroke.note, stroke.hit)))
