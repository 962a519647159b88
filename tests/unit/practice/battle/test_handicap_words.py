"""What decides a battle with a handicap is said, and what is known of the players."""

from pathlib import Path

import pytest

from station.app.battle.result_words import result_of
from station.practice.battle.battle_result import BattleResult, JudgedTurn
from station.practice.battle.battle_rules import BattleMode, BattleRules
from station.practice.battle.ground import Ground
from station.practice.battle.judging.improvisation_marks import Component, ComponentMarks, ImprovisationMarks
from station.practice.battle.judging.judged_improvisation import WEIGHTS
from station.practice.battle.people.player import Player
from station.practice.battle.records.battle_report import battle_report
from station.practice.battle.records.earlier_rounds import expected_of
from station.practice.battle.turn_plan import PlannedTurn, TurnKind
from station.practice.session.device_latency import Latency
from tests.fakes.known_students import one_student, take_all_in
from tests.unit.practice.battle.test_earlier_rounds import leave


def battle(sessions: Path, ann: float, ben: float) -> BattleResult:
    """A round of one improvised turn each, worth so many points."""
    names = ("Ann", "Ben")
    take_all_in(one_student(sessions, "Ann"))
    rules = BattleRules(
        Ground(100.0),
        BattleMode.IMPROVISE,
        players=tuple(map(Player, names)),
        rounds=1,
        has_final=False,
        expectations=tuple(expected_of(one_student(sessions, name)) for name in names),
    )
    turns = tuple(
        JudgedTurn(
            PlannedTurn(side - 1, 1, side, TurnKind.ANSWER, 4 * (side - 1), 4),
            None,
            ImprovisationMarks(tuple(ComponentMarks(one, points, "") for one in Component), WEIGHTS),
        )
        for side, points in ((1, ann), (2, ben))
    )
    return BattleResult(rules, turns, True, Latency(), devices=(None, "TD-17", "TD-17"))


def outcome(result: BattleResult) -> str:
    return battle_report(result).splitlines()[3]


def test_in_a_first_battle_nothing_is_known(tmp_path: Path) -> None:
    # by hand: 55 points and a spread of 10 are usual, and two spreads earn all: 50 + 50 · 4.8 / 20, and − 3.6
    said = outcome(battle(tmp_path, 59.8, 51.4))
    assert said == "Won by Ann on the handicap: 62 against what is usual (50), Ben 41; nothing is known of them yet"


def test_earlier_battles_foretell_what_is_expected(tmp_path: Path) -> None:
    leave(tmp_path, "95")  # of Ann 60 are expected then: (7 · 55 + 95) / 8
    result = battle(tmp_path, 64.8, 51.4)
    said = "Won by Ann on the handicap: 62 against what their own earlier battles foretell (50), Ben 41"
    assert outcome(result) == f"{said}; nothing is known of Ben yet"
    assert result_of(result).headline == "Ann wins on the handicap"
    assert result_of(result).told == outcome(result)


def test_points_are_told_as_what_was_played(tmp_path: Path) -> None:
    leave(tmp_path, "95")
    result = battle(tmp_path, 54.0, 53.0)  # Ann 35, Ben 45
    lines = battle_report(result).splitlines()
    assert lines[3].startswith("Won by Ben on the handicap: 45 ")
    assert ", Ann 35" in lines[3]
    assert lines[4].startswith("Ann as played: 54")
    assert "expected" not in "".join(lines[4:6])


@pytest.mark.parametrize("points", [50.0, 60.0])
def test_a_draw_is_one_on_the_handicap(points: float, tmp_path: Path) -> None:
    assert outcome(battle(tmp_path, points, points)).startswith("A draw on the handicap: Ann ")


def test_who_is_ahead_by_less_than_a_point_is_seen(tmp_path: Path) -> None:
    assert "60.3 against what is usual (50), Ben 60.0" in outcome(battle(tmp_path, 59.12, 59.0))
