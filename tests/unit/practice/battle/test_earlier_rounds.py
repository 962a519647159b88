"""Documents of earlier battles that somebody has edited or damaged say nothing of what to expect."""

from dataclasses import replace
from pathlib import Path

import pytest

from station.core.settings import Settings
from station.practice.battle.battle_rules import BattleMode, BattleRules
from station.practice.battle.ground import Ground
from station.practice.battle.people.player import Player
from station.practice.battle.records.earlier_rounds import after_earlier, expected_of
from station.practice.history.session_files import BATTLE_NAME
from station.practice.history.student_history import StudentHistory
from station.scoring.matching.hit_windows import Level
from tests.fakes.known_students import one_student, take_all_in

SCORES = '"scores": [{"name": "Ann", "drummer": false, "device": %s}]'
TURN = '{"kind": "answer", "name": "Ann", "step": %s, "won": %s, "marks": {"points": %s}}'
RULES = '{"players": [{"name": "Ann"}], "expectations": []}'


def leave(
    sessions: Path, points: str, device: str = '"TD-17"', step: str = "null", won: str = "null", hour: int = 10
) -> None:
    folder = sessions / "Ann" / f"2026-01-01T{hour}-00-00_battle-steady"
    folder.mkdir(parents=True)
    (folder / BATTLE_NAME).write_text(
        '{"rules": '
        + RULES
        + ', "rounds": [{"final": false, "turns": ['
        + TURN % (step, won, points)
        + "]}], "
        + SCORES % device
        + "}"
    )


def ann(sessions: Path) -> StudentHistory:
    """Ann, whose battles the history knows."""
    whose = one_student(sessions, "Ann")
    take_all_in(whose)
    return whose


@pytest.mark.parametrize("points", ["1e999", "-1e999", "NaN", "101", "-1", '"inf"', '"x"'])
def test_points_that_no_turn_has_say_nothing(points: str, tmp_path: Path) -> None:
    leave(tmp_path, points)
    assert expected_of(ann(tmp_path)) == expected_of(StudentHistory(Settings(), "nobody"))


def test_points_of_a_turn_are_read(tmp_path: Path) -> None:
    leave(tmp_path, "95")
    assert expected_of(ann(tmp_path)).points == pytest.approx((7 * 55 + 95) / 8)  # by hand: filled up to 8 turns


def test_a_virtual_player_of_a_name_is_not_the_person_of_that_name(tmp_path: Path) -> None:
    leave(tmp_path, "95", '"virtual player 1"')
    assert expected_of(ann(tmp_path)) == expected_of(StudentHistory(Settings(), "nobody"))
    assert expected_of(ann(tmp_path), virtual=True).points == pytest.approx((7 * 55 + 95) / 8)


def test_a_battle_in_which_nothing_of_theirs_was_heard_says_nothing(tmp_path: Path) -> None:
    leave(tmp_path, "0", "null")
    assert expected_of(ann(tmp_path)) == expected_of(StudentHistory(Settings(), "nobody"))


def test_a_battle_begins_where_earlier_battles_of_theirs_have_led(tmp_path: Path) -> None:
    settings = ann(tmp_path).settings
    rules = BattleRules(Ground(100), BattleMode.REPEAT, players=(Player("Ann"),), level=Level.BEGINNER)
    assert after_earlier(rules, settings, has_handicap=False).staircase.next_step(()) == 1, "as the level"
    for hour in range(10, 22):
        leave(tmp_path, "100", step=f"{hour - 4}", won="true", hour=hour)
    take_all_in(ann(tmp_path))
    led = after_earlier(rules, settings, has_handicap=False).staircase.next_step(())
    assert led >= 16, "they won step 17 last"
    asked = replace(rules, first_step=2)
    assert after_earlier(asked, settings, has_handicap=False) == asked
    assert after_earlier(rules, settings, has_handicap=False, virtual=True) == rules
