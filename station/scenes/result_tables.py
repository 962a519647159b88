"""A session's result as the results page shows it."""

from dataclasses import replace

import numpy as np

from station.core.units import NS_PER_S
from station.music.judgement import Label
from station.practice.now.tempo_now import tempi_in_words
from station.practice.records.report.stick_words import stick_lines
from station.practice.session.session import SessionResult
from station.render.report.result_facts import Passages, PieceLean, ResultFacts, ResultWords, result_facts
from station.scoring.analysis.fault_table import kind_of
from station.scoring.matching.hit_windows import Level
from station.scoring.matching.right import right_notes
from station.scoring.report.assessment_document import Json
from station.scoring.report.technique_text import technique_lines


def session_facts(result: SessionResult, document: dict[str, Json]) -> ResultFacts:
    """The facts of `result`; `document` is its report."""
    plan = result.plan
    extra = result.alignment.hit_label == Label.EXTRA
    points, session = document["score"], document["session"]
    assert isinstance(session, dict), "the report is ours"
    steps = session["next"]
    assert isinstance(steps, list), "the report is ours"
    first, last = plan.bars[0] + 1, plan.bars[1] + 1
    bars = f"bars {first}–{last}" if first != last else f"bar {first}"
    stopped = "" if result.complete else ", stopped early"
    passes = "1 pass" if plan.passes == 1 else f"{plan.passes} passes"
    words = ResultWords(
        title=plan.lesson.title,
        subtitle=f"{passes} of {bars} at {tempi_in_words(plan, result.score)}{stopped}{_standing(document)}",
        points=float(points) if isinstance(points, float | int) else None,
        advice=(*_lag_words(document), *map(str, steps)),
        technique=(*stick_lines(document), *technique_lines(document)),
        first_bar=plan.first_bar,
        starts=plan.pass_starts,
    )
    facts = result_facts(
        result.score,
        result.alignment.note_label,
        result.alignment.asynchrony_ns,
        right_notes(result.score, result.alignment, result.plan.level.windows),
        np.asarray(result.performance.hits["at_ns"][extra] / NS_PER_S),
        words,
    )
    timing = document["timing"]
    assert isinstance(timing, dict), "the report is ours"
    return replace(
        facts,
        on_time_ms=result.plan.level.windows.on_time_ms,
        mean_ci=_interval(timing["mean_ci_ms"]),
        passages=_passages(document),
    )


def _passages(document: dict[str, Json]) -> Passages | None:
    """Groove and fills where the fills lie elsewhere by as much as advice would name, None elsewhere."""
    craft = document["craft"]
    assert isinstance(craft, dict), "the report is ours"
    found = craft["fills"]
    if not isinstance(found, dict):
        return None
    apart, ci, groove, fills = found["apart_ms"], _interval(found["ci"]), found["groove"], found["fills"]
    assert isinstance(groove, dict), "the report is ours"
    assert isinstance(fills, dict), "the report is ours"
    mean, fills_ms = _number(groove["mean"]), _number(fills["mean"])
    if ci is None or mean is None or fills_ms is None or ci[0] * ci[1] <= 0:
        return None
    if abs(_number(apart) or 0.0) < kind_of("rush_fills").least:
        return None
    count = int(_number(groove["count"]) or 0)
    return Passages(PieceLean("groove", count, count, mean, _number(groove["sd"]), _interval(groove["ci"])), fills_ms)


def _interval(of: Json) -> tuple[float, float] | None:
    if not isinstance(of, list):
        return None
    low, high = (_number(end) for end in of)
    return None if low is None or high is None else (low, high)


def _number(of: Json) -> float | None:
    return float(of) if isinstance(of, float | int) else None


def _lag_words(document: dict[str, Json]) -> tuple[str, ...]:
    """What was found of a lag: before all advice, for it says what the score leaves out."""
    lag = document.get("lag")
    return (str(lag["text"]),) if isinstance(lag, dict) and lag["text"] else ()


def _standing(document: dict[str, Json]) -> str:
    """By which level was judged, and where the student stands in the lesson, where the tempo followed them."""
    mastery, judged = document.get("mastery"), f" · judged as {Level(str(document['level'])).words}"
    if not isinstance(mastery, dict):
        return judged
    return f" · {mastery['words']}" if mastery["stable"] else f"{judged} · {mastery['words']}"
