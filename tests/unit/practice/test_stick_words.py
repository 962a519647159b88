"""What the report and a result's page say of the sticks. Expected: worked out by hand."""

from station.core.events import Hit, StickStroke
from station.core.pieces import Limb, Piece, Zone
from station.practice.records.report.stick_words import AT_LIMIT, stick_lines, sticks_document, sticks_text
from station.scoring.report.assessment_document import Json

HANDS = (Limb.RIGHT_HAND, Limb.LEFT_HAND)


def document(remarks: int) -> dict[str, Json]:
    said: list[Json] = [{"text": f"Remark {k}"} for k in range(remarks)]
    sticking: Json = {"right": 7, "wrong": 1, "cannot_tell": 0, "wrong_bars": [{"bar": 2, "wrong": 1}]}
    return {"sticks": {"hands": {}, "remarks": said}, "sticking": sticking}


def text(clipped: tuple[int, ...]) -> str:
    felt = [
        (
            Hit(index, Piece.SNARE, Zone.HEAD, 90),
            StickStroke(index, "s", HANDS[index % 2], 9.0, clipped=index in clipped),
        )
        for index in range(8)
    ]
    return sticks_text({"sticks": sticks_document(felt)})


def test_a_page_has_the_sticking_and_three_remarks_and_the_report_all() -> None:
    lines = stick_lines(document(5))
    assert lines[0] == "Sticking: 7 of 8 strokes from the hand that is written, the others in bar 2"
    assert lines[1:] == ["Remark 0", "Remark 1", "Remark 2"]
    assert "* Remark 4" in sticks_text(document(5))


def test_without_sensors_nothing_is_said() -> None:
    assert stick_lines({"sticks": None, "sticking": None}) == []
    assert sticks_text({"sticks": None}) == ""


def test_a_gyro_at_its_limit_is_said_once_with_what_to_do() -> None:
    assert text((0, 1, 2)).count(AT_LIMIT) == 1


def test_nothing_is_said_of_a_range_that_was_wide_enough() -> None:
    assert AT_LIMIT not in text(())
