"""Who does what the user asks: a handler for every kind of action."""

from collections.abc import Callable
from functools import partial
from typing import Any, get_args

from station.app.actions.action import Notify, Show
from station.app.actions.battle_actions import BattleAction
from station.app.actions.editor_actions import EditorAction
from station.app.actions.equipment_actions import CalibrationAction, MappingAction, StickAction
from station.app.actions.exam_actions import ExamAction
from station.app.actions.file_actions import FileAction, ImportAction
from station.app.actions.history_actions import HistoryAction
from station.app.actions.phase_actions import PhaseAction
from station.app.actions.player_actions import PlayerAction
from station.app.actions.practice_actions import ChoiceAction, PracticeAction
from station.app.actions.settings_actions import AskWhoPlays, Embody, KeptSetting, PlayAs
from station.app.actions.song_actions import PinAction, SaveSong
from station.app.actions.sound_actions import SoundAction
from station.app.actions.style_actions import StyleAction
from station.app.actions.teacher_actions import SendReturn, TakeUp, TeacherAction
from station.app.actions.today_actions import BookAction, StartBlock
from station.app.handlers.device_handler import measure, show
from station.app.handlers.file_handler import bring_in, keep_song, write_file
from station.app.handlers.history_handler import look_back
from station.app.handlers.practice_handler import battle, begin_block, choose, edit, practise, sit_exam
from station.app.handlers.settings_handler import embody, keep_setting, restyle
from station.app.handlers.student_handler import ask_who_plays, play_as
from station.app.station_parts import StationParts

Handler = Callable[[Any], str | None]
"""Does an action of its kind; returns a line for the user, empty or None for none. Raises `StationError`."""


def handlers_of(parts: StationParts) -> dict[type, Handler]:
    """The handler of each class of action."""
    rows: tuple[tuple[Any, Handler], ...] = (
        (ChoiceAction, partial(choose, parts)),
        (PracticeAction, partial(practise, parts)),
        (EditorAction, partial(edit, parts)),
        (ExamAction, partial(sit_exam, parts)),
        (BattleAction, partial(battle, parts)),
        (StartBlock, partial(begin_block, parts)),
        (BookAction, parts.today.act),
        (PlayerAction, parts.sessions.player.act),
        (PhaseAction, parts.phase.act),
        (StyleAction, partial(restyle, parts)),
        (Embody, partial(embody, parts)),
        (PlayAs, partial(play_as, parts)),
        (AskWhoPlays, partial(ask_who_plays, parts)),
        (KeptSetting, partial(keep_setting, parts)),
        (MappingAction, parts.mapping.act),
        (StickAction, parts.sticks.act),
        (CalibrationAction, partial(measure, parts)),
        (ImportAction, partial(bring_in, parts)),
        (FileAction, partial(write_file, parts)),
        (PinAction, parts.song.act),
        (SaveSong, partial(keep_song, parts)),
        (SoundAction, parts.sound.act),
        (TeacherAction, parts.teacher.act),
        (HistoryAction, partial(look_back, parts)),
        (SendReturn, parts.assigned.send),
        (TakeUp, lambda action: parts.chooser.take_up(action.lesson)),
        (Show, partial(show, parts)),
        (Notify, lambda action: action.line),
    )
    return {kind: handle for kinds, handle in rows for kind in get_args(kinds) or (kinds,)}
