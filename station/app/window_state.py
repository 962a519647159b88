"""What the window shows in one frame: everything that the panels and the picture need, in one frozen value."""

from dataclasses import dataclass, field
from pathlib import Path

from station.app.battle.battle_shown import BattleShown
from station.app.editor.draft_journal import LeftDraft
from station.app.editor.editor_view import EditorView
from station.app.equipment.calibration import CalibrationView
from station.app.equipment.mapping_view import MappingView
from station.app.equipment.sticks_view import SticksView
from station.app.exam_page import ExamView
from station.app.export import ExportView
from station.app.history.history_shown import HistoryView
from station.app.importer import ImportView
from station.app.phase_page import PhaseView
from station.app.room_state import RoomState, ShownResult, Stage
from station.app.selection import Selection
from station.app.sessions.demo_picture import PlayerView
from station.app.sessions.screen_choice import ScreenChoice
from station.app.sessions.who_plays import StudentsView
from station.app.settings.preferences import PracticePreferences
from station.app.settings.view_settings import ViewSettings
from station.app.songs.song_page import SongView
from station.app.sound.sound_page import SoundView
from station.app.style_editor import StyleView
from station.app.teacher_desk.assigned_page import AssignedView
from station.app.teacher_desk.teacher_page import TeacherView
from station.app.today_page import TodayView
from station.core.settings import Settings
from station.motion.sticking.hand_notes import Hands
from station.music.score import Score
from station.practice.session.cues.click_flash import DARK, Flash
from station.render.snapshot import Snapshot
from station.scenes.curves import ScoreCurves


@dataclass(frozen=True, slots=True, eq=False)
class State:
    """The station at one time.

    `room` is what goes on; `snapshot` the picture, None while none is shown (`actions.Show`), as are `curves`, the
    graph's; `mapping`, `calibration` and `sticks` are empty then. `report` is the result of the session that ended
    last, once the question before it was answered. `score` is the lesson that is shown, at its own tempo, `hands` who
    leads. `phase` is the motion whose phase sounds, empty while its panel is closed. `export_bars` (from 0) are what
    files are made of, `export` what was made, `played` the capture of the last take or session, `imports` what comes
    in, `editor` the lesson that is edited, None for none, `drafts` those that were left unsaved, `today` the day's
    plan and the lesson book, `song` the one that is pinned to its sound, `exam` how far an exam is, `battle` the page
    of battles, `teacher` what students sent, `assigned` what a teacher gave, `history` what was practised, `sound` what
    sounds, each empty while nobody looks. `choice` is to be chosen from on the screen now; `students` says who plays
    and who else may; `flash` is the click as light; `toast` is shown in passing; `is_lively` whether something moves or
    may at any moment, so that no frame is to be spared.
    """

    room: RoomState
    selection: Selection
    player: PlayerView
    settings: Settings
    view_settings: ViewSettings
    style: StyleView
    hands: Hands
    score: Score
    preferences: PracticePreferences
    mapping: MappingView
    calibration: CalibrationView
    sticks: SticksView
    snapshot: Snapshot | None = None
    report: ShownResult | None = None
    curves: ScoreCurves | None = None
    phase: PhaseView = field(default_factory=PhaseView)
    learns_pause: bool = False
    export_bars: tuple[int, int] = (0, 0)
    export: ExportView = field(default_factory=ExportView)
    played: Path | None = None
    imports: ImportView = field(default_factory=ImportView)
    editor: EditorView | None = None
    drafts: tuple[LeftDraft, ...] = ()
    today: TodayView = field(default_factory=TodayView)
    song: SongView = field(default_factory=SongView)
    exam: ExamView = field(default_factory=ExamView)
    battle: BattleShown = field(default_factory=BattleShown)
    teacher: TeacherView = field(default_factory=TeacherView)
    assigned: AssignedView = field(default_factory=AssignedView)
    history: HistoryView = field(default_factory=HistoryView)
    sound: SoundView = field(default_factory=SoundView)
    choice: ScreenChoice | None = None
    flash: Flash = DARK
    toast: str = ""
    students: StudentsView = field(default_factory=StudentsView)
    is_lively: bool = True

    @property
    def shows_result(self) -> bool:
        """Whether a result may be seen."""
        return self.room.stage is Stage.RESULT and self.report is not None
