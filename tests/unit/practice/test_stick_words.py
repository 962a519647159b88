"""What the report says of a gyro at its limit. Expected: worked out by hand."""

from station.core.events import Hit, StickStroke
from station.core.pieces import Limb, Piece, Zone
from station.practice.records.stick_words import AT_LIMIT, sticks_document, sticks_text

HANDS = (Limb.RIGHT_HAND, Limb.LEFT_HAND)


def text(clipped: tuple[int, ...]) -> str:
    felt = [
        (
            Hit(index, Piece.SNARE, Zone.HEAD, 90),
            StickStroke(index, "s", HANDS[index % 2], 9.0, clipped=index in clipped),
        )
        for index in range(8)
    ]
    return sticks_text({"sticks": sticks_document(felt)})


def test_a_gyro_at_its_limit_is_said_once_with_what_to_do() -> None:
    assert text((0, 1, 2)).count(AT_LIMIT) == 1


def test_nothing_is_said_of_a_range_that_was_wide_enough() -> None:
    assert AT_LIMIT not in text(())
