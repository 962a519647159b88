"""What decides a battle with a handicap, in words: what each player was worth against their own earlier battles."""

from station.practice.battle.battle_result import BattleResult
from station.practice.battle.battle_rules import BattleMode
from station.practice.battle.people.handicap import USUAL_POINTS, USUAL_SPREAD, Expectation

AS_EVER = 50
"""What a turn is worth on the mean to whoever plays as they always have (`people.handicap`)."""


def handicap_words(result: BattleResult) -> str:
    """Such as "Won by Kid on the handicap: 62 against what their own earlier battles foretell (50), Mum 41".

    For a battle with a handicap that was played to its end.
    """
    rules, stands = result.rules, result.standings
    worth = {side: stands[side].handicapped or 0.0 for side in rules.player_sides}
    order = sorted(worth, key=lambda side: -worth[side])
    are_told_apart = len({f"{one:.0f}" for one in worth.values()}) == len(worth)
    told = [f"{worth[side]:{'.0f' if are_told_apart else '.1f'}}" for side in order]
    names = [rules.player_of(side).name for side in order]
    players = zip(rules.players, rules.expectations, strict=True)
    unknown = [player.name for player, expected in players if not _is_known(expected, rules.mode)]
    foretold = f"what their own earlier battles foretell ({AS_EVER})"
    if len(unknown) == len(names):
        foretold = f"what is usual ({AS_EVER})"
    others = "".join(f", {name} {points}" for name, points in zip(names[1:], told[1:], strict=True))
    if result.winner is None:
        words = f"A draw on the handicap: {names[0]} {told[0]}{others}, against {foretold}"
    else:
        words = f"Won by {names[0]} on the handicap: {told[0]} against {foretold}{others}"
    return f"{words}{_unknown_words(unknown, len(names))}"


def _is_known(expected: Expectation, mode: BattleMode) -> bool:
    """Whether there is an earlier turn of the kind that is played."""
    if mode is BattleMode.REPEAT:
        return bool(expected.answered)
    return (expected.points, expected.spread) != (USUAL_POINTS, USUAL_SPREAD)


def _unknown_words(unknown: list[str], players: int) -> str:
    if not unknown:
        return ""
    return f"; nothing is known of {'them' if len(unknown) == players else ' and '.join(unknown)} yet"
