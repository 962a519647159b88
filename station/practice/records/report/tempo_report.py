"""How a session went at each of its tempi, where the tempo rose: a row a tempo, and up to which it was clean.

A tempo is clean as a pass is (`drills.mastery.verdict`), at the level at which the session is judged.
"""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from station.core.units import PPQ
from station.drills.mastery.pass_measures.asked_parts import Part
from station.drills.mastery.pass_measures.pass_facts import PassResult, PassView, measure_pass, usual_interval_ms
from station.drills.mastery.rules import Rules
from station.drills.mastery.verdict import Verdict, judge
from station.engine.engine import KEYBOARD
from station.music.judgement import Label
from station.practice.session.plan import Plan
from station.practice.session.session import SessionResult
from station.scoring.matching.unheard import known_part
from station.scoring.report.assessment_document import Json


def tempo_rows(result: SessionResult) -> list[Json]:
    """A row for each tempo that was reached, empty where the tempo stayed; its bars count from 1 over all passes."""
    plan = result.plan
    rules = Rules().for_lesson(plan.lesson, plan.level)
    return [
        _row(tempo_bpm * PPQ / plan.lesson.beat_ticks, bars, measured, judge(measured, rules))
        for tempo_bpm, bars, measured in _measured(result)
    ]


def _row(beats_a_minute: float, bars: tuple[int, int], measured: PassResult, verdict: Verdict) -> Json:
    return {
        "beats_a_minute": round(beats_a_minute, 3),
        "bars": [bars[0] + 1, bars[1] + 1],
        "notes": measured.notes,
        "right": measured.right,
        "wrong_pads": measured.wrong_pads,
        "extras": measured.extras,
        "sd_ms": None if measured.sd_ms is None else round(measured.sd_ms, 1),
        "clean": verdict.is_clean,
        "why": verdict.words,
    }


def clean_up_to(rows: list[Json]) -> float | None:
    """The fastest tempo such that it and all before it were clean, None where the first was not."""
    fastest = None
    for row in rows:
        assert isinstance(row, dict), "the report is ours"
        if not row["clean"]:
            break
        fastest = float(str(row["beats_a_minute"]))
    return fastest


def fastest_clean(rows: list[Json]) -> float | None:
    """The fastest tempo that was clean, whatever was at slower ones; None where none was."""
    clean = [float(str(row["beats_a_minute"])) for row in rows if isinstance(row, dict) and row["clean"]]
    return max(clean, default=None)


def reached(plan: Plan, rows: list[Json]) -> Plan:
    """The plan at the fastest tempo that was clean, from where practice goes on; as it is where none was."""
    fastest = fastest_clean(rows)
    return plan if fastest is None else replace(plan, tempo_bpm=fastest * plan.lesson.beat_ticks / PPQ)


def tempo_text(rows: list[Json]) -> str:
    """The rows for people, and how far it was clean; empty without rows."""
    if not rows:
        return ""
    lines = [_line(row) for row in rows if isinstance(row, dict)]
    return "\n".join(["", "As the tempo rose", *lines, clean_words(rows), ""])


def clean_words(rows: list[Json]) -> str:
    """How far it was clean from the first tempo on, and at which faster ones it was again."""
    upto = clean_up_to(rows)
    again = [
        f"{row['beats_a_minute']:g}"
        for row in rows
        if isinstance(row, dict) and row["clean"] and float(str(row["beats_a_minute"])) > (upto or 0.0)
    ]
    later = f"{', '.join(again[:-1])} and {again[-1]}" if len(again) > 1 else "".join(again)
    if upto is None:
        return f"Not clean at the first tempo, but at {later} bpm." if again else "Not yet clean at the first tempo."
    return f"Clean up to {upto:g} bpm, and again at {later} bpm." if again else f"Clean up to {upto:g} bpm."


def row_words(row: Mapping[str, Json]) -> tuple[str, str]:
    """What was right at one tempo, with what was too many and on a wrong pad; the spread, and why it was not clean."""
    strokes = ((row["wrong_pads"], "on a wrong pad"), (row["extras"], "extra"))
    counted = [f"{row['right']} of {row['notes']} right", *(f"{count} {what}" for count, what in strokes if count)]
    spread = [] if row["sd_ms"] is None else [f"spread {row['sd_ms']:.0f} ms"]
    why = "clean" if row["clean"] else f"not clean: {row['why']}" if row.get("why") else "not clean"
    return ", ".join(counted), ", ".join([*spread, why])


def _line(row: dict[str, Json]) -> str:
    bars = row["bars"]
    assert isinstance(bars, list), "the report is ours"
    where, (right, how) = f"{bars[0]}-{bars[1]}", row_words(row)
    return f"{row['beats_a_minute']:6g} bpm  bars {where:8} {right:40} {how}".rstrip()


def _measured(result: SessionResult) -> list[tuple[float, tuple[int, int], PassResult]]:
    """Of each tempo that was reached: quarter notes a minute, its first and last bar, what was played there."""
    plan, score = result.plan, result.score
    if not plan.steps:
        return []
    ends = [*(step.bar - 1 for step in plan.steps[1:]), score.bar_count - 1]
    spans = [(step.bar, min(end, score.bar_count - 1)) for step, end in zip(plan.steps, ends, strict=True)]
    parts = tuple(Part(str(index), bars=span) for index, span in enumerate(spans))
    view = PassView(plan.level.windows, parts, result.device != KEYBOARD)
    whole = measure_pass(score, result.performance, result.alignment, None, view)
    rows = zip(plan.steps, whole.parts, strict=True)
    return [
        (step.tempo_bpm, span, _of_span(result, span, part.right, part.sd_ms))
        for (step, part), span in zip(rows, spans, strict=True)
        if part.notes
    ]


def _of_span(result: SessionResult, span: tuple[int, int], right: int, sd_ms: float | None) -> PassResult:
    """Some bars as a pass of their own."""
    score, alignment, _ = known_part(result.score, result.alignment)
    rows = (score.bar >= span[0]) & (score.bar <= span[1])
    hits = score.tempo_map.bars_at(score.tempo_map.ticks_at_ns(np.maximum(alignment.hit_score_ns, 0)))
    here = (hits >= span[0]) & (hits <= span[1])
    return PassResult(
        notes=int(rows.sum()),
        right=right,
        wrong_pads=int((alignment.note_label[rows] == Label.WRONG_PIECE).sum()),
        extras=int((alignment.hit_label[here] == Label.EXTRA).sum()),
        played=int((alignment.note_label[rows] == Label.MATCH).sum()),
        sd_ms=sd_ms,
        interval_ms=usual_interval_ms(score.bars(*span)),
    )
