"""Performances and matchings as values."""

from dataclasses import replace

import numpy as np
import pytest

from station.core.events import Choke, Hit
from station.core.pieces import Articulation, Limb, Piece, Zone
from station.music.judgement import Label, Matching
from station.music.performance import HIT_DTYPE, Performance

LATE = Hit(20, Piece.HIHAT, Zone.EDGE, 60, openness=0.5, midi_note=26)
EARLY = Hit(10, Piece.SNARE, Zone.RIM, 90, Articulation.CROSS_STICK, position=0.25, limb=Limb.LEFT_HAND, midi_note=37)


def test_hits_are_ordered_by_time_and_come_back_as_they_were() -> None:
    assert list(Performance.from_hits([LATE, EARLY])) == [EARLY, LATE]


def test_hits_of_one_time_keep_their_order() -> None:
    hits = [Hit(5, Piece(piece), Zone.HEAD, 80) for piece in (9, 0, 3, 1)]
    assert [h.piece for h in Performance.from_hits(hits)] == [9, 0, 3, 1]


def test_a_velocity_between_two_numbers_is_kept() -> None:
    performance = Performance.from_hits([replace(EARLY, velocity_fraction=0.25), LATE])
    assert performance.fine_velocity.tolist() == [90.25, 60.0]
    assert performance[0].fine_velocity == 90.25


def test_what_the_kit_cannot_tell_is_none() -> None:
    assert Performance.from_hits([LATE])[0].position is None
    assert Performance.from_hits([EARLY])[0].openness is None


def test_chokes_are_ordered_by_time() -> None:
    performance = Performance.from_hits([], [Choke(9, Piece.CRASH_1), Choke(4, Piece.RIDE)])
    assert performance.chokes["at_ns"].tolist() == [4, 9]
    assert performance.chokes["piece"].tolist() == [Piece.RIDE, Piece.CRASH_1]


def test_nothing_played_is_a_performance_too() -> None:
    assert len(Performance.from_hits([])) == 0
    assert len(Performance.from_array(np.empty(0, HIT_DTYPE)).chokes) == 0


def test_shifting_moves_hits_and_chokes_and_leaves_the_first_alone() -> None:
    performance = Performance.from_hits([LATE, EARLY], [Choke(15, Piece.RIDE)])
    later = performance.shifted(-100)
    assert [h.at_ns for h in later] == [-90, -80]
    assert later.chokes["at_ns"].tolist() == [-85]
    assert [h.at_ns for h in performance] == [10, 20]


def test_hits_cannot_be_changed() -> None:
    with pytest.raises(ValueError, match="read-only"):
        Performance.from_hits([LATE]).hits["velocity"] = 1


def test_labels_are_counted_once_whether_they_are_of_notes_or_hits() -> None:
    """Three notes: matched, missed, answered on another piece. Four hits: those two, an extra, an ignored one."""
    matching = Matching(
        hit_of_note=np.array([0, -1, 1]),
        note_of_hit=np.array([0, 2, -1, -1]),
        note_label=np.array([Label.MATCH, Label.MISS, Label.WRONG_PIECE], np.uint8),
        hit_label=np.array([Label.MATCH, Label.WRONG_PIECE, Label.EXTRA, Label.IGNORED], np.uint8),
    )
    assert [matching.count(label) for label in Label] == [1, 1, 1, 1, 1, 0, 0, 0]
