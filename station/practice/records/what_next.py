"""What a student should do next: the advice, or where nothing stands out what the lesson's goals ask for.

Pure: an assessment document and what was practised in, sentences out. Tempi are in quarter notes a minute.
"""

from dataclasses import dataclass
from math import ceil, floor, sqrt

from station.drills.lesson import Goals
from station.drills.mastery.pass_facts import usual_interval_ms
from station.drills.mastery.rules import Rules
from station.practice.session.plan import Plan
from station.scoring.report.assessment_document import Json

_NOTHING_PLAYED = "There was nothing to judge: the session ended before the first note."
_NOTHING_HEARD = (
    "Not one hit was heard: is the kit switched on and connected? `station doctor` says what is found;"
    " in the window the computer's keys play, too (F1 shows them)."
)


def what_next(document: dict[str, Json], plan: Plan) -> tuple[str, ...]:
    """At least one sentence for whoever practised `plan`; `document` is the assessment."""
    counts = _numbers(document["counts"])
    if not counts["notes"]:
        return (_NOTHING_PLAYED,)
    if not counts["hits"]:
        return (_NOTHING_HEARD,)
    if advice := advice_of(document):
        return advice
    rules = Rules().for_lesson(plan.lesson, plan.level)
    spread = _Spread.of(document, plan, rules)
    return (_short_of_goal(document, plan.lesson.goals, spread, rules) or _go_on(plan, spread, rules),)


@dataclass(frozen=True, slots=True)
class _Spread:
    """The spread about each piece's own lean, 0 where there is none, and the widest with which a pass is clean."""

    ms: float
    limit_ms: float

    @classmethod
    def of(cls, document: dict[str, Json], plan: Plan, rules: Rules) -> "_Spread":
        """As the mastery policy has it at this tempo."""
        interval_ms = usual_interval_ms(plan.lesson.loop_score.at_speed(plan.tempo_bpm / plan.lesson.tempo_bpm))
        total_ms = _numbers(document["timing"]).get("sd_asynchrony_ms", 0.0)
        about_leans_ms = _pooled_ms(table_in(document, "per_piece")) if "per_piece" in document else None
        spread_ms = total_ms if about_leans_ms is None else min(about_leans_ms, total_ms)
        return cls(spread_ms, rules.sd_limit_ms(interval_ms))


def _pooled_ms(per_piece: Json) -> float | None:
    """The SD of all strokes, each about the mean of its piece."""
    assert isinstance(per_piece, dict), "the report is ours"
    timings = [_numbers(table_in(group, "timing")) for group in per_piece.values() if isinstance(group, dict)]
    spread = [(t["strokes"] - 1, t["sd_asynchrony_ms"]) for t in timings if "sd_asynchrony_ms" in t]
    freedom = sum(count for count, _ in spread)
    return sqrt(sum(count * sd_ms**2 for count, sd_ms in spread) / freedom) if freedom else None


def advice_of(document: dict[str, Json]) -> tuple[str, ...]:
    """The sentences of the assessment's advice."""
    advice = document["advice"]
    assert isinstance(advice, list), "the report is ours"
    return tuple(str(item["text"]) for item in advice if isinstance(item, dict))


def _short_of_goal(document: dict[str, Json], goals: Goals, spread: _Spread, rules: Rules) -> str:
    """The first goal that was not reached, empty where all were."""
    counts, timing = _numbers(document["counts"]), _numbers(document["timing"])
    assert isinstance(document["right"], int), "the report is ours"
    right = document["right"] / counts["notes"]
    if right < rules.min_right:
        share, goal = floor(100 * right), ceil(100 * rules.min_right)
        return f"{share} % of the notes were right, {goal} % are the goal: play it again at this tempo, or slower."
    if spread.ms > spread.limit_ms:
        spreads = f"your strokes spread by {ceil(spread.ms)} ms and {floor(spread.limit_ms)} are the goal"
        return (
            f"No one fault stands out, but {spreads}: stay at this tempo, or go slower, until they lie closer together."
        )
    lean_ms = timing.get("mean_signed_asynchrony_ms", 0.0)
    if goals.max_lean_ms is not None and abs(lean_ms) > goals.max_lean_ms:
        side = "early" if lean_ms < 0 else "late"
        return (
            f"You play {ceil(abs(lean_ms))} ms {side} on average and the lesson allows {goals.max_lean_ms:g}:"
            " play it again and listen to the click."
        )
    swing = _numbers(table_in(document, "craft").get("swing"))
    if goals.max_swing_error is not None and swing and abs(swing["held"] - swing["written"]) > goals.max_swing_error:
        return (
            f"You swing {swing['held']:.2f}:1, {swing['written']:.2f}:1 is written and the lesson allows"
            f" {goals.max_swing_error:g} to either side: play it again and listen to the offbeats."
        )
    score = document["score"]
    if goals.min_score is not None and isinstance(score, float | int) and score < goals.min_score:
        return f"The score is {floor(score)} and {goals.min_score:g} is the goal: play it again at this tempo."
    return ""


def _go_on(plan: Plan, spread: _Spread, rules: Rules) -> str:
    below = plan.tempo_bpm < plan.lesson.target_tempo_bpm * (1 - _SAME_TEMPO)
    why = f" (a spread of {ceil(spread.ms)} ms is within the {floor(spread.limit_ms)} of a clean pass)"
    reason = why if spread.ms > rules.sd_floor_ms else ""  # who lies closer together does not ask
    return f"Nothing stands out{reason}: {'raise the tempo' if below else 'take the next lesson, or raise the tempo'}."


_SAME_TEMPO = 0.01
"""Tempi that nobody tells apart (our choice)."""


def table_in(of: dict[str, Json], key: str) -> dict[str, Json]:
    """The table under `key` of a report, which has one there."""
    table = of[key]
    assert isinstance(table, dict), "the report is ours"
    return table


def _numbers(table: Json) -> dict[str, float]:
    """The table's numbers; what has no data is left out, and all of it where there is no table."""
    assert table is None or isinstance(table, dict), "the report is ours"
    return {key: float(value) for key, value in (table or {}).items() if isinstance(value, float | int)}
