"""What the board says of one's own bars: at 100 beats a minute in 4/4 a bar lasts 2.4 s, by hand."""

import pytest

from station.app.battle.board_words import headline
from station.cli.battling.battle_terminal import how_it_counts
from station.core.units import NS_PER_MS
from station.practice.battle.battle import Battle
from station.practice.battle.battle_rules import BattleMode, BattleRules
from station.practice.battle.drummed import drummed
from station.practice.battle.ground import Ground
from tests.fakes.played_battle import ZERO_NS, PlayedBattle, nothing, quarters

BAR_MS = 2400


def said(mode: BattleMode, bars: int, bar: float) -> str:
    """The headline `bar` bars after a solo answer's downbeat, which follows a count-in and a call."""
    rules = BattleRules(Ground(100.0), mode, bars=bars, rounds=1, has_final=False)
    battle = Battle(rules, drummed if mode is BattleMode.IMPROVISE else quarters)
    at_ns = ZERO_NS + round((1 + bars + bar) * BAR_MS * NS_PER_MS)
    return headline(PlayedBattle(battle, nothing).until(at_ns).battle.view())


@pytest.mark.parametrize(
    ("bars", "bar", "asked"),
    [
        (2, 0.5, "Your turn: the bars are yours"),
        (2, 0.9, "Your turn: the bars are yours"),
        (2, 1.1, "Your turn: land on one"),
        (2, 1.9, "Your turn: land on one"),
        (1, 0.3, "Your turn: the bars are yours"),
        (1, 0.6, "Your turn: land on one"),
    ],
)
def test_the_last_bar_asks_for_the_stroke_after_it(bars: int, bar: float, asked: str) -> None:
    assert said(BattleMode.IMPROVISE, bars, bar) == asked


def test_nothing_is_asked_after_a_phrase_that_is_repeated() -> None:
    assert said(BattleMode.REPEAT, 1, 0.9) == "Your turn: play it back"


def test_the_terminal_says_so_before_it_begins() -> None:
    assert "Land on one" in how_it_counts(BattleRules(Ground(100.0), BattleMode.IMPROVISE))
    assert "Land on one" not in how_it_counts(BattleRules(Ground(100.0)))
