"""Virtual players of a battle: they repeat as well as they can play, and improvise as well as they know how."""

from collections.abc import Sequence

from station.practice.battle.battle import Battle
from station.practice.battle.battle_rules import BattleMode, BattleRules
from station.practice.battle.turn_judging import played_in
from station.practice.battle.turn_plan import PlannedTurn
from station.practice.battle.virtual_improviser import VirtualImproviser
from station.practice.headless.virtual_battle import Performer
from station.simulation.student_midi import TimedBytes
from station.simulation.student_spec import StudentSpec, parse_spec
from station.simulation.virtual_student import VirtualStudent


def virtual_performers(rules: BattleRules, specs: Sequence[str]) -> dict[int, Performer]:
    """A player for each side, as its line says; raises `BadInput` for a line that says nothing."""
    make = _repeating if rules.mode is BattleMode.REPEAT else _improvising
    return {side: make(parse_spec(spec)) for side, spec in zip(rules.player_sides, specs, strict=True)}


def _repeating(spec: StudentSpec) -> Performer:
    student = VirtualStudent(spec)

    def perform(turn: PlannedTurn, battle: Battle) -> Sequence[TimedBytes]:
        assert turn.phrase is not None, f"turn {turn.index} of {len(battle.plan)} has something to repeat"
        return student.play(turn.phrase.score).midi

    return perform


def _improvising(spec: StudentSpec) -> Performer:
    improviser = VirtualImproviser(spec)

    def perform(turn: PlannedTurn, battle: Battle) -> Sequence[TimedBytes]:
        before = [(one.side, played_in(battle.rules, one, battle.ear)) for one in battle.plan[: turn.index]]
        heard = [played for side, played in before if side != turn.side and played is not None]
        said = [played for side, played in before if side == turn.side and played is not None]
        return improviser.improvise(battle.rules.ground, turn.bars, heard, said).midi

    return perform
