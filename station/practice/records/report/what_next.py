"""What a student should do next: the advice, or where nothing stands out what the lesson's goals ask for.

Pure: an assessment document, what was measured and what was practised in, sentences out. Tempi are in quarter notes a
minute.
"""

from collections.abc import Iterable, Iterator
from dataclasses import replace
from math import ceil, floor

from station.core.units import PPQ
from station.drills.mastery.goals_missed import Miss, missed_goals
from station.drills.mastery.pass_measures.pass_facts import PassResult, PassView, measure_pass
from station.drills.mastery.rules import Rules
from station.engine.engine import KEYBOARD
from station.practice.records.report.next_steps import SAME_TEMPO, NextStep, StepKind, next_steps, title_of
from station.practice.records.report.said_already import says_so
from station.practice.session.plan import Plan
from station.practice.session.session import SessionResult
from station.scoring.report.assessment_document import Json

MOST_STEPS = 3
"""So many sentences on what to do next (part of every report): what limbs and bars miss comes after the advice."""
_NOTHING_PLAYED = "There was nothing to judge: the session ended before the first note."
_NOTHING_HEARD = (
    "Not one hit was heard: is the kit switched on and connected? `station doctor` says what is found;"
    " in the window the computer's keys play, too (F1 shows them)."
)


def measured_session(result: SessionResult, score: Json) -> PassResult:
    """All passes of a session as one, as the mastery policy measures a pass; its points are the report's `score`."""
    plan = result.plan
    view = PassView(plan.level.windows, _rules(plan).asked, result.device != KEYBOARD)
    measured = measure_pass(result.score, result.performance, result.alignment, plan.practised_bars, view)
    return replace(measured, points=score if isinstance(score, float) else None)


def _rules(plan: Plan) -> Rules:
    return Rules().for_lesson(plan.lesson, plan.level)


def what_next(
    document: dict[str, Json], plan: Plan, measured: PassResult, first: NextStep | None = None
) -> tuple[str, ...]:
    """At least one sentence for whoever practised `plan`; `document` is the assessment, `measured` all passes.

    `first` is the step that is offered first (`next_steps`), by default that of who has no other lesson to turn to.
    """
    counts = table_in(document, "counts")
    if not counts["notes"]:
        return (_NOTHING_PLAYED,)
    if not counts["hits"]:
        return (_NOTHING_HEARD,)
    missed = missed_goals(measured, _rules(plan))
    if advice := advice_of(document):
        return (*advice, *_besides(document, missed))[:MOST_STEPS]
    first = first or next_steps(document, plan, measured)[0]
    return (missed[0].sentence if missed else _go_on(plan, measured, first),)


def _besides(document: dict[str, Json], missed: Iterable[Miss]) -> Iterator[str]:
    """What limbs and bars miss and the advice has not said already."""
    said = list(_advice_rows(document))
    for miss in missed:
        if miss.part is not None and not any(says_so(one, miss) for one in said):
            yield miss.sentence


def missed_document(plan: Plan, measured: PassResult) -> list[Json]:
    """Every goal that was not reached, in the order in which sentences take them."""
    return [_missed(miss) for miss in missed_goals(measured, _rules(plan))]


def _missed(miss: Miss) -> Json:
    return {
        "goal": miss.fault.value,
        "part": None if miss.part is None else miss.part.name,
        "value": round(miss.value, 3),
        "limit": round(miss.limit, 3),
        "text": miss.sentence,
    }


def advice_of(document: dict[str, Json]) -> tuple[str, ...]:
    """The sentences of the assessment's advice, each with the hint of the lesson's author."""
    return tuple(_with_hint(item) for item in _advice_rows(document))


def _advice_rows(document: dict[str, Json]) -> Iterator[dict[str, Json]]:
    advice = document["advice"]
    assert isinstance(advice, list), "the report is ours"
    return (item for item in advice if isinstance(item, dict))


def _with_hint(advice: dict[str, Json]) -> str:
    return f"{advice['text']} {advice['hint']}" if advice.get("hint") else str(advice["text"])


def _go_on(plan: Plan, measured: PassResult, first: NextStep) -> str:
    rules, spread_ms = _rules(plan), measured.sd_ms or 0.0
    limit_ms = rules.sd_limit_ms(measured.interval_ms)
    why = f" (a spread of {ceil(spread_ms)} ms is within the {floor(limit_ms)} of a clean pass)"
    reason = why if spread_ms > rules.sd_floor_ms else ""  # who lies closer together does not ask
    return f"Nothing stands out{reason}: {_onwards(plan, first)}."


def _onwards(plan: Plan, first: NextStep) -> str:
    """The first step in the middle of a sentence."""
    if first.kind is StepKind.LESSON:
        return f"take the next lesson, {title_of(first.lesson)}"
    if first.kind is StepKind.TEMPO and first.tempo_bpm is not None:
        has_arrived = plan.tempo_bpm >= plan.lesson.target_tempo_bpm * (1 - SAME_TEMPO)
        beats = f"raise the tempo to {first.tempo_bpm * PPQ / plan.lesson.beat_ticks:.0f} bpm"
        return f"take the next lesson, or {beats}" if has_arrived else beats
    return first.why or "once more"


def table_in(of: dict[str, Json], key: str) -> dict[str, Json]:
    """The table under `key` of a report, which has one there."""
    table = of[key]
    assert isinstance(table, dict), "the report is ours"
    return table
