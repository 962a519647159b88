"""A session's `pairs.csv`: the table of `report.pairs_table`, and where in the lesson and how each stroke was played.

Bar, beat and pass are those of the note, of a stroke that answers none its own; so that the strokes can be laid over
another session of the lesson, at whatever tempo (`records.previous_session`).
"""

import csv
import io

import numpy as np

from station.core.pieces import Articulation, Piece, Zone, word
from station.music.performance import Performance
from station.practice.session.lesson_places import places_of, ticks_of_hits
from station.practice.session.session import SessionResult
from station.scoring.report.pairs_table import COLUMNS, pair_rows

SESSION_COLUMNS = ("pass", "bar", "beat", "hit_piece", "hit_zone", "hit_articulation", "hit_velocity", "hit_openness")


def session_pairs_csv(result: SessionResult) -> str:
    """The table as text: `COLUMNS` and `SESSION_COLUMNS`; fields are empty where there is no hit."""
    text = io.StringIO()
    rows = csv.writer(text, lineterminator="\n")
    rows.writerow(COLUMNS + SESSION_COLUMNS)
    notes = places_of(result, result.score.notes["tick"])
    hits = places_of(result, ticks_of_hits(result, result.performance.hits["at_ns"]))
    for note, hit, fields in pair_rows(result.score, result.performance, result.alignment):
        place = notes[note] if note >= 0 else hits[hit]
        rows.writerow((*fields, *_place(place), *(_stroke(result.performance, hit) if hit >= 0 else _NO_STROKE)))
    return text.getvalue()


_NO_STROKE = ("",) * 5


def _place(place: np.void) -> tuple[int, int, str]:
    return int(place["pass"]), int(place["bar"]), f"{float(place['beat']):.6g}"


def _stroke(performance: Performance, index: int) -> tuple[str, str, str, str, str]:
    row = performance.hits[index]
    openness = "" if np.isnan(row["openness"]) else f"{float(row['openness']):.3g}"
    names = word(Piece(int(row["piece"]))), word(Zone(int(row["zone"]))), word(Articulation(int(row["articulation"])))
    return (*names, f"{performance.fine_velocity[index]:.6g}", openness)
