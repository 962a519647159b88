"""The rules of a battle as plain JSON, in its capture and in its document, and read again with suspicion."""

from station.practice.battle.battle_rules import BattleMode, BattleRules
from station.practice.battle.ground import Feel, Ground
from station.practice.battle.people.handicap import MEMORY, Expectation
from station.practice.battle.people.player import Player
from station.practice.battle.repeating.demands import MOST_STEP
from station.practice.battle.repeating.staircase import Answered
from station.practice.session.cues.click_options import click_text, parse_click
from station.practice.session.log_values import rows_in, table_in, whole
from station.scoring.matching.hit_windows import Level
from station.scoring.report.assessment_document import Json

_MOST_BEATS, _UNITS = 64, (1, 2, 4, 8, 16, 32)


def rules_fields(rules: BattleRules) -> dict[str, Json]:
    """All that was agreed, as `rules_of` reads it."""
    ground = rules.ground
    return {
        "mode": rules.mode.value,
        "opponent": rules.opponent,
        "players": [{"name": player.name, "device": player.device} for player in rules.players],
        "tempo_bpm": float(ground.tempo_bpm),
        "meter": [ground.beats, ground.unit],
        "feel": ground.feel.value,
        "style": ground.style,
        "rounds": rules.rounds,
        "final": rules.has_final,
        "bars": rules.bars,
        "lives": rules.lives,
        "target": float(rules.target),
        "level": rules.level.value,
        "first_step": rules.first_step,
        "seed": rules.seed,
        "click": click_text(rules.click),
        "keeps_time": rules.keeps_time,
        "expectations": [_expectation_fields(one) for one in rules.expectations],
    }


def _expectation_fields(expected: Expectation) -> dict[str, Json]:
    return {
        "answered": [[answer.step, answer.is_won] for answer in expected.answered],
        "had": list(expected.had),
        "points": float(expected.points),
        "spread": float(expected.spread),
    }


def rules_of(fields: dict[str, object]) -> BattleRules:
    """The rules whose `rules_fields` these are; raises `BadInput`, `ValueError` and its like for what are none."""
    beats, unit = (whole(part) for part in rows_in(fields["meter"]))
    if not 1 <= beats <= _MOST_BEATS or unit not in _UNITS:
        raise ValueError
    ground = Ground(float(str(fields["tempo_bpm"])), beats, unit, Feel(fields["feel"]), str(fields["style"]))
    players = [table_in(player) for player in rows_in(fields["players"])]
    return BattleRules(
        ground=ground,
        mode=BattleMode(fields["mode"]),
        opponent=str(fields["opponent"]),
        players=tuple(Player(str(player["name"]), str(player["device"])) for player in players),
        rounds=whole(fields["rounds"]),
        has_final=fields["final"] is True,
        bars=whole(fields["bars"]),
        lives=whole(fields["lives"]),
        target=float(str(fields["target"])),
        level=Level(str(fields["level"])),
        first_step=None if fields["first_step"] is None else whole(fields["first_step"]),
        seed=whole(fields["seed"]),
        click=parse_click(str(fields["click"])),
        keeps_time=fields["keeps_time"] is True,
        expectations=tuple(_expectation(table_in(one)) for one in rows_in(fields["expectations"])),
    )


def _expectation(fields: dict[str, object]) -> Expectation:
    answered = [rows_in(answer) for answer in rows_in(fields["answered"])]
    points, spread = float(str(fields["points"])), float(str(fields["spread"]))
    had = tuple(sorted(float(str(one)) for one in rows_in(fields["had"])))
    if len(answered) > MEMORY or not 1 <= len(had) <= MEMORY or not all(0 <= one <= 100 for one in (*had, points)):
        raise ValueError
    if not 0 < spread <= 100:  # also refuses NaN
        raise ValueError
    steps = tuple(Answered(_step(step), is_won is True) for step, is_won in answered)
    return Expectation(steps, had, points, spread)


def _step(value: object) -> int:
    step = whole(value)
    if not 0 <= step <= MOST_STEP:
        raise ValueError
    return step
