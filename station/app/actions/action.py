"""Everything that can be asked of the controller, by mouse, keys or kit: `Action`, a closed set of plain values.

`Controller.dispatch` takes them all; `handlers.handler_table` says who does what.
"""

from dataclasses import dataclass

from station.app.actions.battle_actions import BattleAction
from station.app.actions.editor_actions import EditorAction
from station.app.actions.equipment_actions import EquipmentAction
from station.app.actions.exam_actions import ExamAction
from station.app.actions.file_actions import FileAction, ImportAction
from station.app.actions.history_actions import HistoryAction
from station.app.actions.phase_actions import PhaseAction
from station.app.actions.player_actions import PlayerAction
from station.app.actions.practice_actions import ChoiceAction, PracticeAction
from station.app.actions.settings_actions import SettingsAction
from station.app.actions.song_actions import SongAction
from station.app.actions.sound_actions import SoundAction
from station.app.actions.style_actions import StyleAction
from station.app.actions.teacher_actions import AssignedAction, TeacherAction
from station.app.actions.today_actions import TodayAction


@dataclass(frozen=True, slots=True)
class Show:
    """What the window shows from now on: nothing else is computed, and a page that nobody sees does not listen.

    `catalog` is every lesson there is, beside the one that the window was opened on.
    """

    picture: bool = True
    catalog: bool = False
    devices: bool = False
    sticks: bool = False
    practice: bool = False
    curves: bool = False
    phase: bool = False
    today: bool = False
    exam: bool = False
    teacher: bool = False
    assigned: bool = False
    history: bool = False
    sound: bool = False


@dataclass(frozen=True, slots=True)
class Notify:
    """Show the user a line."""

    line: str


Action = (
    Show
    | Notify
    | ChoiceAction
    | PracticeAction
    | PlayerAction
    | StyleAction
    | SettingsAction
    | EquipmentAction
    | FileAction
    | ImportAction
    | PhaseAction
    | EditorAction
    | TodayAction
    | SongAction
    | SoundAction
    | ExamAction
    | BattleAction
    | TeacherAction
    | AssignedAction
    | HistoryAction
)
