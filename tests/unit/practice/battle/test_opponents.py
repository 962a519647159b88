"""The table of the drummers whom one can battle."""

import pytest

from station.core.errors import BadInput
from station.drills.library import lesson_rows
from station.motion.kinematics.figure import figure_names
from station.motion.style.style import ANYBODY
from station.motion.style.style_file import load_style
from station.practice.battle.opponents.opponent import OPPONENTS, USUAL_OPPONENT, find_opponent


@pytest.mark.parametrize("name", OPPONENTS)
def test_an_opponent_moves_in_a_style_and_as_a_figure_that_ship(name: str) -> None:
    opponent = OPPONENTS[name]
    assert load_style(opponent.motion_style).name == opponent.motion_style
    assert opponent.figure in (*figure_names(), ANYBODY)


def test_every_word_of_a_vocabulary_is_a_tag_or_kind_of_lessons() -> None:
    known = {tag for row in lesson_rows() for tag in (*row.tags, row.folder.removesuffix("s"))}
    assert {tag for one in OPPONENTS.values() for tag in one.vocabulary} <= known


def test_the_usual_one_is_steady_and_only_the_newcomer_makes_mistakes() -> None:
    assert USUAL_OPPONENT == "steady"
    assert [name for name, one in OPPONENTS.items() if one.mistakes.dropped] == ["novice"]


def test_an_unknown_name_is_told_the_nearest() -> None:
    with pytest.raises(BadInput, match="mirror"):
        find_opponent("miror")
