"""The figures of a session's report that an exchange needs, read from a report that anybody may have written."""

from dataclasses import dataclass
from typing import Any

from station.core.toml.schema import Field, Fields, Reader, choice, flag, needed, number, text, whole
from station.core.toml.toml_faults import Faults, wrong
from station.core.units import NS_PER_S
from station.devices.capture.capture import Capture
from station.music.tempo import MAX_BPM, MIN_BPM
from station.practice.exchange.parcel_json import meaning, read_json
from station.practice.exchange.plain_words import line, or_none, words
from station.scoring.matching.hit_windows import OUR_LEVELS, Level
from station.scoring.report.assessment_schema import SCHEMA

_MOST_STROKES = 10_000_000
"""More nobody plays in a session (our choice: a day without a rest)."""
MOST_PASSES = 100_000
"""Of all sessions together (our choice: every minute of two months)."""
MOST_LAG_MS = 1_000.0
"""As `core.measured_latency.MOST_MS`."""
LONGEST_S = 100_000.0
"""No session is longer (our choice: more than a day)."""


@dataclass(frozen=True, slots=True)
class SessionFigures:
    """What a report says of a session: `score` 0–100 (None: nothing was played), notes and how many were right.

    `is_clean`: it was played to its end and missed no goal; `passes` as they were to be played, `complete` whether they
    all were; `seconds` how long it took, 0 where nobody said; `ruled` whether a teacher says that its goals are
    reached, None where they leave it as it is; `left_out_ms` is a lag of all strokes that the report does not count.
    """

    lesson: str
    title: str
    score: float | None
    notes: int
    right: int
    level: Level
    beats_a_minute: float
    passes: int
    complete: bool
    missed: tuple[str, ...]
    assignments: tuple[str, ...] = ()
    seconds: float = 0.0
    ruled: bool | None = None
    left_out_ms: float = 0.0

    @property
    def is_clean(self) -> bool:
        """Whether it was played to its end, and every goal of the lesson was reached."""
        return self.complete and not self.missed and self.notes > 0


def length_s(capture: Capture) -> float:
    """From the first to the last record of a capture, at most `LONGEST_S`."""
    records = capture.records
    seconds = (records[-1].at_ns - records[0].at_ns) / NS_PER_S if records else 0.0
    return min(max(seconds, 0.0), LONGEST_S)


def report_figures(data: bytes, source: str, place: str) -> SessionFigures:
    """The figures of the report in `data`; raises `BadInput` of `source` at `place`."""
    return meaning(read_json(data, source, place), _report, source, place)


def _some(fields: Fields) -> Reader[dict[str, Any]]:
    """These keys of a table, whatever else it says."""

    def read(raw: object) -> dict[str, Any]:
        if not isinstance(raw, dict):
            raise wrong("expected a table")
        faults = Faults()
        found = {}
        for key, each in fields.items():
            if key not in raw and each.must is not None:
                faults.miss((key,), "is missing")
            found[key] = faults.attempt(each.read, raw[key], each.default, key) if key in raw else each.default
        faults.check()
        return found

    return read


def _listed(value: object) -> list[object]:
    if not isinstance(value, list) or len(value) > _MOST_LISTED:
        raise wrong(f"expected a list of at most {_MOST_LISTED}")
    return value


_MOST_LISTED = 1000
"""Goals that a session missed, assignments that it belongs to (our choice)."""


def _missed(value: object) -> tuple[str, ...]:
    read = _some({"text": needed(words)})
    return tuple(read(entry)["text"] for entry in _listed(value))


def _ids(value: object) -> tuple[str, ...]:
    return tuple(text(entry) for entry in _listed(value))


_SESSION = _some(
    {
        "lesson": needed(line),
        "title": needed(line),
        "beats_a_minute": needed(number(MIN_BPM / 4, 4 * MAX_BPM)),
        "passes": needed(whole(1, MOST_PASSES)),
        "complete": needed(flag),
        "played_s": Field(number(0, LONGEST_S), 0.0),
        "goals_missed": Field(_missed, ()),
        "assignments": Field(_ids, ()),
    }
)
_REPORT = _some(
    {
        "schema": needed(text),
        "score": needed(or_none(number(0, 100))),
        "level": needed(choice(OUR_LEVELS, "level")),
        "right": needed(whole(0, _MOST_STROKES)),
        "counts": needed(_some({"notes": needed(whole(0, _MOST_STROKES))})),
        "session": needed(_SESSION),
        "lag": Field(or_none(_some({"left_out_ms": Field(number(-MOST_LAG_MS, MOST_LAG_MS), 0.0)})), None),
    }
)


def _report(raw: object) -> SessionFigures:
    said = _REPORT(raw)
    if said["schema"] != SCHEMA:
        raise wrong(f"is no report of a session: its schema is not {SCHEMA}", "schema")
    session = said["session"]
    return SessionFigures(
        lesson=session["lesson"],
        title=session["title"],
        score=said["score"],
        notes=said["counts"]["notes"],
        right=said["right"],
        level=said["level"],
        beats_a_minute=session["beats_a_minute"],
        passes=session["passes"],
        complete=session["complete"],
        missed=session["goals_missed"],
        assignments=session["assignments"],
        seconds=session["played_s"],
        left_out_ms=0.0 if said["lag"] is None else said["lag"]["left_out_ms"],
    )
