"""What sensors on the sticks add to a session's report: the key `sticks`, and lines of text on hands and sticks."""

from collections.abc import Sequence

from station.core.events import Hit, StickStroke
from station.core.pieces import word
from station.practice.records.report.phase_words import phase_lines
from station.practice.records.report.what_next import table_in
from station.scoring.analysis.fault_table import Asked
from station.scoring.report.assessment_document import Json
from station.sync.strokes.stick_remarks import StickFigures, StickRemark, stick_report

AT_LIMIT = "Some strokes were beyond a gyro's range: set the sensor to a wider one, if it has one"
MOST_REMARKS = 3
"""A result's page has room for so many remarks beside all else; the report has them all."""


def sticks_document(felt: Sequence[tuple[Hit, StickStroke]], asked: Asked | None = None) -> dict[str, Json] | None:
    """How the sticks were used, from hits each with the stroke that made it; None without sensors.

    `asked` are the sizes from which the lesson minds remarks.
    """
    report = stick_report(felt, asked)
    if report is None:
        return None
    return {
        "hands": {word(limb): _figures(figures) for limb, figures in report.hands.items()},
        "remarks": [_remark(remark) for remark in report.remarks],
    }


def _figures(figures: StickFigures) -> dict[str, Json]:
    return {
        "strokes": figures.strokes,
        "height_cm": None if figures.height_m is None else round(100 * figures.height_m, 1),
        "speed_m_s": None if figures.speed_m_s is None else round(figures.speed_m_s, 2),
        "rebound": None if figures.rebound is None else round(figures.rebound, 2),
        "clipped_share": round(figures.clipped, 3),
    }


def _remark(remark: StickRemark) -> dict[str, Json]:
    return {
        "remark": remark.kind,
        "text": remark.text,
        "effect": round(remark.effect, 3),
        "ci": [round(end, 3) for end in remark.ci],
        "unit": remark.unit,
    }


# --- text -------------------------------------------------------------------------------------------------------------


def sticks_text(document: dict[str, Json]) -> str:
    """A paragraph on the sticks; nothing without sensors."""
    if document.get("sticks") is None:
        return ""
    sticks = table_in(document, "sticks")
    lines = [_line(limb.replace("_", " "), figures) for limb, figures in table_in(sticks, "hands").items()]
    lines += [f"* {text}" for text in _remarks(document)]
    if any(isinstance(figures, dict) and figures["clipped_share"] for figures in table_in(sticks, "hands").values()):
        lines.append(f"* {AT_LIMIT}")
    return "\n".join(["", "Sticks", *lines, ""])


def _line(hand: str, figures: Json) -> str:
    assert isinstance(figures, dict), "the report is ours"
    told = [
        f"{figures[key]:{spec}} {unit}"
        for key, spec, unit in (("height_cm", ".0f", "cm high"), ("speed_m_s", ".1f", "m/s fast"))
        if isinstance(figures[key], float)
    ]
    clipped = figures["clipped_share"]
    assert isinstance(clipped, float)
    if clipped > 0:
        told.append(f"the sensor at its limit in {clipped:.0%}, so that they were faster still")
    return f"{hand}: {figures['strokes']} strokes" + (f", {', '.join(told)}" if told else "")


def stick_lines(document: dict[str, Json]) -> list[str]:
    """What a result's page says of hands and sticks: the sticking, the first remarks, and how the hands lean."""
    return [*sticking_lines(document), *_remarks(document)[:MOST_REMARKS], *phase_lines(document)]


def _remarks(document: dict[str, Json]) -> list[str]:
    if document.get("sticks") is None:
        return []
    remarks = table_in(document, "sticks")["remarks"]
    assert isinstance(remarks, list), "the report is ours"
    return [str(remark["text"]) for remark in remarks if isinstance(remark, dict)]


def sticking_lines(document: dict[str, Json]) -> list[str]:
    """A line on the hands, none without sensors on the sticks or where no hand is asked for."""
    if document.get("sticking") is None:
        return []
    sticking = table_in(document, "sticking")
    right, wrong, doubtful = (sticking[key] for key in ("right", "wrong", "cannot_tell"))
    bars = sticking["wrong_bars"]
    assert isinstance(right, int)
    assert isinstance(wrong, int)
    assert isinstance(bars, list), "the report is ours"
    if not right + wrong:
        return []
    names = [str(one["bar"]) for one in bars if isinstance(one, dict)]
    where = f", the others in bar{'s' * (len(names) > 1)} {', '.join(names)}" if names else ""
    doubt = f"; {doubtful} cannot be told" if doubtful else ""
    return [f"Sticking: {right} of {right + wrong} strokes from the hand that is written{where}{doubt}"]
