"""Which notes of a MIDI file are buzz rolls; lengths as programs write them."""

import numpy as np

from station.core.pieces import Piece
from station.music.formats.smf.held_notes import held_notes

K, S, H = Piece.KICK, Piece.SNARE, Piece.HIHAT


def held(*notes: tuple[int, Piece, int], shortest: int = 120) -> list[bool]:
    """Of notes (tick, piece, length), 480 ticks a quarter."""
    columns = [np.array(column, np.int64) for column in zip(*notes, strict=True)]
    ticks, pieces, lasts = columns
    found = held_notes(ticks, lasts, pieces.astype(np.uint8), np.zeros(len(notes), np.uint8), shortest)
    return [bool(is_held) for is_held in found]


def test_a_held_note_among_short_strokes_is_a_buzz() -> None:
    assert held((0, K, 60), (0, S, 240), (480, S, 60)) == [False, True, False]


def test_a_bound_roll_is_one_without_a_single_stroke() -> None:
    assert held((0, K, 60), (0, S, 240), (240, S, 240), (480, S, 240)) == [False, True, True, True]


def test_a_snare_that_an_editor_draws_longer_is_no_roll() -> None:
    """Backbeats of an eighth over kicks of a sixteenth."""
    assert not any(held((0, K, 60), (480, S, 240), (960, K, 60), (1440, S, 240), (1920, K, 60)))


def test_where_lengths_differ_they_mean_nothing() -> None:
    assert not any(held((0, K, 50), (100, K, 71), (200, S, 480), (700, S, 60)))


def test_other_pieces_do_not_buzz() -> None:
    assert not any(held((0, H, 480), (480, H, 60), (480, K, 60), (960, S, 60)))


def test_files_of_one_length_have_none() -> None:
    assert not any(held((0, S, 240), (240, S, 240), (480, S, 240)))
