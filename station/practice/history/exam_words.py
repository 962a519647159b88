"""What an exam came to, in a few words."""

from station.drills.exam.rubric import BANDS

SCHEMA = "drum-station/exam/1"


def exam_result(document: object) -> str:
    """What the exam of an `exam.json` came to; empty where it is none of ours, or has no marks."""
    marks = document.get("marks") if isinstance(document, dict) and document.get("schema") == SCHEMA else None
    if not isinstance(marks, dict):
        return ""
    total, band = marks.get("total"), marks.get("band")
    if not isinstance(total, int | float) or not 0 <= total <= 100 or band not in [each.name for each in BANDS]:
        return ""
    return f"{band}, {shown_total(total)} of 100"


def shown_total(total: float) -> str:
    """A total of 100 as it is shown: never rounded up."""
    return f"{int(total * 10) / 10:.1f}"
