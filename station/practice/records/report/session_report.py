"""What a session leaves for people and programs: the report as a JSON document and as text.

The document is the assessment of `station.scoring.report.assessment_document` with the session's own facts under
`session`, and with a virtual student its own account under `truth`. docs/report.md describes it.
"""

from collections.abc import Iterable
from contextlib import suppress
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from station.core.errors import BadInput
from station.core.labels import name_of
from station.core.settings import Settings
from station.core.units import NS_PER_MS, NS_PER_S, ms_from_ns
from station.devices.mapping.device_file import own_kit
from station.drills.lesson import Goals
from station.drills.mastery.agenda import Turn
from station.engine.engine import KEYBOARD
from station.practice.lag.lag_document import lag_document
from station.practice.lag.session_lag import LagAnswer, SessionLag
from station.practice.records.assigned_lessons import assigned_by
from station.practice.records.report.mastery_report import passes_text
from station.practice.records.report.next_steps import next_steps, steps_document
from station.practice.records.report.phase_words import phase_document, phase_lines
from station.practice.records.report.stick_words import sticking_lines, sticks_document, sticks_text
from station.practice.records.report.tempo_report import clean_up_to, reached, tempo_rows, tempo_text
from station.practice.records.report.unheard_words import unheard_rows, unheard_text
from station.practice.records.report.what_next import advice_of, measured_session, missed_document, table_in, what_next
from station.practice.session.cues.quiet_bars import gap_of, gap_words
from station.practice.session.lesson_places import written_hands
from station.practice.session.session import SessionResult
from station.scoring.analysis.points import FREE_LEAN_MS, Feel
from station.scoring.analysis.summary import SummaryView, summarise
from station.scoring.analysis.technique.observability import KitFacts
from station.scoring.matching.alignment import Alignment, Reference
from station.scoring.report.assessment_document import Json, assessment
from station.scoring.report.technique_text import technique_lines

if TYPE_CHECKING:
    from station.practice.records.virtual_practice import VirtualSession
    from station.simulation.virtual_student import VirtualPerformance


def kit_facts(settings: Settings, device: str | None = None) -> KitFacts:
    """What this user has measured of the kit called `device`: its own file goes before the settings."""
    kit = None
    if device is not None:
        with suppress(BadInput):  # the engine has said so when the kit was found
            kit = own_kit(device)
    if kit is None:
        return KitFacts(MappingProxyType(settings.threshold_of), settings.mask_ms)
    least = {piece: max(pad.threshold, pad.least_velocity or 1) for piece, pad in kit.pads.items()}
    deaf_ms = max((ms_from_ns(pad.mask_ns) for pad in kit.pads.values()), default=0.0)
    thresholds = settings.threshold_of | {piece: velocity for piece, velocity in least.items() if velocity > 1}
    return KitFacts(MappingProxyType(thresholds), max(settings.mask_ms, deaf_ms))


def practice_document(
    result: SessionResult, settings: Settings, lag: SessionLag | None = None, following: Turn | None = None
) -> dict[str, Json]:
    """The report of a session and its `lag`; computer keys have no velocity, so of them nothing is said of dynamics.

    `following` is the lesson to turn to after it (`memory.following_lesson`), None where nobody knows one.
    """
    plan = result.plan
    document = assessment(summarise(result.score, result.performance, result.alignment, session_view(result, settings)))
    measured, tempi = measured_session(result, document["score"]), tempo_rows(result)
    if tempi:  # a drift is nobody's where the tempo was meant to rise
        document["tempo"] = {**table_in(document, "tempo"), "drift_pct_per_minute": None, "drift_ci": None}
    onwards = reached(plan, tempi)
    steps = next_steps(document, onwards, measured, following, result.complete)
    given = assigned_by(settings.sessions_dir, settings.student, plan.lesson.name)
    document["session"] = {
        "lesson": plan.lesson.name,
        "title": plan.lesson.title,
        "student": settings.student,
        "device": result.device,
        "tempo_bpm": round(plan.tempo_bpm, 3),
        "beats_a_minute": round(plan.beats_a_minute, 3),
        "tempi": tempi,
        "clean_up_to": clean_up_to(tempi),
        "bars": [plan.bars[0] + 1, plan.bars[1] + 1],
        "passes": plan.passes,
        "click": plan.click is not None,
        "gap": None if plan.click is None or plan.click.gap is None else str(plan.click.gap),
        "complete": result.complete,
        "played_s": round(result.score.length_ns / NS_PER_S, 1),
        "output": result.output,
        "input_latency_ms": result.latency.of_kit(result.device) / NS_PER_MS,
        "output_latency_ms": result.latency.of_output(result.output) / NS_PER_MS,
        "latency": result.latency.words(result.device, result.output),
        "pauses": [
            {"bar": plan.bar_names[pause.bar] + 1, "asked": pause.asked, "strokes_again": pause.strokes}
            for pause in result.pauses
        ],
        "unheard": unheard_rows(result),
        "goals_missed": missed_document(plan, measured),
        "next": [*what_next(document, onwards, measured, steps[0])],
        "steps": steps_document(steps),
        "assignments": [taken.id for taken in given],
        "teacher": [words for taken in given for name, words in taken.said if name == plan.lesson.name],
    }
    document["lag"] = lag_document(lag)
    document["sticks"] = sticks_document(result.felt, plan.lesson.goals.faults)
    document["phase"] = phase_document(result.phase, plan.lesson.goals.faults)
    return document


def with_truth(document: dict[str, Json], virtual: "VirtualSession", settings: Settings) -> dict[str, Json]:
    """The document beside what the virtual student knows that it did."""
    student, matching = virtual.student, virtual.student.truth
    hit_ns = student.performance.hits["at_ns"]
    known = Alignment(
        hit_of_note=matching.hit_of_note,
        note_of_hit=matching.note_of_hit,
        note_label=matching.note_label,
        hit_label=matching.hit_label,
        asynchrony_ns=_true_asynchrony_ns(student),
        hit_score_ns=hit_ns,
        segment=np.zeros(len(hit_ns), np.int64),
        reference=Reference.CLICK,
        sd_ms=None,
    )
    truth = assessment(summarise(student.score, student.performance, known, session_view(virtual.result, settings)))
    return {**document, "truth": {**truth, **student.truth_document()}}


def session_view(result: SessionResult, settings: Settings) -> SummaryView:
    """Bars are counted as in the lesson, however often they were played."""
    plan = result.plan
    return SummaryView(
        windows=plan.level.windows,
        hears_velocity=result.device != KEYBOARD,
        feel=feel_of(plan.lesson.goals),
        kit=kit_facts(settings, result.device),
        silences=plan.silences,
        bar_names=plan.practised_bars,
        beat_ticks=plan.lesson.beat_ticks,
        faults=plan.lesson.goals.faults,
        asks_hand=written_hands(result),
        hints=plan.lesson.hints,
        parts=plan.lesson.part_of_bar,
    )


def feel_of(goals: Goals) -> Feel:
    """What costs nothing in a lesson: feel, unless its goals ask for less."""
    lean_ms = FREE_LEAN_MS if goals.max_lean_ms is None else min(goals.max_lean_ms, FREE_LEAN_MS)
    return Feel(lean_ms, goals.max_swing_error)


def _true_asynchrony_ns(student: "VirtualPerformance") -> NDArray[np.int64]:
    """Played − written of every note that was answered, 0 elsewhere, shape (n,)."""
    hit = student.truth.hit_of_note
    answered = hit >= 0
    asynchrony_ns = np.zeros(len(hit), np.int64)
    asynchrony_ns[answered] = student.performance.hits["at_ns"][hit[answered]] - student.score.onset_ns[answered]
    return asynchrony_ns


# --- text ------------------------------------------------------------------------------------------------------------


def report_text(document: dict[str, Json]) -> str:
    """The report of a session in words."""
    session = table_in(document, "session")
    bars, steps = session["bars"], session["next"]
    assert isinstance(bars, list), "the report is ours"
    assert isinstance(steps, list), "the report is ours"
    which = f"bars {bars[0]}-{bars[1]}" if bars[0] != bars[1] else f"bar {bars[0]}"
    passes = "1 pass" if session["passes"] == 1 else f"{session['passes']} passes"
    tempo = f"{session['beats_a_minute']:g} bpm"
    if session["beats_a_minute"] != session["tempo_bpm"]:
        tempo += f" ({session['tempo_bpm']:g} quarter notes a minute)"
    if tempi := session["tempi"]:
        tempo = f"{session['beats_a_minute']:g} bpm and rising to {_last_tempo(tempi)} bpm"
    if "mastery" in document:
        tempo = f"a tempo that follows you, {tempo} at last"
    head = f"{session['title']} at {tempo}, {which}, {passes}, judged as {document['level']}"
    return (
        f"{head}{'' if session['complete'] else ' (stopped early)'}\n\n"
        f"{_gap_text(session)}{_figures_text(document)}{_praise_text(document)}{_passes(document)}{_tempi(session)}"
        f"{_lag(document)}{_steps_text(map(str, steps))}{_teacher(session)}{sticks_text(document)}"
        f"{unheard_text(session['unheard'])}{_paused(session)}"
        f"\nLatency taken out: {session['latency']}.\n"
    )


def _lag(document: dict[str, Json]) -> str:
    """What was found of a lag, and what takes it out; nothing where there is none."""
    lag = document.get("lag")
    if not isinstance(lag, dict) or not lag["text"]:
        return ""
    asks = f"\n{_TAKE_OUT}" if lag["answer"] == LagAnswer.OPEN.value else ""
    return f"\n{lag['text']}{asks}\n"


_TAKE_OUT = "`station devices calibrate --by groove` takes it out for good; with --leave it counts as yours."


def _teacher(session: dict[str, Json]) -> str:
    """What the teacher's last note said of this lesson, nothing where there is none."""
    said = session.get("teacher")
    lines = [f"* {words}" for words in said] if isinstance(said, list) else []
    return "\n".join(["", "From your teacher", *lines, ""]) if lines else ""


def _last_tempo(tempi: Json) -> str:
    assert isinstance(tempi, list), "the report is ours"
    last = tempi[-1]
    assert isinstance(last, dict), "the report is ours"
    return f"{last['beats_a_minute']:g}"


def _tempi(session: dict[str, Json]) -> str:
    """Each tempo of a session whose tempo rose, nothing of another."""
    tempi = session["tempi"]
    assert isinstance(tempi, list), "the report is ours"
    return tempo_text(tempi)


def _gap_text(session: dict[str, Json]) -> str:
    """Where the click fell silent, in a line that can be said again; nothing where it sounded throughout."""
    gap = session["gap"]
    return "" if gap is None else f"Click: {gap_words(gap_of(str(gap)))} (again with --gap {gap}).\n\n"


def _paused(session: dict[str, Json]) -> str:
    """What pauses did to the figures, nothing where there were none."""
    pauses = session["pauses"]
    assert isinstance(pauses, list), "the report is ours"
    if not pauses:
        return ""
    often = {1: "once", 2: "twice"}.get(len(pauses), f"{len(pauses)} times")
    return f"\nPaused {often}; what was played again after a pause counts as it was played last.\n"


def _passes(document: dict[str, Json]) -> str:
    """The passes of a session that followed the student, nothing of another."""
    return f"\n{passes_text(table_in(document, 'mastery'))}" if "mastery" in document else ""


def assessment_text(document: dict[str, Json]) -> str:
    """An assessment in words: the figures, each piece's lean and spread, and the advice."""
    return _figures_text(document) + _praise_text(document) + _steps_text(advice_of(document))


def _praise_text(document: dict[str, Json]) -> str:
    return f"\n{document['praise']}\n" if document.get("praise") else ""


def _steps_text(steps: Iterable[str]) -> str:
    lines = [f"* {step}" for step in steps]
    return "\n".join(["", "What to practise next", *lines, ""]) if lines else ""


def _again(counts: dict[str, Json]) -> str:
    """What is said of hits that belong to attempts that do not count, where there are some."""
    return f"; played again: {counts['played_again']}" if counts["played_again"] else ""


def _unknown(counts: dict[str, Json]) -> str:
    """What is said of notes that nobody could hear, where there are some."""
    return f"; unknown, for they could not be heard: {counts['unknown']}" if counts["unknown"] else ""


def _figures_text(document: dict[str, Json]) -> str:
    counts, timing = table_in(document, "counts"), table_in(document, "timing")
    lines = [
        f"Score {_figure(document['score'], '.0f')} of 100",
        f"Notes {counts['notes']}: {counts['matched']} hit, {counts['misses']} missed,"
        f" {counts['wrong_piece']} on a wrong piece; extra hits: {counts['extras']}{_again(counts)}{_unknown(counts)}",
        _timing_words(timing, document["reference"] == Reference.PLAYER.value),
    ]
    rows = [
        (piece, group)
        for piece, group in table_in(document, "per_piece").items()
        if isinstance(group, dict) and (group["notes"] or group["extras"])  # else only wrong hits landed there
    ]
    if rows:
        lines += ["", f"{'piece':17}" + "".join(f"{name:>9}" for name in _COLUMNS)]
    lines += [f"{name_of(piece):17}" + "".join(f"{cell:>9}" for cell in _cells(group)) for piece, group in rows]
    if hands := [*sticking_lines(document), *phase_lines(document)]:
        lines += ["", *hands]
    craft = technique_lines(document)
    return "\n".join([*lines, "", *craft] if craft else lines) + "\n"


_COLUMNS = ("notes", "hit", "missed", "wrong", "extra", "mean ms", "SD ms")


def _cells(group: dict[str, Json]) -> list[str]:
    timing = table_in(group, "timing")
    counted = [str(group[key]) for key in ("notes", "matched", "misses", "wrong_piece", "extras")]
    mean, sd = timing["mean_signed_asynchrony_ms"], timing["sd_asynchrony_ms"]
    return [*counted, _figure(mean, "+.1f"), _figure(sd, ".1f")]


def _timing_words(timing: dict[str, Json], own_clock: bool) -> str:
    mean, sd = timing["mean_signed_asynchrony_ms"], timing["sd_asynchrony_ms"]
    if not isinstance(mean, float | int):
        return "Timing: nothing to measure"
    if own_clock:
        lean = "without a click, early or late cannot be told"
        return f"Timing: spread (SD) {_figure(sd, '.1f')} ms about your own tempo; {lean}"
    where = "on time" if abs(mean) < _ON_TIME_MS else f"{abs(mean):.1f} ms {'early' if mean < 0 else 'late'}"
    return f"Timing: {where} on average, spread (SD) {_figure(sd, '.1f')} ms"


_ON_TIME_MS = 1.0
"""Nobody hears a millisecond (HUMANS: 6 ms is just noticeable at best)."""


def _figure(value: Json, spec: str) -> str:
    return format(value, spec) if isinstance(value, float | int) else "–"
