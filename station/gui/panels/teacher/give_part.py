"""Making an assignment: lessons that are chosen in the list are added, with what is asked of each and until when."""

from collections.abc import Callable
from dataclasses import dataclass, replace

from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.teacher_actions import Give, NewAssignment
from station.app.teacher_desk.parcel_out import proposed_path
from station.app.window_state import State
from station.core.disk.file_names import folder_name
from station.gui import theme
from station.gui.panels.teacher.save_row import SaveRow
from station.music.tempo import MAX_BPM, MIN_BPM
from station.practice.exchange.lesson_goals import LessonGoals
from station.practice.exchange.parcel import Kind
from station.scoring.matching.hit_windows import OUR_LEVELS

ADD_LABEL, GIVE_LABEL, REMOVE_LABEL = "Add the chosen lesson##give", "Write the assignment##give", "Remove"
TITLE_LABEL, CLASS_LABEL, DUE_LABEL = "##give-title", "##give-class", "##give-due"
TEACHER_LABEL, WORDS_LABEL = "##give-teacher", "##give-words"
_LINES = 3
_MOST_PASSES = 1000
_ANY = "any level"


@dataclass(frozen=True, slots=True)
class GivenLesson:
    """A lesson on the list, and what is asked of it."""

    name: str
    title: str
    goals: LessonGoals


class GivePart:
    """Keeps what is typed; what the teacher does goes to `dispatch`."""

    def __init__(self, dispatch: Callable[[Action], None]) -> None:
        self._dispatch = dispatch
        self.lessons: list[GivenLesson] = []
        self.title = self.group = self.due = self.teacher = self.words = ""
        self._proposed = ""
        self.save = SaveRow("Where the assignment is written", Kind.ASSIGNMENT, GIVE_LABEL)

    def poll(self) -> None:
        """Take what the system's dialog has brought."""
        self.save.poll()

    def gui(self, state: State) -> None:
        """Draw it and do what the teacher does."""
        self._about(state)
        theme.part("Lessons")
        card = state.selection.card
        is_there = card is None or card.name in [one.name for one in self.lessons]
        imgui.begin_disabled(is_there)
        if imgui.button(ADD_LABEL, imgui.ImVec2(-1, 0)) and card is not None:
            goals = LessonGoals(tempo_bpm=float(round(card.beats_a_minute)))
            self.lessons.append(GivenLesson(card.name, card.title, goals))
        imgui.end_disabled()
        theme.tooltip("The lesson that is chosen in the list on the left")
        for index, one in enumerate(self.lessons):
            self._lesson(index, one)
        self.lessons = [one for one in self.lessons if one.name]
        theme.part("The file")
        self._propose()
        imgui.begin_disabled(not self.lessons)
        if self.save.gui():
            lessons = tuple((one.name, one.goals) for one in self.lessons)
            new = NewAssignment(self.title, lessons, self.teacher, self.group, self.due, self.words)
            self._dispatch(Give(new, self.save.path))
        imgui.end_disabled()
        if state.teacher.told:
            imgui.text_wrapped(state.teacher.told)
        self._given(state)

    def _about(self, state: State) -> None:
        self.teacher = self.teacher or state.settings.student
        for label, hint, name, tip in (
            (TITLE_LABEL, "title, such as Week 3", "title", "What the assignment is called"),
            (CLASS_LABEL, "class or student (may stay empty)", "group", "Returns are kept under this name"),
            (TEACHER_LABEL, "your name", "teacher", "Your name, as the student reads it"),
            (DUE_LABEL, "due, such as 2026-12-01", "due", "The last day: year-month-day; empty: whenever"),
        ):
            imgui.set_next_item_width(-1)
            setattr(self, name, imgui.input_text_with_hint(label, hint, getattr(self, name))[1])
            theme.tooltip(tip)
        size = imgui.ImVec2(-1, _LINES * imgui.get_text_line_height() + 2 * imgui.get_style().frame_padding.y)
        theme.soft("To the student")
        _, self.words = imgui.input_text_multiline(WORDS_LABEL, self.words, size, imgui.InputTextFlags_.word_wrap)

    def _propose(self) -> None:
        """A file that is called as the assignment is, until another place is typed."""
        name = folder_name(self.title or "assignment")
        if name != self._proposed:
            self._proposed = name
            self.save.propose(proposed_path(name, Kind.ASSIGNMENT))

    def _lesson(self, index: int, one: GivenLesson) -> None:
        imgui.push_id(index)
        imgui.text_wrapped(one.title)
        goals = _tempo(one.goals)
        goals = _level(goals)
        goals = _passes(goals)
        imgui.set_next_item_width(-1)
        _, words = imgui.input_text_with_hint("##words", "what else you ask", goals.words)
        self.lessons[index] = replace(one, goals=replace(goals, words=words))
        if imgui.button(REMOVE_LABEL):
            self.lessons[index] = replace(one, name="")
        imgui.separator()
        imgui.pop_id()

    @staticmethod
    def _given(state: State) -> None:
        if not state.teacher.given:
            return
        theme.part("Given before")
        for one in reversed(state.teacher.given):
            due = "" if one.due is None else f", due {one.due:%d %b %Y}"
            group = f" · {one.group}" if one.group else ""
            imgui.text_wrapped(f"{one.title}{group}{due}")
            theme.tooltip("\n".join(lesson.title for lesson in one.lessons))


def _tempo(goals: LessonGoals) -> LessonGoals:
    _, asks = theme.checkbox("clean at##tempo", goals.tempo_bpm is not None)
    theme.tooltip("Reached in a session that misses none of the lesson's goals, at this tempo or faster")
    if not asks:
        return replace(goals, tempo_bpm=None)
    imgui.same_line()
    imgui.set_next_item_width(-1)
    _, bpm = imgui.input_int("##bpm", round(goals.tempo_bpm or 80.0), 5)
    return replace(goals, tempo_bpm=float(min(max(bpm, round(MIN_BPM)), round(MAX_BPM))))


def _level(goals: LessonGoals) -> LessonGoals:
    levels = [None, *OUR_LEVELS.values()]
    imgui.set_next_item_width(-1)
    names = [_ANY, *(f"judged as {level} or more strictly" for level in OUR_LEVELS.values())]
    _, index = imgui.combo("##level", levels.index(goals.level), names)
    return replace(goals, level=levels[index])


def _passes(goals: LessonGoals) -> LessonGoals:
    _, asks = theme.checkbox("passes##passes", goals.passes is not None)
    theme.tooltip("So many times through, in all sessions together")
    if not asks:
        return replace(goals, passes=None)
    imgui.same_line()
    imgui.set_next_item_width(-1)
    _, passes = imgui.input_int("##passes-count", goals.passes or 8, 1)
    return replace(goals, passes=min(max(passes, 1), _MOST_PASSES))
