"""What became of every note of the practised section, over all its passes."""

import numpy as np
from numpy.typing import NDArray

from station.core.labels import piece_name
from station.core.pieces import Piece
from station.core.units import NS_PER_MS
from station.music.judgement import Label
from station.music.score import Score
from station.practice.session.session import SessionResult
from station.render.report.page.session_page import NotePasses, NoteState
from station.scoring.matching.hit_windows import Windows


def note_passes(result: SessionResult, section: Score, section_note: NDArray[np.int64]) -> tuple[NotePasses, ...]:
    """The notes of `section` (n,); `section_note` says which of them each judged note is."""
    label, windows = result.alignment.note_label, result.plan.level.windows
    off_ms = result.alignment.asynchrony_ns / NS_PER_MS
    rows_of: list[list[int]] = [[] for _ in range(len(section))]
    for row, note in enumerate(section_note.tolist()):
        if note >= 0:
            rows_of[note].append(row)
    pieces = [piece_name(Piece(piece)) for piece in section.notes["piece"].tolist()]
    graces = section.is_grace.tolist()
    return tuple(
        _of_rows(piece, label[rows], off_ms[rows], None if is_grace else windows)
        for piece, rows, is_grace in zip(pieces, rows_of, graces, strict=True)
    )


def state_of(label: int, off_ms: float, windows: Windows | None) -> NoteState:
    """What a note of one pass is shown as; None for `windows` of a grace stroke, which has no time of its own."""
    match Label(label):
        case Label.MATCH:
            lean = 0 if windows is None else windows.lean(off_ms)
            return (NoteState.EARLY, NoteState.MATCH, NoteState.LATE)[lean + 1]
        case Label.WRONG_PIECE:
            return NoteState.WRONG_PIECE
        case Label.UNKNOWN:
            return NoteState.UNKNOWN
        case _:
            return NoteState.MISS


def _of_rows(piece: str, label: NDArray[np.uint8], off_ms: NDArray[np.float64], windows: Windows | None) -> NotePasses:
    """A note by its passes: missed where half of them missed it, else early and late by their mean."""
    is_played = label == Label.MATCH
    played, wrong, unknown = (int((label == each).sum()) for each in (Label.MATCH, Label.WRONG_PIECE, Label.UNKNOWN))
    mean_ms = float(off_ms[is_played].mean()) if played else None
    known = len(label) - unknown
    if not len(label):
        state = NoteState.UNPLAYED
    elif not known:
        state = NoteState.UNKNOWN
    elif mean_ms is not None and 2 * played > known:
        state = state_of(Label.MATCH, mean_ms, windows)
    else:
        state = NoteState.WRONG_PIECE if 2 * wrong > known else NoteState.MISS
    return NotePasses(piece, state, len(label), played, wrong, unknown, mean_ms)
