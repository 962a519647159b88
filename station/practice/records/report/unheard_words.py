"""Where in a session no stroke could be heard, for programs and for people: the report's `unheard`."""

import numpy as np

from station.core.counts import counted
from station.core.units import NS_PER_S
from station.music.judgement import Label
from station.practice.session.session import SessionResult
from station.scoring.matching.unheard import Span, notes_within
from station.scoring.report.assessment_document import Json


def unheard_rows(result: SessionResult) -> list[Json]:
    """Each span: `from_s` and `until_s` of the music, from the first beat of the first pass; its bars; its notes.

    `bars` are the first and last of the lesson, from 1, that it touches; `unknown` the notes that nobody can judge.
    """
    return [_row(result, span) for span in result.unheard]


def _row(result: SessionResult, span: Span) -> Json:
    score, names = result.score, result.plan.practised_bars
    ticks = score.tempo_map.ticks_at_ns(np.clip(span, 0, max(result.plan.score.length_ns - 1, 0)))
    first, last = (names[min(int(bar), len(names) - 1)] + 1 for bar in score.tempo_map.bars_at(ticks))
    unknown = notes_within(score, [span]) & (result.alignment.note_label == Label.UNKNOWN)
    return {
        "from_s": round(span[0] / NS_PER_S, 3),
        "until_s": round(span[1] / NS_PER_S, 3),
        "bars": [first, last],
        "unknown": int(unknown.sum()),
    }


def unheard_text(rows: Json) -> str:
    """A line a span; empty where all could be heard."""
    assert isinstance(rows, list), "the report is ours"
    lines = [_line(row) for row in rows if isinstance(row, dict)]
    return "\n".join(["", "Could not be heard", *lines, ""]) if lines else ""


def _line(row: dict[str, Json]) -> str:
    bars, unknown = row["bars"], row["unknown"]
    assert isinstance(bars, list), "the report is ours"
    assert isinstance(unknown, int), "the report is ours"
    where = f"bar {bars[0]}" if bars[0] == bars[1] else f"from bar {bars[0]} on, back in bar {bars[1]}"
    notes = f"{counted(unknown, 'note')} without a stroke {'is' if unknown == 1 else 'are'} unknown, not missed"
    return f"* from {row['from_s']:.1f} s to {row['until_s']:.1f} s ({where}): {notes}"
