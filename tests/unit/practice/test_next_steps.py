"""What is offered after a result: the same as its words, the best first. Tempi by hand from mastery's rungs."""

from dataclasses import replace
from datetime import date

import pytest

from station.core.settings import Settings
from station.drills.lesson import Goals, Lesson
from station.drills.library import find_lesson
from station.drills.mastery.agenda import Turn
from station.drills.mastery.pass_measures.pass_facts import PassResult
from station.drills.mastery.practice_steps import item_of
from station.practice.headless.virtual_session import practise_adaptively, practise_virtually
from station.practice.records.report.mastery_report import with_mastery
from station.practice.records.report.next_steps import (
    MOST,
    NextStep,
    StepKind,
    block_step,
    next_steps,
    steps_in,
    with_block,
)
from station.practice.records.report.session_report import practice_document
from station.practice.records.report.what_next import what_next
from station.practice.session.adaptation import Adaptation
from station.practice.session.plan import Plan, PlanOptions, plan_practice
from station.scoring.matching.hit_windows import Level
from station.scoring.report.assessment_document import Json
from station.simulation.student_spec import parse_spec

TODAY = date(2026, 3, 2)
ROCK_2 = Turn(item_of(find_lesson("rock-2")), "it comes next in First grooves")


def lesson(target_bpm: float = 100.0, **other: float) -> Lesson:
    return replace(find_lesson("rock-1"), goals=replace(Goals(target_tempo_bpm=target_bpm), **other))  # type: ignore[arg-type]


def plan(tempo_bpm: float, bars: tuple[int, int] | None = None, **other: float) -> Plan:
    return plan_practice(lesson(**other), PlanOptions(tempo_bpm, bars=bars, demonstrations=0, level=Level.INTERMEDIATE))


def document(hits: int = 100, advice: list[Json] | None = None) -> dict[str, Json]:
    return {"counts": {"notes": 100, "hits": hits}, "advice": advice or []}


def remark(bars: list[Json] | None, tempo_bpm: float) -> dict[str, Json]:
    return {
        "fault": "late_kick",
        "text": "You rush: your kick is 20 ms early: play it with the click alone at 68 bpm, then add the rest.",
        "bars": bars,
        "drill": {"bars": bars, "tempo_bpm": tempo_bpm, "pieces": ["kick"]},
    }


def measured(right: int = 100, **other: float) -> PassResult:
    return replace(PassResult(100, right, sd_ms=10.0, lean_ms=0.0, interval_ms=375.0, points=90.0), **other)  # type: ignore[arg-type]


def labels(steps: tuple[NextStep, ...]) -> list[str]:
    return [step.label for step in steps]


@pytest.mark.parametrize(
    ("tempo_bpm", "first"),
    [
        (70.0, "Raise the tempo: 75 bpm"),  # a rung is 5 % of the target
        (72.0, "Raise the tempo: 77 bpm"),
        (97.0, "Raise the tempo: 100 bpm"),  # the ladder ends at the target
        (100.0, "Next: Rock 2"),
        (120.0, "Next: Rock 2"),
    ],
)
def test_where_nothing_stood_out_it_goes_up_a_rung_or_on(tempo_bpm: float, first: str) -> None:
    steps = next_steps(document(), plan(tempo_bpm), measured(), ROCK_2)
    assert labels(steps)[0] == first
    assert "Once more" in labels(steps)
    assert "Next: Rock 2" in labels(steps)


def test_at_the_target_without_another_lesson_the_tempo_goes_on_rising() -> None:
    assert labels(next_steps(document(), plan(100.0), measured())) == ["Raise the tempo: 105 bpm", "Once more"]


def test_what_was_advised_comes_first_with_its_bars_and_tempo() -> None:
    advice: list[Json] = [remark([2, 3], 68.0), remark(None, 68.0)]
    steps = next_steps(document(advice=advice), plan(80.0), measured(), ROCK_2)
    assert labels(steps) == ["Bars 2–3 at 68 bpm", "Slower: 68 bpm", "Once more", "Next: Rock 2"]
    assert (steps[0].bars, steps[0].tempo_bpm) == ((2, 3), 68.0)
    assert steps[0].why == "You rush: your kick is 20 ms early"


def test_what_is_practised_at_the_tempo_itself_is_played_once_more() -> None:
    (first, _) = next_steps(document(advice=[remark(None, 80.0)]), plan(80.0), measured(), ROCK_2)
    assert (first.kind, first.why) == (StepKind.AGAIN, "You rush: your kick is 20 ms early")


@pytest.mark.parametrize(
    ("made", "expected"),
    [
        (measured(89), ["Once more", "Slower: 72 bpm"]),  # again at this tempo, or slower: a rung down is 8 %
        (measured(sd_ms=60.0), ["Once more", "Slower: 72 bpm"]),
        (measured(wrong_pads=9), ["Slower: 72 bpm", "Once more"]),
    ],
)
def test_a_goal_that_was_missed_asks_for_what_its_sentence_says(made: PassResult, expected: list[str]) -> None:
    assert labels(next_steps(document(), plan(80.0), made)) == expected


def test_bars_that_hold_lead_back_to_all_of_them() -> None:
    steps = next_steps(document(), plan(80.0, bars=(2, 2)), measured())
    assert labels(steps) == ["Raise the tempo: 85 bpm", "All bars at 80 bpm", "Once more"]


def test_at_the_fastest_tempo_there_is_none_faster() -> None:
    """No session is faster than 400 a minute; the step was offered as "Slower: 400 bpm"."""
    assert labels(next_steps(document(), plan(400.0), measured())) == ["Once more"]


@pytest.mark.parametrize(("tempo_bpm", "bpm"), [(399.0, 266), (20.0, 14)])
def test_a_step_is_a_tempo_that_can_be_practised(tempo_bpm: float, bpm: int) -> None:
    """In dotted quarters 400 and 20 quarters a minute are 266⅔ and 13⅓: a whole beat within them is 266 and 14."""
    dotted = find_lesson("reading-six-eight")
    laid = plan_practice(dotted, PlanOptions(tempo_bpm, demonstrations=0))
    wanted = 1000.0 if tempo_bpm > 100.0 else 1.0
    (first, *_) = next_steps(document(advice=[remark([1, 1], wanted)]), laid, measured())
    assert first.tempo_bpm == bpm * 1.5
    plan_practice(dotted, PlanOptions(first.tempo_bpm, bars=first.bars, demonstrations=0))


def test_who_stopped_early_or_was_not_heard_plays_once_more() -> None:
    assert labels(next_steps(document(), plan(80.0), measured(), is_whole=False)) == ["Once more"]
    assert labels(next_steps(document(hits=0), plan(80.0), measured(), ROCK_2)) == ["Once more"]


def test_a_block_of_the_day_leads_to_the_next_one() -> None:
    steps = with_block(
        next_steps(document(), plan(80.0), measured(), ROCK_2), block_step(2, "Rock 5: more", "it is new")
    )
    assert labels(steps) == ["Next block: Rock 5", "Raise the tempo: 85 bpm", "Once more"]
    assert steps[0].place == 2


@pytest.mark.parametrize("tempo_bpm", [80.0, 110.0])
@pytest.mark.parametrize(
    "spec", ["pro,seed=1", "beginner,seed=3", "intermediate,seed=2,fault=late_kick:40", "miss_pct=100"]
)
def test_words_and_buttons_are_of_one_answer(spec: str, tempo_bpm: float) -> None:
    """The tempo on the first button stands in the first sentence, and the report gives back what it holds."""
    laid = plan(tempo_bpm, target_bpm=110.0)
    result = practise_virtually(laid, parse_spec(spec)).result
    made = practice_document(result, Settings(), following=ROCK_2)
    steps, session = steps_in(made), made["session"]
    assert isinstance(session, dict)
    said = session["next"]
    assert isinstance(said, list)
    assert 1 <= len(steps) <= MOST
    if steps[0].tempo_bpm is not None:
        assert f"{steps[0].tempo_bpm:.0f} bpm" in str(said[0]) or "slower" in str(said[0])
    if steps[0].kind is StepKind.LESSON:
        assert "Rock 2" in str(said[0])


def test_the_sentence_names_the_lesson_to_turn_to() -> None:
    laid = plan(100.0)
    first = next_steps(document(), laid, measured(), ROCK_2)[0]
    assert what_next(document(), laid, measured(), first) == ("Nothing stands out: take the next lesson, Rock 2.",)


def followed(turn: Turn | None, spec: str = "pro,seed=1") -> dict[str, Json]:
    adaptation = Adaptation(find_lesson("rock-1"), PlanOptions(loops=3, demonstrations=0), TODAY)
    virtual = practise_adaptively(adaptation, parse_spec(spec))
    return with_mastery(practice_document(virtual.result, Settings()), adaptation, turn, ROCK_2)


def test_passes_that_follow_the_student_go_on_where_they_were() -> None:
    """Two clean passes lead from 70 % to 75 % of 110."""
    made = followed(None)
    session = made["session"]
    assert isinstance(session, dict)
    assert labels(steps_in(made)) == ["Go on at 82 bpm", "Next: Rock 2"]
    assert isinstance(session["next"], list)
    assert "Go on at 82 bpm." in str(session["next"][0])


def test_where_the_agenda_turns_away_the_other_lesson_comes_first() -> None:
    made = followed(Turn(item_of(find_lesson("rock-3")), "it is due for review"))
    session = made["session"]
    assert isinstance(session, dict)
    assert labels(steps_in(made))[:2] == ["Next: Rock 3", "Go on at 82 bpm"]
    assert isinstance(session["next"], list)
    assert session["next"][0] == "Next: Rock 3: it is due for review."
