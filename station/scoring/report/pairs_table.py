"""The matching as a table that anyone can check: the CSV of `station assess --pairs`.

A line a note, paired or missed, in the order of the score, then a line a hit that answers none, in order of time. Times
are those of the files, in seconds from their own start; `note_midi` and `hit_midi` are the numbers that the files hold,
or the General MIDI number of the piece where a file holds none. Hits that nobody counts are labelled `ignored`,
those of an attempt that does not count `played_again`.
"""

import csv
import io
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from station.core.disk.files import write_whole
from station.core.note_map import general_midi_note
from station.core.pieces import word
from station.core.units import NS_PER_S
from station.music.judgement import Label, Matching
from station.music.performance import Performance
from station.music.score import Score

COLUMNS = ("label", "note_index", "note_time_s", "note_midi", "hit_index", "hit_time_s", "hit_midi")

_WORDS = {label: word(label) for label in Label}


def write_pairs(path: Path, score: Score, performance: Performance, matching: Matching) -> None:
    """Write the table whole or not at all; raises `DeviceError` if the disk refuses."""
    write_whole(path, pairs_csv(score, performance, matching).encode())


def pairs_csv(score: Score, performance: Performance, matching: Matching) -> str:
    """The table as text: `COLUMNS`, comma-separated, with empty fields where there is no note or no hit."""
    text = io.StringIO()
    rows = csv.writer(text, lineterminator="\n")
    rows.writerow(COLUMNS)
    rows.writerows(fields for _, _, fields in pair_rows(score, performance, matching))
    return text.getvalue()


def pair_rows(
    score: Score, performance: Performance, matching: Matching
) -> Iterator[tuple[int, int, tuple[object, ...]]]:
    """Every line of the table: the index of its note and of its hit, −1 where there is none, and its fields."""
    for note, hit in enumerate(matching.hit_of_note.tolist()):
        label = _WORDS[Label(matching.note_label[note])]
        fields = _hit_fields(performance, hit) if hit >= 0 else _EMPTY
        yield note, hit, (label, *_note_fields(score, note), *fields)
    for hit in np.flatnonzero(matching.note_of_hit < 0).tolist():
        yield -1, hit, (_WORDS[Label(matching.hit_label[hit])], *_EMPTY, *_hit_fields(performance, hit))


_EMPTY = ("", "", "")


def _note_fields(score: Score, index: int) -> tuple[int, str, int]:
    note = score[index]
    midi = note.midi_note or general_midi_note(note.piece, note.zone, note.articulation, note.openness)
    return index, f"{int(score.onset_ns[index]) / NS_PER_S:.6f}", midi


def _hit_fields(performance: Performance, index: int) -> tuple[int, str, int]:
    hit = performance[index]
    midi = hit.midi_note or general_midi_note(hit.piece, hit.zone, hit.articulation, hit.openness)
    return index, f"{hit.at_ns / NS_PER_S:.6f}", midi
