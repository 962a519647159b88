"""A battle judged again from its capture alone: the same under the same windows, something else under others."""

from dataclasses import replace
from pathlib import Path

import pytest

from station.core.errors import BadInput
from station.devices.capture.capture import read_capture
from station.devices.capture.replay import replay_all
from station.practice.battle.battle import Battle
from station.practice.battle.battle_result import BattleResult
from station.practice.battle.battle_rules import BattleMode, BattleRules
from station.practice.battle.drummed import drummed
from station.practice.battle.ground import Ground
from station.practice.battle.people.player import Player
from station.practice.battle.records.battle_document import battle_document
from station.practice.battle.records.battle_report import battle_report
from station.practice.battle.records.judge_battle_again import RejudgedBattle, judge_battle_again
from station.practice.battle.turn_plan import PlannedTurn
from station.practice.headless.virtual_battle import battle_virtually
from station.practice.headless.virtual_performers import virtual_performers
from station.scoring.matching.hit_windows import Level
from tests.fakes.played_battle import PlayedBattle, Stroke, as_written, nothing, quarters

TWO = (Player("Ann"), Player("Ben"))
TWO_KITS = (Player("Ann", "player 1"), Player("Ben", "player 2"))


def played(rules: BattleRules, capture: Path, spec: str = "intermediate,seed=2") -> BattleResult:
    battle = Battle(rules, drummed)
    assert battle_virtually(battle, virtual_performers(rules, [spec] * len(rules.players)), capture) is None
    return battle.result()


@pytest.mark.parametrize("players", [(Player("Ann"),), TWO, TWO_KITS])
@pytest.mark.parametrize("mode", list(BattleMode))
def test_a_capture_alone_gives_the_same_battle(mode: BattleMode, players: tuple[Player, ...], tmp_path: Path) -> None:
    rules = BattleRules(Ground(120.0), mode, players=players, rounds=1, has_final=False, bars=2, keeps_time=True)
    result = played(rules, tmp_path / "capture")
    again = judge_battle_again(read_capture(tmp_path / "capture"))
    assert battle_document(again) == battle_document(result)
    assert all(turn.marks is not None for turn in result.turns if turn.planned.kind.value == "answer")


def test_other_windows_judge_otherwise(tmp_path: Path) -> None:
    rules = BattleRules(Ground(120.0), rounds=3, level=Level.BEGINNER, lives=9)
    result = played(rules, tmp_path / "capture", "beginner,seed=3")
    again = judge_battle_again(read_capture(tmp_path / "capture"), Level.STUDIO)
    assert again.rules.level is Level.STUDIO
    assert again.standings[1].points < result.standings[1].points


@pytest.mark.parametrize("share", [0.3, 0.7])
def test_a_battle_that_was_cut_off_is_judged_as_far_as_it_went(share: float, tmp_path: Path) -> None:
    rules = BattleRules(Ground(120.0), rounds=4)
    whole = played(rules, tmp_path / "capture", "pro,seed=1")
    data = (tmp_path / "capture").read_bytes()
    (tmp_path / "cut").write_bytes(data[: round(len(data) * share)])
    result = judge_battle_again(read_capture(tmp_path / "cut"))
    assert not result.is_complete
    assert 0 < len(result.turns) < len(whole.turns)
    for before, after in zip(whole.turns, result.turns, strict=False):
        assert before.marks == after.marks


def test_a_capture_without_a_battle_is_refused(tmp_path: Path) -> None:
    played(BattleRules(Ground(120.0), rounds=1, has_final=False), tmp_path / "capture")
    entries = [entry for entry in replay_all(read_capture(tmp_path / "capture")) if not hasattr(entry, "text")]
    with pytest.raises(BadInput, match="no battle"):
        RejudgedBattle(entries).result(0)


def test_by_narrower_windows_a_battle_that_was_played_on_has_the_lives_of_its_end_and_says_so(tmp_path: Path) -> None:
    """A beginner misses nearly every phrase by 5 ms: without a life after three rounds, it would have ended there."""
    rules = BattleRules(Ground(120.0), rounds=6, level=Level.BEGINNER, lives=9, target=0.01, first_step=3)
    played(rules, tmp_path / "capture", "beginner,seed=3")
    again = judge_battle_again(read_capture(tmp_path / "capture"), Level.STUDIO)
    strict = replace(again, rules=replace(again.rules, lives=3, target=0.9))
    assert strict.standings[1].lives == 0
    assert strict.played_on_after == 3
    assert battle_document(strict)["played_on_after"] == 3
    assert "By these windows it would have ended after round 3; it was played on." in battle_report(strict)
    assert "played on" not in battle_report(again), "nine lives are enough"


def test_whoever_was_left_when_it_was_decided_loses_no_life_after_it(tmp_path: Path) -> None:
    """Ann never plays and is out after two rounds; Ben loses his rounds from the third on."""
    rules = BattleRules(Ground(120.0), players=TWO, rounds=6, has_final=False, lives=9, first_step=0)

    def plays(turn: PlannedTurn) -> list[Stroke]:
        return as_written(turn) if turn.side == 2 and turn.round < 3 else nothing(turn)

    result = PlayedBattle(Battle(rules, quarters), plays).until().battle.result()
    strict = replace(result, rules=replace(rules, lives=2))
    assert [side.lives for side in strict.standings] == [None, 0, 2]
    assert (strict.played_on_after, strict.winner) == (2, 2)
