"""What the report and a result's page say of the sticks."""

from station.practice.records.stick_words import stick_lines, sticks_text
from station.scoring.report.assessment_document import Json


def document(remarks: int) -> dict[str, Json]:
    said: list[Json] = [{"text": f"Remark {k}"} for k in range(remarks)]
    sticking: Json = {"right": 7, "wrong": 1, "cannot_tell": 0, "wrong_bars": [{"bar": 2, "wrong": 1}]}
    return {"sticks": {"hands": {}, "remarks": said}, "sticking": sticking}


def test_a_page_has_the_sticking_and_three_remarks_and_the_report_all() -> None:
    lines = stick_lines(document(5))
    assert lines[0] == "Sticking: 7 of 8 strokes from the hand that is written, the others in bar 2"
    assert lines[1:] == ["Remark 0", "Remark 1", "Remark 2"]
    assert "* Remark 4" in sticks_text(document(5))


def test_without_sensors_nothing_is_said() -> None:
    assert stick_lines({"sticks": None, "sticking": None}) == []
    assert sticks_text({"sticks": None}) == ""
