"""What the phase of the sticks adds to a session's report: the key `phase`, and lines of text."""

from station.core.pieces import word
from station.practice.records.report.what_next import table_in
from station.practice.session.played_phase import PlayedPhase
from station.scoring.analysis.fault_table import Asked
from station.scoring.report.assessment_document import Json
from station.sync.drill.phase_feedback import HandLean, hand_leans


def phase_document(played: PlayedPhase | None, asked: Asked | None = None) -> dict[str, Json] | None:
    """How far the sticks were followed through the drill, and how each hand leans; None where nobody tracked them.

    `asked` are the sizes from which the lesson minds a lean.
    """
    if played is None:
        return None
    return {
        "locked_share": round(played.locked / played.steps, 3),
        "hands": {word(lean.limb): _lean(lean, asked or Asked()) for lean in hand_leans(played.offsets)},
    }


def _lean(lean: HandLean, asked: Asked) -> dict[str, Json]:
    return {
        "fault": _fault(lean, asked),
        "sure": _is_sure(lean),
        "strokes": lean.strokes,
        "late_ms": round(lean.late_ms, 1),
        "ci": None if lean.ci_ms is None else [round(end, 1) for end in lean.ci_ms],
        "sd_ms": round(lean.sd_ms, 1),
        "late_beats": round(lean.late_beats, 4),
    }


def _fault(lean: HandLean, asked: Asked) -> str | None:
    """The word for a lean that is sure, and large enough for the lesson; None of another."""
    fault = "hand_behind" if lean.late_ms > 0 else "hand_ahead"
    return fault if _is_sure(lean) and abs(lean.late_ms) >= asked.least(fault) else None


def _is_sure(lean: HandLean) -> bool:
    return lean.ci_ms is not None and lean.ci_ms[0] * lean.ci_ms[1] > 0


# --- text -------------------------------------------------------------------------------------------------------------


def phase_lines(document: dict[str, Json]) -> list[str]:
    """How long the sticks were followed, and how each hand leans; nothing where nobody tracked them."""
    if document.get("phase") is None:
        return []
    phase = table_in(document, "phase")
    share = phase["locked_share"]
    assert isinstance(share, float), "the report is ours"
    followed = f"Motion: your sticks were followed through the drill {share:.0%} of the time"
    leans = [_line(limb.replace("_", " "), lean) for limb, lean in table_in(phase, "hands").items()]
    return [followed, *leans]


def _line(hand: str, lean: Json) -> str:
    assert isinstance(lean, dict), "the report is ours"
    late_ms, spread_ms = lean["late_ms"], lean["sd_ms"]
    assert isinstance(late_ms, float), "the report is ours"
    side = {"hand_behind": "behind", "hand_ahead": "ahead of"}.get(str(lean["fault"]))
    leans = f"{abs(late_ms):.0f} ms {side}" if side is not None else "" if lean["sure"] else "leans neither way from"
    return f"Motion: {hand}{f' {leans} the common motion of both,' if leans else ''} spread (SD) {spread_ms:.0f} ms"
