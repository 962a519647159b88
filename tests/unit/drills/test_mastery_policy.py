"""The mastery policy against sequences worked out by hand from its rules (TEACHING, Defaults).

Start at 70 %, two clean passes +5, one bad holds, two bad −8; every fifth pass blind; four rungs up, the target once.
"""

from dataclasses import replace
from datetime import timedelta

import pytest

from station.core.pieces import Piece
from station.drills.mastery.feedback_fading import Feedback
from station.drills.mastery.next_pass import begin, fix_tempo, new_item, next_step, veto
from station.drills.mastery.pass_measures.pass_facts import PassResult, StruckFor
from station.drills.mastery.practice_steps import PassKind
from station.drills.mastery.rules import DEFAULT_RULES, Rules
from tests.unit.drills.mastering import (
    BAD,
    BROKEN,
    CLEAN,
    DAY,
    ITEM,
    LOOSE,
    asked,
    played,
    result,
    weak_second_bar,
)

NO_PROBES = Rules(passes_a_probe=1000, rungs_a_target_probe=1000)
WEAK = weak_second_bar()

TABLE = {
    "two clean, a rung up": ([CLEAN, CLEAN], [70, 70, 75]),
    "one bad holds": ([CLEAN, BAD, CLEAN, CLEAN], [70, 70, 70, 70, 75]),
    "two bad, down": ([BAD, BAD], [70, 70, 62]),
    "a clean one between forgives": ([BAD, CLEAN, BAD, CLEAN], [70, 70, 70, 70, 70]),
    "down and up again": ([BAD, BAD, CLEAN, CLEAN, CLEAN, CLEAN], [70, 70, 62, 62, 67, 67, 72]),
    "not below the floor": ([BAD] * 8, [70, 70, 62, 62, 54, 54, 46, 46, 40]),
    "broken, down at once and twice as far": ([BROKEN, BROKEN], [70, 54, 40]),
    "loose climbs": ([LOOSE, LOOSE], [70, 70, 75]),
    "six rungs to the target, and no further": (
        [CLEAN] * 14,
        [70, 70, 75, 75, 80, 80, 85, 85, 90, 90, 95, 95] + [100] * 3,
    ),
}


@pytest.mark.parametrize("name", TABLE)
def test_the_ladder(name: str) -> None:
    passes, expected = TABLE[name]
    assert [pct for _, pct in asked(passes, NO_PROBES)] == expected


def test_who_plays_all_clean_is_stable_after_fourteen_passes() -> None:
    """70 70 75 75, blind at 80, 80 85 85, target; four at the target, blind once more; then variations."""
    whole = [("whole", pct) for pct in (70, 70, 75, 75, 80, 85, 85)]
    climb = [*whole[:4], ("probe", 80), *whole[4:], ("target_probe", 100)]
    top = [("whole", 100)] * 4 + [("probe", 100)]
    varied = [("variation", 110), ("variation", 90), ("whole", 100), ("variation", 110), ("probe", 100)]
    assert asked([CLEAN] * 18) == climb + top + varied
    assert not played([CLEAN] * 13).is_stable(DEFAULT_RULES)
    assert played([CLEAN] * 14).is_stable(DEFAULT_RULES)


def test_a_failed_try_of_the_target_costs_nothing() -> None:
    """At 90 % the target is tried; it fails twice over, and the ladder goes on at 90 with its counting begun anew."""
    steps = asked([*[CLEAN] * 8, BROKEN, CLEAN, CLEAN])
    assert steps[8:] == [("target_probe", 100), ("whole", 90), ("whole", 90), ("whole", 95)]


def test_feedback_fades_as_clean_passes_add_up() -> None:
    """All of 4 passes, then every second (2 of 4), then every fourth; probes (passes 5, 9 and 14) are blind."""
    state = new_item(ITEM, DAY)
    said = []
    for _ in range(14):
        said.append(state.step.feedback.value[0])
        state, _ = next_step(state, CLEAN)
    assert "".join(said) == "tttt" + "n" + "ptp" + "n" + "t" + "ppp" + "n"


def test_only_probes_move_mastery() -> None:
    assert played([CLEAN] * 4).mastery_pct == 0.0
    assert played([CLEAN] * 5).mastery_pct == 80.0
    assert played([CLEAN] * 9).mastery_pct == 100.0


def test_a_failed_probe_takes_mastery_down_a_step() -> None:
    """Blind at 80, then three bad passes of four hold the tempo, and the next probe fails there: 80 − 8."""
    passes = [*[CLEAN] * 5, BAD, CLEAN, BAD, CLEAN]
    assert played(passes).step.kind is PassKind.PROBE
    assert played([*passes, BAD]).mastery_pct == 72.0


# --- weak bars --------------------------------------------------------------------------------------------------------


def test_a_weak_bar_is_practised_alone_and_the_whole_comes_back() -> None:
    """Two bad passes: the bar at 62 %, twice a pass, until it is clean twice."""
    state = played([WEAK, WEAK], NO_PROBES)
    assert (state.step.kind, state.step.pct, state.step.bars, state.step.repeats) == (PassKind.CHUNK, 62.0, (1, 1), 2)
    assert state.step.bar_names == (1, 1)
    state = played([result(20, 20), result(20, 20)], NO_PROBES, state)
    assert (state.step.kind, state.step.pct, state.step.bars) == (PassKind.WHOLE, 62.0, (0, 3))


def test_a_weak_bar_climbs_back_to_where_it_was_taken_out() -> None:
    """Twice bad at 62: 54; clean twice: 59, twice: 64, which is enough; twice: back to the whole at 64."""
    chunk = [result(17, 20), result(17, 20), *[result(20, 20)] * 6]
    steps = asked([WEAK, WEAK, *chunk], NO_PROBES)
    assert steps[2:] == [("chunk", pct) for pct in (62, 62, 54, 54, 59, 59, 64, 64)] + [("whole", 64)]


def test_a_weak_bar_is_left_after_eight_passes() -> None:
    mixed = [result(20, 20), result(17, 20)] * 4
    steps = asked([WEAK, WEAK, *mixed], NO_PROBES)
    assert [kind for kind, _ in steps[2:]] == ["chunk"] * 8 + ["whole"]


def test_mistakes_everywhere_are_no_weak_bar() -> None:
    assert played([BAD, BAD], NO_PROBES).chunk is None


# --- leaving, the student's own will ----------------------------------------------------------------------------------


def test_a_plateau_is_left_after_five_runs() -> None:
    """Clean and bad in turn never climb. The fifth pass, blind and clean, was the last step forward; 40 follow."""
    passes = [CLEAN, BAD] * 23
    assert [kind for kind, _ in asked(passes)].index("leave") == 45


def test_breaking_down_at_the_floor_is_left_after_five_passes() -> None:
    """Two passes lead to 40 %, where five more break down."""
    assert [kind for kind, _ in asked([BROKEN] * 7, NO_PROBES)].index("leave") == 7


def test_who_plays_on_after_the_plateau_is_not_sent_away_again() -> None:
    state = played([CLEAN, BAD] * 22 + [CLEAN])
    assert state.step.kind is PassKind.LEAVE
    state, step = next_step(state, CLEAN)
    assert step.kind is not PassKind.LEAVE


def test_a_veto_keeps_the_tempo_and_starts_the_counting_anew() -> None:
    state = played([CLEAN, CLEAN], NO_PROBES)
    state, step = veto(state, NO_PROBES)
    assert (step.kind, step.pct) == (PassKind.WHOLE, 70.0)
    assert [
        one.pct for one in (played([CLEAN], NO_PROBES, state).step, played([CLEAN, CLEAN], NO_PROBES, state).step)
    ] == [
        70.0,
        75.0,
    ]


def test_a_veto_of_a_try_puts_it_off_by_four_rungs() -> None:
    state = played([CLEAN] * 8)
    assert state.step.kind is PassKind.TARGET_PROBE
    state, step = veto(state)
    assert (step.kind, step.pct) == (PassKind.WHOLE, 85.0)
    state, step = next_step(state, CLEAN)
    assert step.kind is not PassKind.TARGET_PROBE


def test_a_fixed_tempo_never_changes() -> None:
    """84 of 120 bpm are 70 %; probes stay, at that tempo: passes 5 and 10 show it, pass 15 no more (70 − 8)."""
    state, _ = fix_tempo(new_item(ITEM, DAY), 84.0)
    for one in [*[CLEAN] * 12, *[BAD] * 6, BROKEN]:
        state, step = next_step(state, one)
        assert step.tempo_bpm == pytest.approx(84.0)
    assert state.mastery_pct == pytest.approx(62.0)
    assert fix_tempo(state, None)[1].pct == pytest.approx(70.0)


def test_a_weak_bar_is_practised_alone_at_a_fixed_tempo_too() -> None:
    state, _ = fix_tempo(new_item(ITEM, DAY), 84.0)
    state = played([WEAK, WEAK], NO_PROBES, state)
    assert state.step.kind is PassKind.CHUNK
    assert state.step.tempo_bpm == pytest.approx(84.0)
    state = played([result(20, 20)] * 2, NO_PROBES, state)
    assert state.step.kind is PassKind.WHOLE
    assert state.step.tempo_bpm == pytest.approx(84.0)


# --- days -------------------------------------------------------------------------------------------------------------


def test_the_first_review_comes_on_the_day_after_mastering() -> None:
    state = played([CLEAN] * 14)
    assert begin(state, DAY).step.kind is not PassKind.REVIEW
    assert begin(state, DAY + timedelta(days=1)).step.kind is PassKind.REVIEW


def test_what_has_faded_is_learnt_again_from_a_step_below() -> None:
    state = begin(played([CLEAN] * 14), DAY + timedelta(days=1))
    assert (state.step.pct, state.step.feedback) == (100.0, Feedback.NONE)
    state, step = next_step(state, BAD)
    assert (step.kind, step.pct, state.mastery_pct, state.review.due) == (PassKind.WHOLE, 92.0, 92.0, None)


def test_another_day_starts_a_step_below_where_the_last_one_ended() -> None:
    """Five clean passes from 70: 80 % (its second pass pending), tomorrow 72; never below the first day's start."""
    assert begin(played([CLEAN] * 5), DAY + timedelta(days=1)).step.pct == 72.0
    assert begin(played([CLEAN] * 2), DAY + timedelta(days=1)).step.pct == 70.0


# --- what is not the student's fault ----------------------------------------------------------------------------------


def test_a_silent_pass_changes_nothing() -> None:
    state = played([CLEAN])
    after, step = next_step(state, PassResult(40, 0))
    assert after == state
    assert replace(step, why="") == replace(state.step, why="")


def test_a_latency_is_told_once_and_costs_no_tempo() -> None:
    late = replace(CLEAN, lean_ms=100.0)
    state, notices = new_item(ITEM, DAY), []
    for _ in range(5):
        state, step = next_step(state, late)
        notices.append(step.notice)
    assert [notice is not None for notice in notices] == [False, False, True, False, False]
    assert "100 ms late" in (notices[2] or "")
    assert state.step.pct == 80.0


def test_swapped_pads_are_told_and_the_pass_is_not_held_against_the_student() -> None:
    """Three strokes each a pass: after two passes there are six of both, and the tempo has not moved."""
    crossed = (StruckFor(Piece.TOM_1, Piece.TOM_2, 3), StruckFor(Piece.TOM_2, Piece.TOM_1, 3))
    mixed = replace(BAD, wrong_pads=6, answers=crossed)
    state, step = next_step(new_item(ITEM, DAY), mixed)
    assert step.notice is None
    state, step = next_step(state, mixed)
    assert step.notice is not None
    assert "High tom and middle tom" in step.notice
    assert step.pct == 70.0
    assert state.equipment.swap == (Piece.TOM_1, Piece.TOM_2)


def test_every_step_says_why_in_one_sentence() -> None:
    passes = [CLEAN] * 9 + [BAD, BAD, BROKEN, LOOSE, WEAK, WEAK, CLEAN, CLEAN]
    state = new_item(ITEM, DAY)
    for one in passes:
        assert state.step.why.endswith(".")
        assert ". " not in state.step.why
        state, _ = next_step(state, one)


def test_the_words_of_some_steps() -> None:
    assert played([CLEAN, CLEAN]).step.why == "Clean twice: up to 75 %, 90 bpm."
    assert played([BAD]).step.why == "34 of 40 right, 36 needed: once more at 70 %, 84 bpm."
    assert played([WEAK, WEAK]).step.why == "Bar 2 holds 10 of the last 10 mistakes: alone at 74 bpm."
