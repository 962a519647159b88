"""The mastery policy under any sequence of passes: it keeps its promises, whatever is played."""

import json
from datetime import date, timedelta

from hypothesis import given, settings
from hypothesis import strategies as st

from station.drills.mastery.feedback_fading import Feedback
from station.drills.mastery.mastery_json import document_of, state_from
from station.drills.mastery.mastery_state import ItemState
from station.drills.mastery.next_pass import begin, fix_tempo, new_item, next_step, veto
from station.drills.mastery.pass_measures.pass_facts import BarResult, PassResult
from station.drills.mastery.practice_steps import PassKind, PracticeItem, PracticeStep
from station.drills.mastery.rules import DEFAULT_RULES, Rules

DAY = date(2024, 3, 1)
ITEM = PracticeItem("any", 96.0, 2, (8, 12, 10), (2.5, 2.5, 2.5))


@st.composite
def passes(draw: st.DrawFn) -> PassResult:
    """Anything from silence to perfection, with faults in any bar."""
    bars = tuple(BarResult(2 + i, n, draw(st.integers(0, n))) for i, n in enumerate(ITEM.bar_notes))
    notes, right = sum(b.notes for b in bars), sum(b.right for b in bars)
    return PassResult(
        notes=notes,
        right=right,
        wrong_pads=draw(st.integers(0, notes - right)),
        extras=draw(st.sampled_from((0, 0, 1, 30))),
        sd_ms=draw(st.none() | st.floats(0, 120)),
        lean_ms=draw(st.none() | st.floats(-150, 150)),
        interval_ms=draw(st.sampled_from((None, 120.0, 250.0, 900.0))),
        bars=bars,
    )


def perfect() -> PassResult:
    bars = tuple(BarResult(2 + i, n, n) for i, n in enumerate(ITEM.bar_notes))
    return PassResult(30, 30, sd_ms=5.0, lean_ms=0.0, interval_ms=250.0, bars=bars)


MIXED = st.lists(st.one_of(passes(), st.just(perfect()), st.just(perfect())), max_size=60)
RULES = st.builds(
    Rules,
    start_pct=st.sampled_from((60.0, 70.0, 75.0, 100.0)),
    clean_to_climb=st.integers(1, 3),
    bad_to_drop=st.integers(1, 3),
    passes_a_probe=st.integers(2, 7),
    chunk_bars=st.integers(1, 3),
    chunk_passes=st.integers(1, 9),
    vary_pct=st.sampled_from((0.0, 10.0)),
    runs_to_leave=st.integers(1, 5),
)


def run(state: ItemState, results: list[PassResult], rules: Rules) -> list[PracticeStep]:
    steps = [state.step]
    for result in results:
        state, step = next_step(state, result, rules)
        steps.append(step)
    return steps


@given(MIXED, RULES)
def test_the_tempo_stays_between_floor_and_target(results: list[PassResult], rules: Rules) -> None:
    for step in run(new_item(ITEM, DAY, rules), results, rules):
        top = 100.0 + (rules.vary_pct if step.kind is PassKind.VARIATION else 0.0)
        assert rules.floor_pct <= step.pct <= top
        assert step.tempo_bpm == ITEM.bpm(step.pct)


@given(MIXED, RULES)
def test_every_step_can_be_played_and_says_why(results: list[PassResult], rules: Rules) -> None:
    for step in run(new_item(ITEM, DAY, rules), results, rules):
        assert 2 <= step.bars[0] <= step.bars[1] <= 4
        assert len(step.bar_names) >= rules.least_bars
        assert step.why.endswith(".")
        assert step.is_probe == (step.feedback is Feedback.NONE)


@given(MIXED, RULES)
def test_identical_inputs_give_identical_steps(results: list[PassResult], rules: Rules) -> None:
    assert run(new_item(ITEM, DAY, rules), results, rules) == run(new_item(ITEM, DAY, rules), results, rules)


@given(MIXED)
def test_the_ladder_moves_by_its_steps_alone(results: list[PassResult]) -> None:
    """From one pass of the whole to the next: up 5, down 8 or 16 (or to the floor or the top), or not at all."""
    state = new_item(ITEM, DAY)
    for result in results:
        before = state
        state, _ = next_step(state, result)
        if before.step.kind in (PassKind.WHOLE, PassKind.PROBE):
            moved = state.ladder.pct - before.ladder.pct
            assert moved in (0.0, 5.0, -8.0, -16.0) or state.ladder.pct in (40.0, 100.0)
            assert moved >= 0 or state.ladder.clean == state.ladder.bad == 0


@given(MIXED)
def test_only_probes_move_mastery(results: list[PassResult]) -> None:
    state = new_item(ITEM, DAY)
    for result in results:
        before = state
        state, _ = next_step(state, result)
        assert 0.0 <= state.mastery_pct <= 100.0
        assert before.step.is_probe or state.mastery_pct == before.mastery_pct


@given(MIXED)
def test_one_bad_pass_never_lowers_the_tempo(results: list[PassResult]) -> None:
    """Bad, not broken, after a clean one: the tempo of the whole stays."""
    bad = PassResult(30, 26, sd_ms=5.0, lean_ms=0.0, interval_ms=250.0)
    state = new_item(ITEM, DAY)
    for result in results:
        state, _ = next_step(state, result)
    state, _ = next_step(state, perfect())
    if state.step.kind is PassKind.WHOLE:
        assert next_step(state, bad)[0].ladder.pct == state.ladder.pct


@given(st.lists(passes(), max_size=30))
def test_a_perfect_student_gets_there_from_anywhere(results: list[PassResult]) -> None:
    """From the floor 12 rungs of two passes, as many probes between as there may be, and two at the target."""
    state = new_item(ITEM, DAY)
    for result in results:
        state, _ = next_step(state, result)
    for count in range(60):
        if state.is_stable(DEFAULT_RULES):
            assert count <= 50
            return
        state, _ = next_step(state, perfect())
    raise AssertionError("a perfect student was not believed")


@given(MIXED, st.floats(30, 130))
def test_a_pinned_tempo_is_kept(results: list[PassResult], tempo_bpm: float) -> None:
    state, _ = fix_tempo(new_item(ITEM, DAY), tempo_bpm)
    for result in results:
        state, step = next_step(state, result)
        assert abs(step.tempo_bpm - tempo_bpm) < 1e-9
    assert begin(state, DAY + timedelta(days=30)).step.tempo_bpm == state.step.tempo_bpm


@given(MIXED, RULES)
def test_a_veto_keeps_tempo_and_bars_of_the_last_pass_of_the_ladder(results: list[PassResult], rules: Rules) -> None:
    state = new_item(ITEM, DAY, rules)
    for result in results:
        before = state.step
        state, _ = next_step(state, result, rules)
        if before.kind in (PassKind.WHOLE, PassKind.CHUNK) and not result.is_silent:
            _, kept = veto(state, rules)
            assert (kept.pct, kept.bars) == (before.pct, before.bars)


@settings(max_examples=30)
@given(MIXED)
def test_any_state_survives_as_json(results: list[PassResult]) -> None:
    state = new_item(ITEM, DAY)
    for result in results:
        state, _ = next_step(state, result)
    assert state_from(json.loads(json.dumps(document_of(state))), "history") == state
