"""docs/battle.md tells the leaves of the choice as the window has them."""

from pathlib import Path

import pytest

from station.app.battle.battle_choice import battle_choice
from station.app.battle.battle_shown import BattleShown, BattleStage
from station.app.settings.chosen_battle import ChosenBattle
from station.practice.battle.battle_rules import BattleMode

PAGE = Path(__file__).parents[4] / "docs" / "battle.md"


@pytest.mark.parametrize(("mode", "column"), [(BattleMode.REPEAT, 2), (BattleMode.IMPROVISE, 3)])
def test_the_page_tells_the_leaves(mode: BattleMode, column: int) -> None:
    rows = [[cell.strip() for cell in line.split("|")] for line in PAGE.read_text().splitlines() if line[:1] == "|"]
    told = [row[column] for row in rows if row[1].isdigit() and row[column]]
    shown = BattleShown(BattleStage.CHOOSING, ChosenBattle(mode))
    choices = [battle_choice(shown, leaf, (), False) for leaf in range(len(told))]
    leaves = [[option.label for option in choice.options] for choice in choices if choice is not None]
    assert [", ".join(label.partition(":")[0] for label in leaf[1:-1]) for leaf in leaves] == told
    assert {leaf[0] for leaf in leaves} == {"Begin"}
    assert {leaf[-1] for leaf in leaves} == {"More"}
    last = choices[-1]
    assert last is not None
    assert last.options[-1].why == f"Leaf {len(told)} of {len(told)}"
