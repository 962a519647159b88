"""The heat map of a session whose strokes are known."""

from dataclasses import replace

import pytest

from station.core.events import Hit
from station.core.pieces import Limb, Piece
from station.core.units import NS_PER_MS, NS_PER_S
from station.drills.library import find_lesson
from station.engine.messages import Started
from station.practice.session.plan import Plan, PlanOptions, plan_practice
from station.practice.session.session import Session
from station.scenes.heat_map import HeatCell, heat_map

LESSON = find_lesson("rock-2")


def played(plan: Plan, late_ms: dict[int, float], left_out: set[int]) -> Session:
    """Every note on time but those that are late or left out, by their index in the plan's score."""
    session = Session(plan)
    session.handle(Started(0))
    for i, note in enumerate(plan.score):
        if i not in left_out:
            at_ns = int(plan.score.onset_ns[i]) + plan.passes_start_ns + round(late_ms.get(i, 0.0) * NS_PER_MS)
            session.handle(Hit(at_ns, note.piece, note.zone, note.velocity))
    session.advance(plan.end_ns + 2 * NS_PER_S)
    return session


def test_missed_and_late_notes_are_wrong_in_their_bar_and_limb() -> None:
    plan = plan_practice(LESSON, PlanOptions(loops=2, demonstrations=0))
    score = plan.score
    kicks = [i for i, note in enumerate(score) if note.piece is Piece.KICK]
    in_bar_2 = [i for i in kicks if score.tempo_map.bars_at(score.notes["tick"][[i]])[0] == 1]
    heat = heat_map(played(plan, {in_bar_2[0]: 80.0}, {in_bar_2[1]}).result())
    assert heat.bars == [1, 2]
    assert heat.cells[2, Limb.RIGHT_FOOT] == HeatCell(2 * len(in_bar_2) - 2, 2 * len(in_bar_2))
    others = [cell for where, cell in heat.cells.items() if where != (2, Limb.RIGHT_FOOT)]
    assert [cell.share for cell in others] == [pytest.approx(1.0)] * len(others)
    assert sum(cell.notes for cell in heat.cells.values()) == len(score)


def test_bars_are_the_lesson_s_own() -> None:
    plan = plan_practice(LESSON, PlanOptions(loops=3, bars=(2, 2), demonstrations=0))
    assert heat_map(played(plan, {}, set()).result()).bars == [2]


def test_nothing_heard_of_the_score_is_an_empty_map() -> None:
    result = Session(plan_practice(LESSON, PlanOptions(loops=1, demonstrations=0))).result()
    assert heat_map(replace(result)).bars == []
