"""A session's documents as rows of the history, read with suspicion: anybody may have written into the folder.

What is missing in a document of ours is no data; what has another type or lies out of range is no data either, but for
what a row cannot do without, which raises `ValueError`, `TypeError` or `KeyError`.
"""

import csv
import io
import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from functools import lru_cache
from typing import Any, TypeVar

from station.core.disk.utf8 import one_line
from station.practice.history.exam_words import exam_result
from station.store.rows import FigureRow, JudgementRow, Part, SessionKind, SessionRow

Table = Mapping[str, object]
TAKE_TITLE = "Just play"
_MOST = 1e6
"""No pass, bar, beat, second or millisecond of a session is beyond it (our choice: of seconds that is twelve days)."""
_MOST_S = 86_400.0
_MOST_COUNT = 10_000_000
"""So many strokes nobody plays in a session (our choice: a day without a rest)."""
_MOST_NAMES = 100
"""So many limbs or pieces no report has (our choice: both have some twenty)."""
_LONGEST = {"level": 20, "name": 40, "lesson": 200, "words": 2000}
"""Letters of what the history keeps for itself; the documents keep all of them."""
_MOST_MIDI, _HARDEST = 127, 128.0
_FIRST_SIDE = 1
"""The side of the first player of a battle; 0 is the drummer's."""
_T = TypeVar("_T")


def lesson_row(blank: SessionRow, report: Table, exam: object) -> SessionRow:
    """The session of a lesson that `report` tells of; `exam` is its exam's document, None where it was none."""
    session = _table(report["session"])
    timing = _table_or_none(report.get("timing"))
    return replace(
        blank,
        kind=SessionKind.LESSON,
        lesson=_words(session["lesson"], "lesson"),
        title=_words(session.get("title")),
        device=_words(session.get("device")),
        played_s=_needed(_number(session.get("played_s", 0.0), 0.0, _MOST_S)),  # old reports tell none
        complete=session.get("complete") is True,
        score=_number(report.get("score"), 0.0, 100.0),
        level=_words(report.get("level"), "level"),
        beats_a_minute=_number(session.get("beats_a_minute"), 0.0, _MOST),
        notes=_count(_table_or_none(report.get("counts")).get("notes")),
        right=_count(report.get("right")),
        exam=exam_result(exam),
        **_timing(timing),
        **_asked(session, _table_or_none(report.get("mastery"))),
    )


def _asked(session: Table, mastery: Table) -> dict[str, Any]:
    """What was practised under which conditions: bars, click, what was taken out, and the highest tempo."""
    bars = session.get("bars")
    first, last = bars if isinstance(bars, list) and len(bars) == 2 else (None, None)
    click, gap = session.get("click"), session.get("gap")
    tempi = [_number(table.get(key), 0.0, _MOST) for table, key in _tempi(session, mastery)]
    return {
        "first_bar": _bar(first),
        "last_bar": _bar(last),
        "click": click if isinstance(click, bool) else None,
        "gap": _words(gap, "name") or None,
        "input_latency_ms": _number(session.get("input_latency_ms"), -_MOST, _MOST),
        "output_latency_ms": _number(session.get("output_latency_ms"), -_MOST, _MOST),
        "top_beats_a_minute": max((each for each in tempi if each is not None), default=None),
    }


def _tempi(session: Table, mastery: Table) -> Iterator[tuple[Table, str]]:
    """Where a report names its tempi: the session's, those that it rose to, those of passes that followed."""
    yield session, "beats_a_minute"
    for listed in (session.get("tempi"), mastery.get("passes")):
        for each in listed[:_MOST_NAMES] if isinstance(listed, list) else ():
            yield _table_or_none(each), "beats_a_minute"


def _bar(value: object) -> int | None:
    found = _number(value, 1, _MOST_COUNT)
    return None if found is None else int(found)


def exam_row(blank: SessionRow, exam: Table) -> SessionRow:
    """The exam that was looked at and not played yet."""
    return replace(blank, lesson=_words(exam["lesson"], "lesson"), title=_words(exam.get("title")))


def take_row(blank: SessionRow, take: Table) -> SessionRow:
    """What was just played."""
    return replace(
        blank,
        kind=SessionKind.TAKE,
        title=TAKE_TITLE,
        played_s=_needed(_number(take["length_s"], 0.0, _MOST_S)),
        complete=True,
        beats_a_minute=_number(take.get("tempo_bpm"), 0.0, _MOST) if take.get("click") is True else None,
    )


def battle_row(blank: SessionRow, battle: Table) -> SessionRow:
    """A battle, as the first of its players saw it."""
    rules, sides = _table(battle["rules"]), [_table(each) for each in _listed(battle["scores"])]
    turns = [_table(turn) for each in _listed(battle["rounds"]) for turn in _listed(_table(each)["turns"])]
    ours = [_table_or_none(turn.get("marks")) for turn in turns if turn.get("side") == _FIRST_SIDE]
    names = [_words(side.get("name")) for side in sides if side.get("drummer") is not True]
    drummer = [_words(side.get("name")) for side in sides if side.get("drummer") is True]
    others = drummer if len(names) == 1 else names[1:]
    return replace(
        blank,
        kind=SessionKind.BATTLE,
        title=_words(f"Battle with {', '.join(filter(None, others))}" if any(others) else "Battle"),
        device=_words(next((side.get("device") for side in sides if side.get("side") == _FIRST_SIDE), "")),
        played_s=_battle_s(rules, turns),
        complete=battle.get("complete") is True,
        level=_words(rules.get("level"), "level"),
        beats_a_minute=_number(rules.get("tempo_bpm"), 0.0, _MOST),
        notes=sum(_count(marks.get("notes")) for marks in ours),
        right=sum(_count(marks.get("right")) for marks in ours),
    )


def _battle_s(rules: Table, turns: list[Table]) -> float:
    """To the end of its last turn; 0 where nobody says how long a bar is."""
    meter = rules.get("meter")
    beats, unit = meter if isinstance(meter, list) and len(meter) == 2 else (None, None)
    beats, unit, tempo = (_number(each, 1.0, _MOST) for each in (beats, unit, rules.get("tempo_bpm")))
    if not turns or beats is None or unit is None or tempo is None:
        return 0.0
    bar_s = beats * 4.0 / unit * 60.0 / tempo
    ends = (
        (_number(turn.get("starts_s"), 0.0, _MOST_S) or 0.0) + (_number(turn.get("bars"), 0, _MOST) or 0.0) * bar_s
        for turn in turns
    )
    return min(max(ends), _MOST_S)


def figure_rows(report: Table) -> tuple[FigureRow, ...]:
    """The figures by limb and by piece of a report."""
    return (*_figures(Part.LIMB, report.get("per_limb")), *_figures(Part.PIECE, report.get("per_piece")))


def _figures(part: Part, groups: object) -> Iterator[FigureRow]:
    for name, each in list(_table_or_none(groups).items())[:_MOST_NAMES]:
        group = _table_or_none(each)
        if group and len(name) <= _LONGEST["name"]:
            notes, matched, misses, wrong = (
                _count(group.get(key)) for key in ("notes", "matched", "misses", "wrong_piece")
            )
            timing = _timing(_table_or_none(group.get("timing")))
            yield FigureRow(part, name, notes, matched, misses, wrong, **timing)


def _timing(timing: Table) -> dict[str, Any]:
    return {
        "strokes": _count(timing.get("strokes")),
        "mean_ms": _number(timing.get("mean_signed_asynchrony_ms"), -_MOST, _MOST),
        "sd_ms": _number(timing.get("sd_asynchrony_ms"), 0.0, _MOST),
    }


# --- pairs.csv --------------------------------------------------------------------------------------------------------


def judgement_rows(table: str) -> tuple[JudgementRow, ...]:
    """The lines of a session's pairs.csv; none where it has not all columns, as in old sessions.

    Raises `ValueError`, `IndexError` or `csv.Error` where it is damaged.
    """
    lines = csv.reader(io.StringIO(table, newline=""))
    head = next(lines, [])
    if not {"pass", "bar", "beat", "hit_piece"} <= set(head):
        return ()
    places = [(head.index(column), read, is_needed) for column, read, is_needed in _COLUMNS]
    return tuple(
        JudgementRow._make(_field(line[at], read, is_needed) for at, read, is_needed in places)
        for line in lines
        if line
    )


def _field(text: str, read: Callable[[str], _T], is_needed: bool) -> _T | None:
    """What a field says; None where it is empty and may be."""
    return read(text) if text or is_needed else None


@lru_cache(maxsize=256)
def _word(text: str) -> str:
    if not 0 < len(text) <= _LONGEST["level"] or not text.isprintable():
        raise ValueError(text)
    return text


def _whole(most: int) -> Callable[[str], int]:
    def read(text: str) -> int:
        number = int(text)
        if not 0 <= number <= most:
            raise ValueError(text)
        return number

    return read


def _within(least: float, most: float) -> Callable[[str], float]:
    def read(text: str) -> float:
        number = float(text)
        if not least <= number <= most:  # also NaN
            raise ValueError(text)
        return number

    return read


_COLUMNS: tuple[tuple[str, Callable[[str], Any], bool], ...] = (
    ("label", _word, True),
    ("pass", _whole(_MOST_COUNT), True),
    ("bar", _whole(_MOST_COUNT), True),
    ("beat", _within(-_MOST, _MOST), True),
    ("note_index", _whole(_MOST_COUNT), False),
    ("note_time_s", _within(-_MOST, _MOST), False),
    ("note_midi", _whole(_MOST_MIDI), False),
    ("hit_index", _whole(_MOST_COUNT), False),
    ("hit_time_s", _within(-_MOST, _MOST), False),
    ("hit_midi", _whole(_MOST_MIDI), False),
    ("hit_piece", _word, False),
    ("hit_zone", _word, False),
    ("hit_articulation", _word, False),
    ("hit_velocity", _within(0.0, _HARDEST), False),
    ("hit_openness", _within(0.0, 1.0), False),
)
"""The table's columns in the order of a judgement's fields, how each is read, and whether it may not be empty."""


# --- values -----------------------------------------------------------------------------------------------------------


def _table(value: object) -> Table:
    if not isinstance(value, dict):
        raise TypeError("no table")
    return value


def _table_or_none(value: object) -> Table:
    return value if isinstance(value, dict) else {}


def _listed(value: object) -> list[object]:
    if not isinstance(value, list):
        raise TypeError("no list")
    return value


def _needed(value: float | None) -> float:
    if value is None:
        raise ValueError("out of range")
    return value


def _number(value: object, least: float, most: float) -> float | None:
    if isinstance(value, bool) or not isinstance(value, int | float) or not least <= value <= most:
        return None  # also NaN
    return float(value) if math.isfinite(value) else None


def _count(value: object) -> int:
    return int(_number(value, 0, _MOST_COUNT) or 0)


def _words(value: object, what: str = "words") -> str:
    return one_line(value)[: _LONGEST[what]] if isinstance(value, str) else ""
