"""Everything that can be asked of the controller, by mouse, keys or kit: `Action`, a closed set of plain values.

`Controller.dispatch` takes them all; the parts that own what is changed take theirs, a file of this room each.
"""

from dataclasses import dataclass

from station.app.actions.equipment_actions import EquipmentAction
from station.app.actions.file_actions import FileAction, ImportAction
from station.app.actions.phase_actions import PhaseAction
from station.app.actions.player_actions import PlayerAction
from station.app.actions.practice_actions import ChoiceAction, PracticeAction
from station.app.actions.settings_actions import SettingsAction
from station.app.actions.style_actions import StyleAction


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
)
