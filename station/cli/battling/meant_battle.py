"""The battle that is to be judged again: of a folder, of a capture, or of the history by a word."""

import os
from pathlib import Path

from station.cli.history_verbs.opened_history import opened_history
from station.core.settings import Settings
from station.devices.capture.capture import parse_capture
from station.practice.battle.battle_result import BattleResult
from station.practice.battle.records.battle_folder import kept_battle
from station.practice.battle.records.judge_battle_again import judge_battle_again
from station.practice.history.session_choice import choose_session
from station.scoring.matching.hit_windows import Level


def meant_battle(word: str, level: Level | None, settings: Settings) -> BattleResult:
    """The battle that `word` means, judged by the windows of `level`, None: as on the day.

    Raises `BadInput` where there is none, `DeviceError` where the history cannot be reached.
    """
    if os.path.exists(word):  # noqa: PTH110 - no error for long names
        return kept_battle(Path(word), level)
    history = opened_history(settings, settings.student)
    chosen = choose_session(history, settings.student, word)
    return judge_battle_again(parse_capture(chosen.capture_data(history), chosen.source), level)
