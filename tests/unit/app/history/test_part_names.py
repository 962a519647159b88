"""Columns are called as drummers call limbs and pieces."""

import pytest

from station.app.history.part_names import full_name, short_name
from station.core.pieces import Limb, Piece, word
from station.store.rows import Part

LONGEST = 11
"""Letters that a column of the table is meant for."""


@pytest.mark.parametrize(
    ("part", "name", "full", "short"),
    [
        (Part.PIECE, "hihat", "hi-hat", "hi-hat"),
        (Part.PIECE, "tom_1", "high tom", "high tom"),
        (Part.PIECE, "floor_tom_1", "floor tom", "floor tom"),
        (Part.PIECE, "floor_tom_2", "second floor tom", "floor tom 2"),
        (Part.PIECE, "hihat_pedal", "hi-hat foot", "hat foot"),
        (Part.PIECE, "some_gong", "some gong", "some gong"),
        (Part.LIMB, "right_hand", "right hand", "R hand"),
        (Part.LIMB, "left_foot", "left foot", "L foot"),
    ],
)
def test_names(part: Part, name: str, full: str, short: str) -> None:
    assert (full_name(part, name), short_name(part, name)) == (full, short)


def test_short_names_are_short_and_told_apart() -> None:
    shorts = [short_name(Part.PIECE, word(piece)) for piece in Piece]
    shorts += [short_name(Part.LIMB, word(limb)) for limb in Limb if limb is not Limb.UNKNOWN]
    assert len(set(shorts)) == len(shorts)
    assert max(map(len, shorts)) <= LONGEST
