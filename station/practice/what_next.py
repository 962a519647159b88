"""What a student is told to do next: the advice, or where nothing stands out what the lesson's goals ask for.

Pure: an assessment document and the lesson's goals in, sentences out. Tempi are in quarter notes a minute.
"""

from math import ceil, floor

from station.drills.lesson import Lesson
from station.scoring.document import Json

SPREAD_TO_GO_ON_MS = 25.0
"""Where a lesson names no spread of its own: what is shown as on time (docs/pictures.md); our choice."""

_NOTHING_PLAYED = "There was nothing to judge: the session ended before the first note."
_NOTHING_HEARD = (
    "Not one hit was heard: is the kit switched on and connected? `station doctor` says what is found;"
    " in the window the computer's keys play, too (F1 shows them)."
)


def what_next(document: dict[str, Json], lesson: Lesson, tempo_bpm: float) -> tuple[str, ...]:
    """At least one sentence for whoever practised `lesson` at `tempo_bpm`; `document` is the assessment."""
    counts = _numbers(document["counts"])
    if not counts["notes"]:
        return (_NOTHING_PLAYED,)
    if not counts["hits"]:
        return (_NOTHING_HEARD,)
    return advice_of(document) or (_short_of_goal(document, lesson) or _go_on(lesson, tempo_bpm),)


def advice_of(document: dict[str, Json]) -> tuple[str, ...]:
    """The sentences of the assessment's advice."""
    advice = document["advice"]
    assert isinstance(advice, list), "the report is ours"
    return tuple(str(item["text"]) for item in advice if isinstance(item, dict))


def _short_of_goal(document: dict[str, Json], lesson: Lesson) -> str:
    """The first goal that was not reached, empty where all were."""
    goals, counts, timing = lesson.goals, _numbers(document["counts"]), _numbers(document["timing"])
    right = counts["matched"] / counts["notes"]
    if right < goals.min_accuracy:
        share, goal = floor(100 * right), ceil(100 * goals.min_accuracy)
        return f"{share} % of the notes were right, {goal} % are the goal: play it again at this tempo, or slower."
    spread_ms, limit_ms = timing.get("sd_asynchrony_ms", 0.0), goals.max_sd_ms or SPREAD_TO_GO_ON_MS
    if spread_ms > limit_ms:
        return (
            f"No one fault stands out, but your strokes spread by {ceil(spread_ms)} ms and {limit_ms:g} are the goal:"
            " stay at this tempo, or go slower, until they lie closer together."
        )
    lean_ms = timing.get("mean_signed_asynchrony_ms", 0.0)
    if goals.max_lean_ms is not None and abs(lean_ms) > goals.max_lean_ms:
        side = "early" if lean_ms < 0 else "late"
        return (
            f"You play {ceil(abs(lean_ms))} ms {side} on average and the lesson allows {goals.max_lean_ms:g}:"
            " play it again and listen to the click."
        )
    swing = _numbers(_table(document, "craft").get("swing"))
    if goals.max_swing_error is not None and swing and abs(swing["held"] - swing["written"]) > goals.max_swing_error:
        return (
            f"You swing {swing['held']:.2f}:1, {swing['written']:.2f}:1 is written and the lesson allows"
            f" {goals.max_swing_error:g} to either side: play it again and listen to the offbeats."
        )
    score = document["score"]
    if goals.min_score is not None and isinstance(score, float | int) and score < goals.min_score:
        return f"The score is {floor(score)} and {goals.min_score:g} is the goal: play it again at this tempo."
    return ""


def _go_on(lesson: Lesson, tempo_bpm: float) -> str:
    below = tempo_bpm < lesson.target_tempo_bpm * (1 - _SAME_TEMPO)
    return f"Nothing stands out: {'raise the tempo' if below else 'take the next lesson, or raise the tempo'}."


_SAME_TEMPO = 0.01
"""Tempi that nobody tells apart (our choice)."""


def _table(of: dict[str, Json], key: str) -> dict[str, Json]:
    table = of[key]
    assert isinstance(table, dict), "the report is ours"
    return table


def _numbers(table: Json) -> dict[str, float]:
    """The table's numbers; what has no data is left out, and all of it where there is no table."""
    assert table is None or isinstance(table, dict), "the report is ours"
    return {key: float(value) for key, value in (table or {}).items() if isinstance(value, float | int)}
