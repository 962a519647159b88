"""Whether a pass was clean, and if not, what was wrong with it, in words that a student can use.

Bias and spread are judged apart (TEACHING): a lean costs nothing unless the lesson asks for it.
"""

import math
from dataclasses import dataclass
from enum import StrEnum

from station.drills.mastery.pass_facts import PassResult
from station.drills.mastery.rules import Rules


class Grade(StrEnum):
    """How good a pass was."""

    CLEAN = "clean"
    LOOSE = "loose"
    """Right but for a spread that only the slow tempo brings: no faster tempo is refused for it, none is proved."""
    BAD = "bad"
    BROKEN = "broken"
    """So much went wrong that repeating it would only teach the mistakes."""


class PassFault(StrEnum):
    """What keeps a pass from being clean."""

    RIGHT = "right"
    PADS = "pads"
    SPREAD = "spread"
    LEAN = "lean"
    SWING = "swing"
    POINTS = "points"


@dataclass(frozen=True, slots=True)
class Verdict:
    """A pass's grade, its faults, none of a clean one, and `words` for the first of them."""

    grade: Grade
    faults: tuple[PassFault, ...]
    words: str

    @property
    def is_clean(self) -> bool:
        """Whether nothing was wrong."""
        return self.grade is Grade.CLEAN


def judge(result: PassResult, rules: Rules) -> Verdict:
    """Judge a pass by the rules."""
    right, wrong = result.right, result.wrong_pads
    needed = math.ceil(rules.min_right * (result.notes + result.extras) - _TINY)
    sd_limit_ms, allowed = rules.sd_limit_ms(result.interval_ms), allowed_wrong_pads(result.notes, rules)
    found = {
        PassFault.PADS: wrong > allowed,
        PassFault.RIGHT: right < needed,
        PassFault.SPREAD: result.sd_ms is not None and result.sd_ms > sd_limit_ms,
        PassFault.LEAN: _beyond(result.lean_ms, 0.0, rules.max_lean_ms),
        PassFault.SWING: _beyond(result.swing_ratio, rules.swing_ratio, rules.max_swing_error),
        PassFault.POINTS: rules.min_points is not None
        and result.points is not None
        and result.points < rules.min_points,
    }
    words = {
        PassFault.PADS: f"{wrong} strokes on a wrong pad, {allowed} allowed",
        PassFault.RIGHT: f"{right} of {result.notes} right{_too_many(result.extras)}, {needed} needed",
        PassFault.SPREAD: f"spread {_number(result.sd_ms)} ms, {sd_limit_ms:.0f} allowed",
        PassFault.LEAN: f"{_number(result.lean_ms, '+')} ms beside the click, {_number(rules.max_lean_ms)} allowed",
        PassFault.SWING: f"swung {_ratio(result.swing_ratio)}, {_ratio(rules.swing_ratio)} is written",
        PassFault.POINTS: f"{_number(result.points)} points, {_number(rules.min_points)} needed",
    }
    faults = tuple(fault for fault, is_there in found.items() if is_there)
    return Verdict(_grade(result, faults, rules), faults, words[faults[0]] if faults else "clean")


def _grade(result: PassResult, faults: tuple[PassFault, ...], rules: Rules) -> Grade:
    if not faults:
        return Grade.CLEAN
    if result.right < rules.broken_right * (result.notes + result.extras):
        return Grade.BROKEN
    is_loose = faults == (PassFault.SPREAD,) and _within(result.sd_ms, rules.loose_share, result.interval_ms)
    return Grade.LOOSE if is_loose else Grade.BAD


def allowed_wrong_pads(notes: int, rules: Rules) -> int:
    """One in each full `notes_a_wrong_pad`, and one where a pass is shorter."""
    return max(1, notes // rules.notes_a_wrong_pad)


_TINY = 1e-9
"""Keeps 0.9 · 50 from needing 46."""


def _within(value: float | None, share: float, of: float | None) -> bool:
    return value is not None and of is not None and value <= share * of


def _beyond(value: float | None, centre: float, limit: float | None) -> bool:
    return value is not None and limit is not None and abs(value - centre) > limit


def _too_many(extras: int) -> str:
    return f" and {extras} too many" if extras else ""


def _ratio(value: float | None) -> str:
    return "–" if value is None else f"{value:.1f}:1"


def _number(value: float | None, sign: str = "") -> str:
    return "–" if value is None else f"{value:{sign}.0f}"
