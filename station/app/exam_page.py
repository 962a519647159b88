"""The exam in the window: what is asked, the look at it, one take, the marks.

Asked → (unseen reading) looked at, until the time is over or the student is ready → played once → marked. Whoever has
begun to look has seen the piece: that is kept at once. An unseen piece is in no list of lessons.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import Enum, auto
from typing import assert_never

from station.app.actions.exam_actions import (
    BeginExam,
    ChooseExam,
    DrawPiece,
    ExamAction,
    LeaveExam,
    ReadyForExam,
)
from station.app.sessions.session_control import SessionControl
from station.app.settings.settings_store import SettingsStore
from station.core.errors import BadInput, DeviceError
from station.core.units import NS_PER_S
from station.drills.exam.exam_piece import ExamPiece, Unseen, prepared_piece, reading_piece
from station.drills.exam.rubric import Marks
from station.music.score import Score
from station.practice.exam.exam_sitting import Sitting, drawn_seed
from station.render.snapshot import Snapshot


class ExamStage(Enum):
    """How far the exam is."""

    ASKED = auto()
    LOOKING = auto()
    PLAYING = auto()
    MARKED = auto()


@dataclass(frozen=True, slots=True, eq=False)
class ExamView:
    """What is shown: `piece` is what is asked, None where there is none, which `fault` may explain.

    `unseen` is which piece was chosen, None for the lesson that is chosen; `left_s` of the time to look, None outside;
    `seen_before` whether an unseen piece was none for this student; `marks` of the take, None before; `notes` what is
    read, with the hands of this student, None before the first look.
    """

    stage: ExamStage = ExamStage.ASKED
    unseen: Unseen | None = None
    piece: ExamPiece | None = None
    fault: str = ""
    left_s: float | None = None
    seen_before: bool = False
    marks: Marks | None = None
    notes: Score | None = None

    @property
    def shows_notes(self) -> bool:
        """Whether the whole piece is on the page: it is read, from the first look to the end of the take."""
        is_before_student = self.stage in (ExamStage.LOOKING, ExamStage.PLAYING)
        return is_before_student and self.piece is not None and self.piece.unseen is not None


@dataclass(frozen=True, slots=True)
class ExamSurroundings:
    """What the page asks of the station: the name of the `lesson` that is chosen, empty for none.

    `make_ready` ends what else hears the kit, raising `StationError` where it cannot; `show_lessons` shows what is
    chosen again.
    """

    lesson: Callable[[], str]
    make_ready: Callable[[], None]
    show_lessons: Callable[[], None]


class ExamPage:
    """The exam of the student of `store`, held in `sessions`."""

    def __init__(self, store: SettingsStore, sessions: SessionControl, around: ExamSurroundings) -> None:
        self._store, self._sessions, self._around = store, sessions, around
        self._catalog = sessions.catalog
        self._stage = ExamStage.ASKED
        self._unseen: Unseen | None = Unseen(1, drawn_seed())
        self._asked: tuple[Unseen | str, ExamPiece | BadInput] | None = None
        self._sitting: Sitting | None = None
        self._now_ns = 0
        self._until_ns: int | None = None

    @property
    def looks(self) -> bool:
        """Whether the student looks at a piece."""
        return self._stage is ExamStage.LOOKING

    @property
    def is_on(self) -> bool:
        """Whether a piece is looked at or played, or the result of its take is shown."""
        return self.looks or self._sessions.practice.is_exam

    # --- as time goes by ---------------------------------------------------------------------------------------------

    def advance(self, now_ns: int) -> None:
        """Count in when the time to look is over, take the marks when the take is; raises `StationError`."""
        self._now_ns = now_ns
        if self._until_ns is not None and now_ns >= self._until_ns:
            self._until_ns = None  # where it cannot be played now, it is when the student asks
            self._play()
        elif self._stage is ExamStage.PLAYING and not self._sessions.practice.is_playing:
            self._stage = ExamStage.MARKED
        elif self._stage is ExamStage.MARKED and self._sessions.practice.is_playing:  # something else
            self._stage, self._sitting = ExamStage.ASKED, None

    def view(self) -> ExamView:
        """What is shown."""
        piece, fault = self._shown_piece()
        is_marked = self._stage is ExamStage.MARKED
        return ExamView(
            self._stage,
            self._unseen,
            piece,
            fault,
            self._left_s() if self.looks else None,
            self._sitting is not None and self._sitting.seen_before,
            self._sessions.practice.last_result.marks if is_marked else None,
            None if self._sitting is None else self._sitting.plan.score,
        )

    def named(self, snapshot: Snapshot) -> Snapshot:
        """The picture, which says what is looked at while something is."""
        if not self.looks or self._sitting is None:
            return snapshot
        piece = self._sitting.piece
        beats = piece.beats_a_minute
        hud = replace(snapshot.hud, title=piece.lesson.title, phase="To look at", beats_a_minute=beats)
        return replace(snapshot, hud=hud)

    def _left_s(self) -> float:
        return 0.0 if self._until_ns is None else max(self._until_ns - self._now_ns, 0) / NS_PER_S

    def _shown_piece(self) -> tuple[ExamPiece | None, str]:
        """The piece, and what is wrong where there is none."""
        if self._sitting is not None:
            return self._sitting.piece, ""
        asked = self._unseen or self._around.lesson()
        if not asked:
            return None, ""
        if self._asked is None or self._asked[0] != asked:
            self._asked = asked, self._read(asked)
        found = self._asked[1]
        return (None, str(found)) if isinstance(found, BadInput) else (found, "")

    def _read(self, asked: Unseen | str) -> ExamPiece | BadInput:
        """The piece, or why it cannot be had."""
        try:
            return reading_piece(asked) if isinstance(asked, Unseen) else prepared_piece(self._catalog.lesson(asked))
        except BadInput as fault:
            return fault

    # --- what the user does ------------------------------------------------------------------------------------------

    def act(self, action: ExamAction) -> None:
        """Do what the user asks; raises `StationError`."""
        match action:
            case ChooseExam(unseen):
                self._choose(unseen)
            case DrawPiece():
                self._choose(Unseen(1 if self._unseen is None else self._unseen.level, drawn_seed()))
            case BeginExam():
                self._begin()
            case ReadyForExam():
                if self.looks:
                    self._play()
            case LeaveExam():
                self._leave()
            case _:
                assert_never(action)

    def _choose(self, unseen: Unseen | None) -> None:
        """Ask for another piece; one that is looked at or played stays."""
        if not (self.looks or self._stage is ExamStage.PLAYING):
            self._leave()
            self._unseen = unseen

    def _begin(self) -> None:
        if self.looks or self._sessions.practice.is_playing:
            raise DeviceError("end the session first: an exam takes its place")
        self._leave()
        self._asked = None  # a lesson of one's own may have been written anew
        piece, fault = self._shown_piece()
        if piece is None:
            raise DeviceError(fault or "choose a lesson first, or unseen reading")
        self._around.make_ready()
        self._sessions.dismiss()
        if not piece.preview_s:
            self._examine(piece)
            return
        self._sessions.look()
        self._sitting = Sitting.begin(piece, self._store.now)
        self._stage, self._until_ns = ExamStage.LOOKING, self._now_ns + round(piece.preview_s * NS_PER_S)

    def _play(self) -> None:
        """Count in what was looked at."""
        assert self._sitting is not None, "it was looked at"
        self._around.make_ready()
        self._examine(self._sitting.piece)

    def _examine(self, piece: ExamPiece) -> None:
        self._sessions.examine(piece, self._sitting)
        self._sitting = self._sessions.practice.session.sitting
        self._stage, self._until_ns = ExamStage.PLAYING, None
        self._around.show_lessons()  # when the result is left

    def _leave(self) -> None:
        """Back to what is asked, from a result that is shown too; a take that runs goes on."""
        if self._sessions.practice.is_playing:
            return
        if self._sessions.practice.is_exam:
            self._sessions.dismiss()
        has_looked, self._stage = self.looks, ExamStage.ASKED
        self._sitting = self._until_ns = None
        if has_looked:
            self._around.show_lessons()
