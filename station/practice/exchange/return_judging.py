"""A session of a return judged again from its capture, under the lesson's text that came with it.

What the student's report says stands beside what the capture gives. A capture is a stranger's: it is looked through
before it is understood, and whoever judges one does it in a process with limits (`app.teacher_desk.judge_worker`).
"""

import json
import struct
from collections.abc import Iterator
from dataclasses import dataclass, replace

from station.core.errors import BadInput
from station.core.settings import Settings
from station.core.units import NS_PER_S
from station.devices.capture.capture import MAGIC, Capture, RecordKind, parse_capture
from station.practice.exchange.assignment_file import Assignment
from station.practice.exchange.lesson_member import parsed
from station.practice.exchange.return_file import Return, ReturnedSession, session_words
from station.practice.exchange.session_figures import SessionFigures, length_s, report_figures
from station.practice.lag.fair_judgement import judged_as_told
from station.practice.records.recovery import session_of
from station.practice.records.report.session_report import practice_document
from station.practice.session.plan import MAX_TEMPO_BPM, MIN_TEMPO_BPM
from station.practice.session.session import SessionResult
from station.scoring.report.assessment_document import Json

MOST_RECORDS = 600_000
"""Of a capture (our choice: an hour of strokes has a tenth of it, twenty minutes of sensors on both sticks these)."""
MOST_LOG_BYTES = 4 << 20
"""Of what a session wrote into its capture (our choice: eighty passes of the longest song)."""
MOST_NOTES = 200_000
"""That all passes of a session ask for together (our choice: five hours at ten strokes a second)."""
MOST_BEGUN = 200
"""Sessions in one capture: practice that follows the student has one a pass (our choice: three hours of them)."""
SLOWEST_BPM, FASTEST_BPM = MIN_TEMPO_BPM / 4, 4 * MAX_TEMPO_BPM
"""In quarter notes, whatever beat a lesson counts, and however far a ramp goes (our choice)."""
MOST_A_SECOND, SPARE_RECORDS = 2000, 10_000
"""Records: two sensors send four hundred a second (our choice: five times that, and a start of some thousand)."""
SAME_SCORE = 1.0
"""Points by which a report may lie from the capture: what a teacher's settings of the kit may change (our choice)."""
SAME_S = 1.0
"""Seconds by which a return may lie from the capture: more than its table rounds (our choice)."""
_HEAD = struct.Struct("<BHIq")
_CHECK_BYTES = 4


@dataclass(frozen=True, slots=True, eq=False)
class JudgedSession:
    """The session of a return judged again: its `result`, the `document` of it, its `figures`, and what differs."""

    result: SessionResult
    document: dict[str, Json]
    figures: SessionFigures
    differences: tuple[str, ...]


def judge_returned(
    returned: Return, number: int, source: str, settings: Settings, asked: Assignment | None = None
) -> JudgedSession:
    """Session `number` (from 1) of a return to the assignment `asked`, None where nobody has that any more.

    Raises `BadInput` where there is no such session, or its capture gives none.
    """
    if not 1 <= number <= len(returned.sessions):
        raise BadInput(source, f"session {number}", f"the return has sessions 1 to {len(returned.sessions)}")
    session, place = returned.sessions[number - 1], f"session {number}"
    (lesson,) = parsed([(session.figures.lesson, session.lesson_text)], source)
    capture = checked_capture(session.capture, source, place)
    result = session_of(capture, lesson)
    if result is None:
        raise BadInput(source, place, f"its capture holds no session of {session.figures.lesson} as it was sent")
    fair = judged_as_told(result, session.figures.left_out_ms)
    result, document = fair.result, practice_document(fair.result, settings, fair.lag)
    figures = report_figures(json.dumps(document).encode(), "report", "")
    figures = replace(figures, seconds=length_s(capture))
    told = (*differences(session.figures, figures), *_of_another(returned, number), *_not_as_given(session, asked))
    return JudgedSession(result, document, figures, told)


def _of_another(returned: Return, number: int) -> Iterator[str]:
    """That an earlier session of the return has the same capture."""
    capture = returned.sessions[number - 1].capture
    for before, one in enumerate(returned.sessions[: number - 1], 1):
        if one.capture == capture:
            yield f"its capture is that of session {before} again"
            return


def _not_as_given(session: ReturnedSession, asked: Assignment | None) -> Iterator[str]:
    """That the lesson that was sent with a session is another than the one that was given."""
    if asked is None:
        return
    lesson = asked.lesson(session.lesson)
    if lesson is None:
        yield f"the assignment has no lesson {session.lesson}"
    elif lesson.text != session.lesson_text:
        yield f"the lesson is not as version {asked.revision} of the assignment gives it"


def differences(told: SessionFigures, heard: SessionFigures) -> tuple[str, ...]:
    """Where a report and the capture disagree, a line each; nothing where they say the same."""
    found = []
    if (told.score is None) != (heard.score is None) or abs((told.score or 0) - (heard.score or 0)) > SAME_SCORE:
        found.append(f"the report says {_score(told)}, the capture gives {_score(heard)}")
    for what, said, is_so in (
        ("notes", told.notes, heard.notes),
        ("right", told.right, heard.right),
        ("passes", told.passes, heard.passes),
        ("bpm", round(told.beats_a_minute, 1), round(heard.beats_a_minute, 1)),
    ):
        if said != is_so:
            found.append(f"{what}: the report says {said:g}, the capture gives {is_so:g}")
    if told.level != heard.level:
        found.append(f"the report says judged as {told.level}, the capture {heard.level}")
    if told.seconds > heard.seconds + SAME_S:
        found.append(f"seconds: the return says {told.seconds:.0f}, the capture lasts {heard.seconds:.0f}")
    if told.complete and not heard.complete:
        found.append("the report says that it was played to its end, the capture does not")
    if told.is_clean and not heard.is_clean:
        found.append("the report says that all goals were reached, the capture does not")
    return tuple(found)


def _score(figures: SessionFigures) -> str:
    return "no score" if figures.score is None else f"{figures.score:.0f}"


def told_words(session: ReturnedSession) -> str:
    """What the report of a session says, in a line."""
    return session_words(session.figures)


# --- captures of strangers --------------------------------------------------------------------------------------------


def checked_capture(data: bytes, source: str, place: str) -> Capture:
    """The capture in `data`, no larger than anybody plays; raises `BadInput` of `source` at `place`."""
    fault = _too_much(data)
    if fault is not None:
        raise BadInput(source, place, f"a capture {fault}")
    return parse_capture(data, f"{source}: {place}")


def _too_much(data: bytes) -> str | None:
    """What there is too much of in a capture; None where nobody could not have played it."""
    notes = log_bytes = passes = count = 0
    times_ns = [0, 0]
    for count, (kind, at_ns, start, end) in enumerate(_records(data), 1):
        times_ns = [at_ns if count == 1 else times_ns[0], at_ns]
        if count > MOST_RECORDS:
            return f"of more than {MOST_RECORDS} records"
        if kind != RecordKind.ANNOTATION:
            continue
        log_bytes += end - start
        if log_bytes > MOST_LOG_BYTES:
            return f"with more than {MOST_LOG_BYTES >> 20} MiB of remarks"
        asked = _pass_in(data[start:end])
        if asked is None:
            continue
        passes, notes = passes + 1, notes + asked.notes
        if passes > MOST_BEGUN or notes > MOST_NOTES:
            return f"of more than {MOST_BEGUN} sessions, or of passes with more than {MOST_NOTES} notes"
        if not asked.has_human_tempi:
            return f"of a session at a tempo beyond {SLOWEST_BPM:g} to {FASTEST_BPM:g} quarter notes a minute"
    seconds = max(times_ns[1] - times_ns[0], 0) / NS_PER_S
    if count > SPARE_RECORDS + MOST_A_SECOND * seconds:
        return f"of {count} records in {seconds:.0f} s"
    return None


def _records(data: bytes) -> Iterator[tuple[int, int, int, int]]:
    """Kind, time, and start and end of the payload of every record that is whole; nothing is understood yet."""
    at = len(MAGIC)
    while at + _HEAD.size + _CHECK_BYTES <= len(data):
        kind, _, size, at_ns = _HEAD.unpack_from(data, at)
        start = at + _HEAD.size
        at = start + size + _CHECK_BYTES
        if at <= len(data):
            yield kind, at_ns, start, start + size


@dataclass(frozen=True, slots=True)
class _AskedPass:
    """How many notes a remark that begins passes asks for, and whether at tempi that there are."""

    notes: int
    has_human_tempi: bool


def _pass_in(remark: bytes) -> _AskedPass | None:
    """What a remark begins; None where it is none that begins passes, as its reader will say."""
    try:
        said = json.loads(remark)
        passes, notes, tempos = said["passes"], said["notes"], said["tempos"]
        if not isinstance(passes, int):
            return None
        beats_a_minute = [60_000_000 / us for _, us in tempos]  # microseconds a quarter note
        return _AskedPass(passes * len(notes), all(SLOWEST_BPM <= bpm <= FASTEST_BPM for bpm in beats_a_minute))
    except (ValueError, TypeError, KeyError, RecursionError, ArithmeticError):
        return None
