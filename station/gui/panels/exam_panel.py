"""Exam: which piece, the rubric before it is played, and beside the rubric the marks when it was."""

from collections.abc import Callable, Iterator

from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.exam_actions import BeginExam, ChooseExam, DrawPiece, LeaveExam
from station.app.exam_page import ExamStage, ExamView
from station.app.room_state import Stage
from station.app.window_state import State
from station.drills.exam.exam_piece import ExamPiece, Unseen
from station.drills.exam.rubric import Marks
from station.drills.lesson import LEVELS
from station.gui import theme
from station.practice.exam.exam_record import BANDS_WORDS, SEEN_WORDS, asked_words, look_words
from station.practice.exam.exam_sitting import MOST_SEEDS, drawn_seed
from station.practice.history.exam_words import shown_total

EXAM = "Exam"
ABOUT = "One take of a lesson or of an unseen piece, marked by a rubric that is shown before"
HELP = (
    "The rubric says what is marked. Unseen reading shows you a piece that you have not met for 90 seconds; you may try"
    " parts of it on the kit. Then it is counted in and played once: nothing is demonstrated, nothing is said while"
    " you play, and nothing pauses. The same level and number are the same piece everywhere, for a whole class. A"
    " lesson that you have prepared is played at its goal, without a look."
)
UNSEEN_LABEL, LESSON_LABEL = "Unseen reading##unseen", "The chosen lesson##prepared"
LEVEL_LABEL, SEED_LABEL, DRAW_LABEL = "##exam-level", "##exam-seed", "Another##draw"
LOOK_LABEL, PLAY_LABEL, NEXT_LABEL = "Look at it##begin-exam", "Play it##begin-exam", "Another exam##next-exam"
_BUTTON, _DRAW = 46.0, 96.0
"""Design pixels: the height of the button that begins, the width of the one that draws another piece."""


class ExamPanel:
    """The panel; what the user does goes to `dispatch`."""

    def __init__(self, dispatch: Callable[[Action], None]) -> None:
        self._dispatch = dispatch
        self._stage = ExamStage.ASKED

    def gui(self, state: State) -> None:
        """Draw the panel and do what the user does in it."""
        view = state.exam
        if view.stage is not self._stage:  # what is new begins above
            self._stage = view.stage
            imgui.set_scroll_y(0)
        if view.stage is ExamStage.ASKED:
            self._choice(view)
        if view.piece is None:
            theme.warning(view.fault) if view.fault else theme.soft("Choose a lesson in the list first.")
            return
        theme.heading(view.piece.lesson.title, 20)
        theme.soft(asked_words(view.piece))
        if view.marks is not None:
            self._marked(view, view.marks)
        else:
            self._asked(view, view.piece, can_begin=state.room.stage is not Stage.PLAYING)

    # --- before ------------------------------------------------------------------------------------------------------

    def _choice(self, view: ExamView) -> None:
        """Unseen reading by level and number, or the lesson that is chosen."""
        unseen = view.unseen
        if imgui.radio_button(UNSEEN_LABEL, unseen is not None) and unseen is None:
            self._dispatch(ChooseExam(Unseen(min(LEVELS), drawn_seed())))
        theme.tooltip("A piece that you have not met, read at sight")
        if imgui.radio_button(LESSON_LABEL, unseen is None) and unseen is not None:
            self._dispatch(ChooseExam(None))
        theme.tooltip("The lesson that is chosen in the list, as you have prepared it, at its goal")
        if unseen is not None:
            self._which(unseen)
        imgui.separator()

    def _which(self, unseen: Unseen) -> None:
        imgui.set_next_item_width(-1)
        _, level = theme.slider_int(LEVEL_LABEL, unseen.level, min(LEVELS), max(LEVELS), "level %d")
        theme.tooltip("How hard it is: on the snare up to 3, over walking feet at 4, on the kit at 5")
        imgui.set_next_item_width(-(theme.points(_DRAW) + imgui.get_style().item_spacing.x))
        _, seed = imgui.input_int(SEED_LABEL, unseen.seed, 0)
        theme.tooltip("The number of the piece: with its level it is the same piece everywhere")
        chosen = Unseen(level, min(max(seed, 0), MOST_SEEDS))
        if chosen != unseen:
            self._dispatch(ChooseExam(chosen))
        imgui.same_line()
        if imgui.button(DRAW_LABEL, imgui.ImVec2(-1, 0)):
            self._dispatch(DrawPiece())
        theme.tooltip("Another piece of this level, drawn at random")

    def _asked(self, view: ExamView, piece: ExamPiece, can_begin: bool) -> None:
        """What is asked, and the button that begins."""
        if view.stage is ExamStage.PLAYING:
            theme.warning("One take: nothing is said until it is over.")
        elif piece.preview_s:
            theme.soft(look_words(piece))
        if view.seen_before:
            theme.warning(SEEN_WORDS)
        _table("##rubric", ("", "Worth", "Full marks"), _rubric_rows(piece))
        theme.soft(f"Of 100: {BANDS_WORDS}.")
        if view.stage is not ExamStage.ASKED:
            return
        label = LOOK_LABEL if piece.preview_s else PLAY_LABEL
        if theme.main_button(label, (-1, theme.points(_BUTTON)), enabled=can_begin):
            self._dispatch(BeginExam())
        theme.tooltip("From now on you have met this piece" if piece.preview_s else "A count-in, then one take")

    # --- after -------------------------------------------------------------------------------------------------------

    def _marked(self, view: ExamView, marks: Marks) -> None:
        theme.heading(f"{shown_total(marks.total)} of 100: {marks.band.name}")
        if view.seen_before:
            theme.warning(SEEN_WORDS)
        _table("##marks", ("", "Marks", "What was played"), _marks_rows(marks))
        theme.soft(f"Of 100: {BANDS_WORDS}.")
        if imgui.button(NEXT_LABEL, imgui.ImVec2(-1, theme.points(_BUTTON))):
            self._dispatch(LeaveExam())
        theme.tooltip("What is asked, again; this one is kept among your sessions")


_Row = tuple[str, str, str]


def _rubric_rows(piece: ExamPiece) -> Iterator[_Row]:
    return ((line.title, line.worth_words, line.words) for line in piece.rubric.lines)


def _marks_rows(marks: Marks) -> Iterator[_Row]:
    return ((mark.line.title, mark.points_words, f"{mark.words}\n({mark.line.words})") for mark in marks.lines)


def _table(name: str, heads: _Row, rows: Iterator[_Row]) -> None:
    """Three columns: the last has what room is left, and breaks its lines; in a narrow panel it stands below."""
    if theme.is_narrow():
        _list(rows)
        return
    if not imgui.begin_table(name, len(heads), imgui.TableFlags_.borders_inner_h | imgui.TableFlags_.pad_outer_x):
        return
    for head, flags in zip(heads, (*[imgui.TableColumnFlags_.width_fixed] * 2, 0), strict=True):
        imgui.table_setup_column(head, flags)
    imgui.table_headers_row()
    for row in rows:
        imgui.table_next_row()
        for words in row:
            imgui.table_next_column()
            if words is row[-1]:
                imgui.text_wrapped(words)
            else:
                imgui.text(words)
    imgui.end_table()


def _list(rows: Iterator[_Row]) -> None:
    """A line of what and how much each, and below it the words."""
    for what, worth, words in rows:
        imgui.separator()
        imgui.text_wrapped(f"{what}: {worth}")
        theme.soft(words)
