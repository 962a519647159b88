"""A kept session read for a page: its strokes judged again from the capture, its figures as its report has them.

A report may be a stranger's: what is no report of this capture is not believed, and that is said.
"""

import json
import math
from dataclasses import dataclass
from datetime import datetime

from station.core.errors import BadInput
from station.core.settings import Settings
from station.devices.capture.capture import written_at
from station.practice.history.exam_words import SCHEMA as EXAM_SCHEMA
from station.practice.history.session_files import DOCUMENT_NAME, EXAM_NAME
from station.practice.lag.fair_judgement import judged_as_told
from station.practice.records.earlier_lags import fair_session
from station.practice.records.recovery import recovered_of
from station.practice.records.report.session_report import practice_document
from station.practice.session.session import SessionResult
from station.scenes.report.session_place import SessionPlace
from station.scoring.report.assessment_document import Json
from station.scoring.report.assessment_schema import SCHEMA

_LONGEST_TEXT = 4000
"""Letters of one text of a report (our choice, as of what a teacher writes at length)."""
_COUNTED = ("notes", "hits", "matched", "misses", "extras", "wrong_piece", "unknown")
_SAME_MS = 0.002
"""By which a mean may differ: a report's figures are rounded to a thousandth."""
NO_REPORT = "This session has no report of its own; it was judged for this page, from its capture."
OTHER_REPORT = (
    "The report.json beside this session tells of another one, or was written by another version of the station; all "
    "figures here were judged anew from the capture."
)


@dataclass(frozen=True, eq=False)
class KeptSession:
    """A session that is over: its `result`, its report as a `document`, its `exam` where it was one.

    `at` is when it was begun, None where nobody knows; `remarks` say where figures come from if not from its report.
    """

    result: SessionResult
    document: dict[str, Json]
    exam: dict[str, Json] | None
    at: datetime | None
    remarks: tuple[str, ...] = ()


def kept_session(place: SessionPlace, settings: Settings) -> KeptSession:
    """The session that lies there; raises `BadInput` where it cannot be read."""
    at = written_at(place.capture)
    result = recovered_of(place.capture, place.source, with_phase=place.report is None)
    exam = None if place.exam is None else _exam(place.exam, place.source)
    if place.report is None:
        fair = fair_session(result, settings)
        document = _of(place.student, practice_document(fair.result, settings, fair.lag))
        return KeptSession(fair.result, document, exam, at, (NO_REPORT,))
    document = _report(place.report, place.source)
    left_out_ms = _left_out_ms(document, place.source)
    judged = judged_as_told(result, left_out_ms).result if left_out_ms else result
    if _tells_of(document, practice_document(judged, settings)):
        return KeptSession(judged, document, exam, at)
    return KeptSession(result, _of(place.student, practice_document(result, settings)), exam, at, (OTHER_REPORT,))


def _of(student: str, document: dict[str, Json]) -> dict[str, Json]:
    """A report that was made now, by the name of who played, not of who looks at it; a capture does not say whose."""
    session = document["session"]
    assert isinstance(session, dict)
    return {**document, "session": {**session, "student": student}}


def _report(data: bytes, source: str) -> dict[str, Json]:
    """A report, as our own are: finite numbers, text without letters that nobody sees."""
    document = _document(data, source, DOCUMENT_NAME)
    if not isinstance(document, dict) or document.get("schema") != SCHEMA or "session" not in document:
        raise BadInput(source, f"{DOCUMENT_NAME}: schema", f"is no report of a session: its schema is not {SCHEMA}")
    return document


def _document(data: bytes, source: str, name: str) -> Json:
    try:
        return clean(json.loads(data.decode("utf-8")), source)
    except (ValueError, RecursionError) as fault:
        raise BadInput(source, name, f"is no JSON document ({fault})") from None


def clean(value: object, source: str) -> Json:
    """A value of a JSON file that anybody may have edited; raises `BadInput` for numbers that are none."""
    match value:
        case dict():
            return {str(clean(key, source)): clean(each, source) for key, each in value.items()}
        case list():
            return [clean(each, source) for each in value]
        case str():
            shown = (letter if letter.isprintable() or letter == "\n" else " " for letter in value[:_LONGEST_TEXT])
            return "".join(shown)
        case float() if not math.isfinite(value):
            raise BadInput(source, "", "its JSON holds a number that is none")
        case None | bool() | int() | float():
            return value
        case _:
            raise BadInput(source, "", "is no JSON document")


def _left_out_ms(document: dict[str, Json], source: str) -> float:
    """What the report leaves out of the strokes as they were captured."""
    lag = document.get("lag")
    if lag is None:
        return 0.0
    left_out = lag.get("left_out_ms") if isinstance(lag, dict) else None
    if isinstance(left_out, bool) or not isinstance(left_out, int | float):
        raise BadInput(source, f"{DOCUMENT_NAME}: lag", "expected a number of milliseconds that were left out")
    return float(left_out)


def _tells_of(document: dict[str, Json], anew: dict[str, Json]) -> bool:
    """Whether a report has the counts, the mean and the session of the capture judged anew."""
    told, found = _facts(document), _facts(anew)
    if told is None or found is None or told[:-1] != found[:-1]:
        return False
    mean, found_mean = told[-1], found[-1]
    if isinstance(mean, int | float) and isinstance(found_mean, int | float):
        return abs(mean - found_mean) <= _SAME_MS
    return mean is None and found_mean is None


def _facts(document: dict[str, Json]) -> "tuple[object, ...] | None":
    """What identifies what a report tells of, its mean last; None where it lacks some."""
    tables = [document.get(name) for name in ("counts", "timing", "session")]
    counts, timing, session = tables
    if not isinstance(counts, dict) or not isinstance(timing, dict) or not isinstance(session, dict):
        return None
    said = [session.get(key) for key in ("lesson", "bars", "passes", "complete")]
    counted = [counts.get(key) for key in _COUNTED]
    return (document.get("level"), document.get("right"), *counted, *said, timing.get("mean_signed_asynchrony_ms"))


def _exam(data: bytes, source: str) -> dict[str, Json]:
    document = _document(data, source, EXAM_NAME)
    if not isinstance(document, dict) or document.get("schema") != EXAM_SCHEMA:
        raise BadInput(source, f"{EXAM_NAME}: schema", f"is no exam: its schema is not {EXAM_SCHEMA}")
    return document
