"""What players have done in earlier battles, as the history has them: what is expected of them."""

import json
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace

from station.core.settings import Settings
from station.practice.battle.battle_rules import BattleMode, BattleRules
from station.practice.battle.people.handicap import Earlier, Expectation, expectation
from station.practice.battle.people.player import is_virtual
from station.practice.battle.repeating.demands import MOST_STEP
from station.practice.history.session_files import BATTLE_NAME
from station.practice.history.student_history import StudentHistory
from station.practice.session.log_values import rows_in, table_in, whole

MOST_READ = 60
"""So many of a player's newest battles are read (our choice: five hundred turns, and a fraction of a second)."""

MOST_POINTS = 100.0
"""Of a turn."""


def expected_of(whose: StudentHistory, virtual: bool = False) -> Expectation:
    """What is expected of a player, by the battles of everybody in which they have played.

    What `virtual` players have done under a name tells of them alone, and of no person. A document that cannot be read
    tells nothing, nor does a battle in which no stroke of theirs was heard.
    """
    answers: list[Earlier] = []
    points: list[float] = []
    name = whose.student
    documents = whose.ask(lambda history, _: history.every_document(BATTLE_NAME, MOST_READ)) or []
    for body in reversed(documents):
        with suppress(ValueError, TypeError, KeyError, AttributeError, RecursionError):
            document = table_in(json.loads(body))
            if not _has_played(document, name, virtual):
                continue
            turns = list(_turns(document, name))
            answers += [turn for turn in turns if isinstance(turn, Earlier)]
            points += [turn for turn in turns if isinstance(turn, float)]
    return expectation(answers, points)


def after_earlier(rules: BattleRules, settings: Settings, has_handicap: bool, virtual: bool = False) -> BattleRules:
    """The rules as the players' earlier battles ask: what is expected of each for a handicap, else the first step.

    A first step that `rules` have stays, and `virtual` players begin at their level's, so that their battle is the same
    for the same seed. Else it is the lowest of the players' own, so that nobody is out before a phrase comes that they
    can play.
    """
    expected = [expected_of(StudentHistory(settings, player.name), virtual) for player in rules.players]
    if has_handicap and not rules.is_solo:
        return replace(rules, expectations=tuple(expected))
    if virtual or rules.first_step is not None or rules.mode is not BattleMode.REPEAT:
        return rules
    return replace(rules, first_step=min(rules.staircase.next_step(one.answered) for one in expected))


def _has_played(document: dict[str, object], name: str, virtual: bool) -> bool:
    """Whether strokes of the player were heard, and a virtual player's only where such are asked for."""
    scores = map(table_in, rows_in(document["scores"]))
    devices = [score["device"] for score in scores if score["name"] == name and score["drummer"] is False]
    return any(isinstance(device, str) and is_virtual(device) is virtual for device in devices)


def _turns(document: dict[str, object], name: str) -> Iterator[Earlier | float]:
    """A player's turns: answers to what was to be repeated, and the points of improvised ones.

    A phrase was of their own step where they played alone, the final apart, or with a handicap.
    """
    rules = table_in(document["rules"])
    is_fair = bool(rows_in(rules["expectations"]))
    is_alone = len(rows_in(rules["players"])) == 1
    for kept in rows_in(document["rounds"]):
        each = table_in(kept)
        for turn in map(table_in, rows_in(each["turns"])):
            marks = turn["marks"]
            if turn["kind"] != "answer" or turn["name"] != name or marks is None:
                continue
            points, step, won = table_in(marks)["points"], turn["step"], turn["won"]
            if points is None:
                continue
            if step is None:
                yield _points(points)
            elif isinstance(won, bool):
                is_own = is_fair or (is_alone and each["final"] is not True)
                yield Earlier(min(max(whole(step), 0), MOST_STEP), won, _points(points), is_own)


def _points(value: object) -> float:
    points = float(str(value))
    if not 0 <= points <= MOST_POINTS:  # also refuses NaN
        raise ValueError
    return points
