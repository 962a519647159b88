"""The words of a page about a session, out of its report and those who word it: none is worded a second time."""

from collections.abc import Iterator, Mapping
from typing import Any

from station.core.labels import name_of
from station.practice.exam.exam_record import SEEN_WORDS
from station.practice.history.exam_words import shown_total
from station.practice.records.report.next_steps import steps_in
from station.practice.records.report.phase_words import phase_lines
from station.practice.records.report.stick_words import sticking_lines, sticks_text
from station.practice.records.report.tempo_report import clean_words, row_words
from station.practice.records.report.unheard_words import unheard_text
from station.practice.records.report.what_next import advice_of
from station.practice.session.cues.quiet_bars import gap_of, gap_words
from station.render.report.page.session_page import Advised, ExamLine, ExamResult, PassRow, WordList
from station.render.report.page.timing_words import signed
from station.scenes.report.page_timing import told_spread
from station.scoring.analysis.fault_table import kind_of
from station.scoring.report.technique_text import technique_lines

Document = Mapping[str, Any]


def next_sentences(document: Document) -> tuple[Advised, ...]:
    """What to practise next, each piece of advice with what stands behind it."""
    behind = dict(zip(advice_of({**document}), document["advice"], strict=True))
    return tuple(Advised(text, tuple(_details(behind.get(text)))) for text in map(str, document["session"]["next"]))


def _details(advice: Document | None) -> Iterator[str]:
    """Where, how much and how sure, and the drill."""
    if advice is None:
        return
    if advice["bars"]:
        yield f"Heard in {_bars_words(advice['bars'])}"
    if advice["effect"] is not None and (measured := _measured(advice)):
        yield measured
    drill = advice["drill"]
    pieces = ", ".join(_part_word(str(piece)) for piece in drill["pieces"])
    bars = "all bars" if drill["bars"] is None else _span(drill["bars"])
    yield f"Drill: {bars} at {drill['tempo_bpm']:.0f} bpm{f', {pieces} alone' if pieces else ''}"


def _measured(advice: Document) -> str:
    """The effect with its interval, with a sign where it has a side; empty of what is counted: its sentence says it."""
    fault, effect = str(advice["fault"]), float(advice["effect"])
    unit, spec = _unit(fault), ".1f" if abs(effect) < 10 else ".0f"
    if unit == "times":
        return ""
    is_spread = fault.startswith("unsteady")
    words = format if unit == "%" or is_spread else signed
    found = advice["ci"]
    ci = None if found is None or None in found else (float(found[0]), float(found[1]))
    ci = told_spread(ci) if is_spread else ci
    bears = "" if ci is None else f" (95 %: {words(ci[0], spec)} to {words(ci[1], spec)})"
    return f"Measured: {words(effect, spec)} {unit}{bears}".strip()


def _unit(fault: str) -> str:
    """The unit of a fault's size; empty of a word that this station does not know."""
    try:
        return kind_of(fault).unit
    except KeyError:
        return ""


def _part_word(piece_or_limb: str) -> str:
    try:
        return name_of(piece_or_limb)
    except KeyError:
        return piece_or_limb.replace("_", " ")


def _bars_words(bars: list[int]) -> str:
    """Bars as a teacher says them: runs of bars as one."""
    runs: list[list[int]] = []
    for bar in sorted(bars):
        if runs and bar == runs[-1][1] + 1:
            runs[-1][1] = bar
        else:
            runs.append([bar, bar])
    said = ", ".join(str(first) if first == last else f"{first}–{last}" for first, last in runs)
    return f"bar {said}" if len(runs) == 1 and runs[0][0] == runs[0][1] else f"bars {said}"


def choices(document: Document) -> tuple[str, ...]:
    """What may be begun next, each with its reason where that was not said already."""
    said = " ".join(map(str, document["session"]["next"])).casefold()
    return tuple(
        f"{step.label}: {step.why}" if step.why and step.why.casefold() not in said else step.label
        for step in steps_in({**document})
    )


def remarks(document: Document) -> tuple[str, ...]:
    """What changes how the figures are read: a lag that was found, bars without a click, pauses, a tempo that rose."""
    session, lag = document["session"], document.get("lag")
    found = [str(lag["text"])] if isinstance(lag, dict) and lag["text"] else []
    if session["gap"] is not None:
        found.append(f"Click: {gap_words(gap_of(str(session['gap'])))}.")
    if pauses := session["pauses"]:
        often = {1: "once", 2: "twice"}.get(len(pauses), f"{len(pauses)} times")
        found.append(f"Paused {often}; what was played again after a pause counts as it was played last.")
    if tempi := session["tempi"]:
        found.append(clean_words(tempi))
    return tuple(found)


def exam_result(exam: Document) -> ExamResult:
    """The marks of an exam that was held."""
    marks = exam["marks"]
    if not isinstance(marks, dict):
        raise TypeError("an exam without marks")
    lines = tuple(
        ExamLine(
            str(line["criterion"]).capitalize(), f"{line['points']:.1f} of {line['worth']:.3g}", str(line["measured"])
        )
        for line in marks["lines"]
    )
    return ExamResult(shown_total(float(marks["total"])), str(marks["band"]), lines, SEEN_WORDS * exam["seen_before"])


def passes_heading(document: Document) -> str:
    """What stands above the passes."""
    return "As the tempo rose" if document["session"]["tempi"] else "Pass by pass"


def pass_rows(document: Document) -> tuple[PassRow, ...]:
    """The passes where the tempo followed the student, or the tempi where it rose; none of other sessions."""
    mastery = document.get("mastery")
    if isinstance(mastery, dict):
        return tuple(_pass(number, one) for number, one in enumerate(mastery["passes"], 1))
    return tuple(_tempo(row) for row in document["session"]["tempi"])


def _pass(number: int, one: Document) -> PassRow:
    right = "stopped early" if one["right"] is None else f"{one['right']} of {one['notes']} right"
    return PassRow(f"pass {number}", f"{one['beats_a_minute']:g} bpm", _span(one["bars"]), right, str(one["why"]))


def _tempo(row: Document) -> PassRow:
    right, how = row_words(row)
    return PassRow("", f"{row['beats_a_minute']:g} bpm", _span(row["bars"]), right, how)


def _span(bars: list[int]) -> str:
    first, last = bars
    return f"bar {first}" if first == last else f"bars {first}–{last}"


def word_lists(document: Document) -> tuple[WordList, ...]:
    """Hands and feet, sticks, what could not be heard or told, what the teacher said, where the student stands."""
    technique = technique_lines(document)
    untold = [f"{one['what']} ({one['count']}): {one['why']}" for one in document["cannot_tell"]]
    said = document["session"].get("teacher") or []
    mastery = document.get("mastery")
    found = (
        ("Hands and feet", [line for line in technique if not line.startswith(_CANNOT_TELL)]),
        ("Sticks and motion", [*sticking_lines({**document}), *_bulleted(sticks_text({**document}))]),
        ("Phase", phase_lines({**document})),
        ("Could not be heard", _bulleted(unheard_text(document["session"]["unheard"]))),
        ("Cannot be told", untold),
        ("From your teacher", [str(words) for words in said]),
        ("Mastery", [str(mastery["words"])] if isinstance(mastery, dict) else []),
    )
    return tuple(WordList(heading, tuple(lines)) for heading, lines in found if lines)


_CANNOT_TELL = "Cannot tell"


def _bulleted(text: str) -> list[str]:
    """The lines of a paragraph of a report's text but its heading."""
    return [line.removeprefix("* ") for line in text.strip().splitlines()[1:]]


def foot(document: Document) -> tuple[str, ...]:
    """The small print."""
    return (f"Latency taken out: {document['session']['latency']}.",)
