"""The kit of a take has a drum for each tom that is written."""

import pytest

from station.core.pieces import Piece
from station.drills.library import find_lesson
from station.motion.sticking.hand_notes import Hands
from station.practice.session.plan import PlanOptions, plan_practice
from station.scenes.report.take_kit import take_kit


@pytest.mark.parametrize("hands", Hands)
def test_each_written_tom_is_a_drum_of_its_own(hands: Hands) -> None:
    """rock-fill-1 goes around a high, a middle and a floor tom; the hi-hat stands where the plan's does."""
    plan = plan_practice(find_lesson("rock-fill-1"), PlanOptions(loops=1, demonstrations=0, hands=hands))
    kit = take_kit(plan)
    toms = (Piece.TOM_1, Piece.TOM_2, Piece.FLOOR_TOM_1)
    assert [kit.stand_in(tom) for tom in toms] == list(toms)
    assert kit.left_handed == plan.kit.left_handed
    sides = [each.pieces[Piece.HIHAT].centre_m[0] < 0 for each in (kit, plan.kit)]
    assert sides[0] == sides[1]


def test_a_kit_that_has_all_or_was_chosen_stays() -> None:
    for name, stands in (("rock-1", ""), ("rock-fill-1", "jazz")):
        plan = plan_practice(find_lesson(name), PlanOptions(loops=1, demonstrations=0, stands=stands))
        assert take_kit(plan) is plan.kit
