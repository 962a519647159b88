"""What pads, keys and the mouse may choose of a battle: a few large options a leaf, the first always to play."""

from collections.abc import Collection
from dataclasses import replace

from station.app.actions.action import Action
from station.app.actions.battle_actions import (
    BeginBattle,
    ChooseBattle,
    CloseBattle,
    FilmBattle,
    JudgeBattle,
    PractiseFailed,
    ReplayBest,
    TurnLeaf,
)
from station.app.battle.battle_shown import BattleResultShown, BattleShown, BattleStage
from station.app.sessions.screen_choice import Option, ScreenChoice
from station.app.settings.chosen_battle import ChosenBattle
from station.app.settings.setup_lines import lines_of, stepped
from station.core.pieces import Piece
from station.practice.control.pad_choice import pads_for
from station.scoring.matching.hit_windows import Level

_A_LEAF = 2
"""Options of a leaf beside the one that plays and the one that turns it: four are read at a glance (decision 68)."""
_Made = tuple[str, Action, str]
"""Label, action, why."""


def battle_choice(shown: BattleShown, leaf: int, there: Collection[Piece], kit_starts: bool) -> ScreenChoice | None:
    """What is to be chosen now on the leaf of that number, by the pads `there`; None while somebody plays."""
    if shown.stage is BattleStage.CHOOSING:
        if shown.friend.waits:
            return None
        begins = (_begin_label(shown.setup), BeginBattle(), shown.fault or begin_words(shown.setup))
        rest = [*_hosts(shown), *_settings(shown.setup)]
    elif shown.stage is BattleStage.OVER and shown.result is not None:
        begins = ("Again", BeginBattle(), begin_words(shown.setup))
        rest = _ways_on(shown.result, shown.replays)
    else:
        return None
    made = [begins, *_on_leaf(rest, leaf)]
    pads = pads_for(len(made), there if kit_starts else ())
    options = (Option(label, action, why, pad) for (label, action, why), pad in zip(made, pads, strict=True))
    return ScreenChoice(tuple(options), kicks=kit_starts)


def begin_words(setup: ChosenBattle) -> str:
    """What begins, in a line."""
    if setup.is_guest:
        return f"The battle that is hosted at {setup.address}"
    whom = setup.people.words if setup.people.needs_friend else f"against {setup.drummer.title.lower()}"
    return f"{setup.mode.value.capitalize()}, {whom}, {setup.ground.beats_a_minute:.0f} bpm"


def _begin_label(setup: ChosenBattle) -> str:
    if setup.is_linked:
        return "Join" if setup.joins else "Host"
    return "Begin"


def _hosts(shown: BattleShown) -> list[_Made]:
    """The hosts that a guest may choose, but for the one that is chosen."""
    hosts = [one for one in shown.friend.hosts if not one.is_busy and one.address != shown.setup.address]
    return [(one.title, ChooseBattle(replace(shown.setup, address=one.address)), one.words) for one in hosts]


def _on_leaf(rest: list[_Made], leaf: int) -> list[_Made]:
    """Those of one leaf, and what turns it where there are more."""
    if len(rest) <= _A_LEAF + 1:
        return rest
    leaves = -(-len(rest) // _A_LEAF)
    first = leaf % leaves * _A_LEAF
    more = ("More", TurnLeaf(), f"Leaf {leaf % leaves + 1} of {leaves}")
    return [*rest[first : first + _A_LEAF], more]


def _settings(setup: ChosenBattle) -> list[_Made]:
    """Each line of the setup, to be turned a step on."""
    made: list[_Made] = []
    for line in lines_of(setup):
        turned = line.turned(setup, 1)
        label = f"{line.title}: {line.words(setup)}"
        made.append((label, ChooseBattle(turned), f"Then: {line.words(turned)}"))
    return made


def _ways_on(result: BattleResultShown, replays: bool) -> list[_Made]:
    """What may follow a battle, the likeliest first."""
    made: list[_Made] = []
    if result.best:
        made.append(("Back to the result" if replays else "See the best bar", ReplayBest(), result.best))
    if result.failed:
        made.append(("Practise it", PractiseFailed(), result.failed))
    if result.folder and result.films:
        made.append(("Keep a video", FilmBattle(), "Both drummers on the stage, filmed while you go on"))
    made.append(("Another battle", CloseBattle(), "Choose who, what and how"))
    if result.judged_as is not None:
        level = stepped(tuple(Level), result.judged_as, 1)
        made.append((f"Judge it as {level.value}", JudgeBattle(level), f"It was judged as {result.judged_as.words}"))
    return made
