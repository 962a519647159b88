"""The passes of a session that followed the student, and what comes next; keys are added to the report."""

from station.drills.mastery.agenda import Turn
from station.drills.mastery.mastery_state import ItemState
from station.drills.mastery.practice_steps import PracticeItem, PracticeStep
from station.drills.mastery.rules import Rules
from station.practice.records.report.next_steps import NextStep, StepKind, followed_steps, steps_document
from station.practice.records.report.what_next import MOST_STEPS, advice_of
from station.practice.session.adaptation import Adaptation, PlayedPass, held_words
from station.scoring.report.assessment_document import Json


def with_mastery(
    document: dict[str, Json], adaptation: Adaptation, turn: Turn | None = None, other: Turn | None = None
) -> dict[str, Json]:
    """The report with every pass and its reason, the state of mastery, and what comes next: a step, then the advice.

    `turn` is what to practise next of all that the student knows, None where nothing is remembered; `other` another
    lesson that they may turn to.
    """
    session, state = document["session"], adaptation.state
    assert isinstance(session, dict), "the report is ours"
    counts, said = document["counts"], session["next"]
    assert isinstance(counts, dict), "the report is ours"
    assert isinstance(said, list), "the report is ours"
    plan = adaptation.rounds[0].result.plan if adaptation.rounds else adaptation.plan
    steps = followed_steps(document, plan, _on_from_here(adaptation), turn, other)
    lead = [f"{steps[0].label}: {steps[0].why}."] if steps[0].kind is StepKind.LESSON else []
    # what is said where nothing stands out speaks of the tempo, which is the policy's here
    grown = [held_words(adaptation.level, adaptation.next_level)] if adaptation.has_grown else []
    on_words = adaptation.step.why if lead else f"{adaptation.step.why} {steps[0].label}."
    said_next: list[Json] = [*lead, *grown, on_words, *advice_of(document)]
    return {
        **document,
        "session": {
            **session,
            "next": said_next[:MOST_STEPS] if counts["hits"] else said,
            "steps": steps_document(steps),
        },
        "mastery": {
            "target_tempo_bpm": round(state.item.target_bpm, 3),
            "mastery_pct": state.mastery_pct,
            "stable": state.is_stable(adaptation.rules),
            "review_due": None if state.review.due is None else state.review.due.isoformat(),
            "level": adaptation.level,
            "next_level": adaptation.next_level,
            "words": mastery_words(state, adaptation.rules),
            "passes": [_pass(one, state.item) for one in adaptation.rounds],
            "next": _step(adaptation.step, state.item),
            "turn": None if turn is None else _turn(turn),
        },
    }


def _on_from_here(adaptation: Adaptation) -> NextStep:
    """The same lesson from where it was."""
    step, item = adaptation.next_time, adaptation.state.item
    return NextStep(StepKind.AGAIN, f"Go on at {item.beats(step.pct)}", adaptation.step.why.rstrip("."))


def _turn(turn: Turn) -> dict[str, Json]:
    first, last = turn.item.bars
    return {"lesson": turn.item.name, "bars": [first + 1, last + 1], "why": turn.why}


def passes_text(mastery: dict[str, Json]) -> str:
    """The passes of the report's `mastery`, a line each with its reason, and where the student stands."""
    passes = mastery["passes"]
    assert isinstance(passes, list), "the report is ours"
    rows = [_pass_words(number, one) for number, one in enumerate(passes, 1) if isinstance(one, dict)]
    turn = mastery["turn"]
    then = [f"Next time {turn['lesson']}: {turn['why']}."] if isinstance(turn, dict) else []
    return "\n".join(["Passes", *rows, str(mastery["words"]), *then, ""])


def _pass_words(number: int, one: dict[str, Json]) -> str:
    bars = one["bars"]
    assert isinstance(bars, list), "the report is ours"
    which = f"bar {bars[0]}" if bars[0] == bars[1] else f"bars {bars[0]}-{bars[1]}"
    right = "stopped early" if one["right"] is None else f"{one['right']} of {one['notes']} right"
    return f"{number:3}  {one['beats_a_minute']:6g} bpm  {which:9} {right:16}  {one['why']}"


def _step(step: PracticeStep, item: PracticeItem) -> dict[str, Json]:
    return {
        "tempo_bpm": round(step.tempo_bpm, 3),
        "beats_a_minute": round(step.tempo_bpm / item.beat_quarters, 3),
        "bars": [step.bars[0] + 1, step.bars[1] + 1],
        "why": step.why,
    }


def _pass(one: PlayedPass, item: PracticeItem) -> dict[str, Json]:
    step, measured = one.step, one.measured
    return {
        **_step(step, item),
        "kind": step.kind.value,
        "feedback": step.feedback.value,
        "repeats": step.repeats,
        "notes": None if measured is None else measured.notes,
        "right": None if measured is None else measured.right,
        "sd_ms": None if measured is None or measured.sd_ms is None else round(measured.sd_ms, 1),
    }


def mastery_words(state: ItemState, rules: Rules) -> str:
    """Where a student stands, in one line."""
    if state.is_settled(rules):
        due, level = state.review.due, state.level if state.is_stable(rules) else state.review.level
        return f"Mastered at {level}{'' if due is None else f'; asked for again on {due:%d %B}'}."
    if state.mastery_pct == 0:
        return "Not yet shown in a blind pass."
    return f"Shown blind: {state.mastery_pct:g} % of the tempo, {state.item.beats(state.mastery_pct)}."
