"""What the phase of the sticks adds to a session's report: the key `phase`, and lines of text."""

from station.core.pieces import word
from station.practice.records.what_next import table_in
from station.practice.session.played_phase import PlayedPhase
from station.scoring.report.assessment_document import Json
from station.sync.drill.phase_feedback import HandLean, hand_leans


def phase_document(played: PlayedPhase | None) -> dict[str, Json] | None:
    """How far the sticks were followed through the drill, and how each hand leans; None where nobody tracked them."""
    if played is None:
        return None
    return {
        "locked_share": round(played.locked / played.steps, 3),
        "hands": {word(lean.limb): _lean(lean) for lean in hand_leans(played.offsets)},
    }


def _lean(lean: HandLean) -> dict[str, Json]:
    return {
        "strokes": lean.strokes,
        "late_ms": round(lean.late_ms, 1),
        "ci": None if lean.ci_ms is None else [round(end, 1) for end in lean.ci_ms],
        "sd_ms": round(lean.sd_ms, 1),
        "late_beats": round(lean.late_beats, 4),
    }


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
    late_ms, spread_ms, ci = lean["late_ms"], lean["sd_ms"], lean["ci"]
    assert isinstance(late_ms, float), "the report is ours"
    is_sure = isinstance(ci, list) and isinstance(ci[0], float) and isinstance(ci[1], float) and ci[0] * ci[1] > 0
    side = f"{abs(late_ms):.0f} ms {'behind' if late_ms > 0 else 'ahead of'}" if is_sure else "leans neither way from"
    return f"Motion: {hand} {side} the common motion of both, spread (SD) {spread_ms:.0f} ms"
