"""What a performance shows, each finding an effect with the interval that the data can bear.

Habits come from two regressions (`habits`), misses and extras from shares (`error_rates`), a common lean and
unsteadiness from the asynchronies themselves. Nothing is found that chance or feel explains: an effect counts if it
lies `CHANCE` standard errors from nothing and beyond what is free. How much it matters, its severity, is its size in
units of a clear fault of its kind. Sentences are written by `advice`.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.labels import name_of
from station.core.pieces import Limb
from station.music import passages
from station.music.judgement import Label
from station.scoring.analysis.error_rates import misses_and_extras, wrong_pieces
from station.scoring.analysis.finding import MIN_SLOTS, Z_95, Finding, worst_bars
from station.scoring.analysis.habits import CHANCE
from station.scoring.analysis.points import ratio_of_place
from station.scoring.analysis.regression import CONSTANT, Effect
from station.scoring.analysis.summary import Summary
from station.scoring.analysis.timing_spread import asynchrony_ms, timed_notes
from station.scoring.matching.alignment import Reference

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class FindingKind:
    """A fault that one effect shows: `sign` of the effect, what is `free`, what is `clear`, both in `unit`.

    `free` None: a lean, of which the lesson says how much is feel.
    """

    fault: str
    effect: str
    sign: int
    free: float | None
    clear: float
    unit: str


_FREE_MS, _CLEAR_MS = 3.0, 25.0
"""HUMANS: 6 ms are just heard in fast strokes, 25 ms by anyone; half of what is just heard is worth no sentence."""

_FREE_FLAM_MS, _CLEAR_FLAM_MS = 1.2, 20.0
"""Our choice: a lead is one drop of both hands, a third as scattered as strokes are, so that less is free of it; 20 ms
more make 50 of a flam's 30 ms, wider than flams are played (HUMANS: 15–40 ms)."""

_FREE_DB, _CLEAR_DB = 1.5, 4.0
"""HUMANS: 1 dB is just noticeable to the skilled, 2–3 to others."""

KINDS = (
    FindingKind("late_kick", "kick", 1, None, _CLEAR_MS, "ms"),
    FindingKind("early_kick", "kick", -1, None, _CLEAR_MS, "ms"),
    FindingKind("slow_hihat_foot", "hihat_pedal", 1, None, _CLEAR_MS, "ms"),
    FindingKind("early_hihat_foot", "hihat_pedal", -1, None, _CLEAR_MS, "ms"),
    FindingKind("rush_fills", "fills", -1, _FREE_MS, _CLEAR_MS, "ms"),
    FindingKind("drag_fills", "fills", 1, _FREE_MS, _CLEAR_MS, "ms"),
    FindingKind("drag_slow", "long_waits", 1, _FREE_MS, _CLEAR_MS, "ms"),
    FindingKind("rush_slow", "long_waits", -1, _FREE_MS, _CLEAR_MS, "ms"),
    FindingKind("uneven_doubles", "doubles", -1, _FREE_MS, _CLEAR_MS, "ms"),
    FindingKind("lazy_doubles", "doubles", 1, _FREE_MS, _CLEAR_MS, "ms"),
    FindingKind("wide_flams", "flams", 1, _FREE_FLAM_MS, _CLEAR_FLAM_MS, "ms"),
    FindingKind("tight_flams", "flams", -1, _FREE_FLAM_MS, _CLEAR_FLAM_MS, "ms"),
    FindingKind("weak_left", "left_level", -1, _FREE_DB, _CLEAR_DB, "dB"),
    FindingKind("weak_right", "left_level", 1, _FREE_DB, _CLEAR_DB, "dB"),
    FindingKind("loud_ghosts", "ghost_level", 1, _FREE_DB, _CLEAR_DB, "dB"),
    FindingKind("flat_accents", "accent_level", -1, _FREE_DB, _CLEAR_DB, "dB"),
)
"""Every fault that a habit's effect can show. Ghosts that are softer and accents that are louder are nobody's fault."""

_CLEAR_SWING = 0.5

FREE_BIAS_MS, _CLEAR_BIAS_MS = 20.0, 40.0
"""Professionals play 10–16 ms ahead of the click (HUMANS); 40 ms are a clear fault."""

_LEAST_SD_MS, _MOST_SD_MS, _SD_SHARE = 20.0, 35.0, 0.15
"""TEACHING: a pass's SD is at most min(35, max(20, 15 % of the interval)) ms."""

_UNSTEADY_SEVERITY = 0.1
"""Slower is the answer to every spread: said when nothing more telling is found."""


def find_all(summary: Summary) -> list[Finding]:
    """Every finding, the severest first."""
    found = [
        *_habits(summary),
        *_swing(summary),
        *_leans(summary),
        *_common_lean(summary),
        *_unsteady(summary),
        *misses_and_extras(summary),
        *wrong_pieces(summary),
    ]
    return sorted(found, key=lambda finding: -finding.severity)


# --- habits -----------------------------------------------------------------------------------------------------------


def _habits(summary: Summary) -> list[Finding]:
    found = []
    for kind in KINDS:
        effect = summary.habits.effects.get(kind.effect)
        if effect is not None and effect.value * kind.sign > _free(kind, summary) and _is_sure(effect):
            bars = _bars_of_habit(summary, kind)
            severity = abs(effect.value) / kind.clear
            found.append(Finding(kind.fault, "", effect.value, effect.ci, kind.unit, severity, bars))
    return found


def _free(kind: FindingKind, summary: Summary) -> float:
    """What a fault's effect may be without a word."""
    return summary.view.feel.lean_ms if kind.free is None else kind.free


def _is_sure(effect: Effect) -> bool:
    return effect.slots >= MIN_SLOTS and abs(effect.value) > CHANCE * effect.error


def _bars_of_habit(summary: Summary, kind: FindingKind) -> tuple[int, ...]:
    """Where the strokes concerned are farthest to the fault's side."""
    off = summary.habits.off_db if kind.unit == "dB" else asynchrony_ms(summary.alignment)
    sign = kind.sign
    if kind.effect == "flams":  # a grace stroke that comes early leads too far
        sign = -sign
    elif kind.effect == "left_level" and kind.sign > 0:  # then it is the right hand that is soft
        right = summary.score.notes["limb"] == Limb.RIGHT_HAND
        return _farthest(summary, right & ~summary.score.is_grace, -off)
    return _farthest(summary, summary.habits.strokes[kind.effect], sign * off)


def _farthest(summary: Summary, strokes: Flags, off: Floats) -> tuple[int, ...]:
    """The bars in which the strokes (n,) that were played lie farthest up in `off` (n,)."""
    judged = strokes & (summary.alignment.note_label == Label.MATCH) & ~np.isnan(off)
    if not judged.any():
        return ()
    return tuple(worst_bars(summary, off[judged] - off[judged].min(), judged))


def _swing(summary: Summary) -> list[Finding]:
    """Swing that is held straighter or harder than is free; the effect is in ratios against what is written."""
    effect = summary.habits.effects.get("swing")
    swung = passages.swung(summary.score)
    if effect is None or not swung.flags.any() or not _is_sure(effect):
        return []
    written = swung.written_place
    held, low, high = (ratio_of_place(written + shift) for shift in (effect.value, *effect.ci))
    asked = ratio_of_place(written)
    if summary.view.feel.allows(held, asked):
        return []
    fault = "straight_swing" if held < asked else "hard_swing"
    bars = _farthest(summary, swung.flags, np.sign(effect.value) * asynchrony_ms(summary.alignment))
    severity = abs(held - asked) / _CLEAR_SWING
    return [
        Finding(
            fault, f"{held:.1f}:1 for {asked:.1f}:1", held - asked, (low - asked, high - asked), "ratio", severity, bars
        )
    ]


def _leans(summary: Summary) -> list[Finding]:
    """A hand's piece that stands apart from the other pieces by more than is free; of two the one of fewer strokes."""
    found, free_ms = [], summary.view.feel.lean_ms
    for name, effect in summary.habits.effects.items():
        if name.startswith("lean_") and abs(effect.value) > free_ms and _is_sure(effect):
            strokes = summary.habits.strokes[name] & timed_notes(summary.score, summary.alignment)
            piece = name.removeprefix("lean_")
            off = asynchrony_ms(summary.alignment)[strokes] * np.sign(effect.value)
            bars = tuple(worst_bars(summary, off - off.min(), strokes))
            fault = f"{'late' if effect.value > 0 else 'early'}_{piece}"
            finding = Finding(
                fault,
                name_of(piece),
                effect.value,
                effect.ci,
                "ms",
                abs(effect.value) / _CLEAR_MS,
                bars,
            )
            found.append((int(strokes.sum()), finding))
    return [finding for _, finding in sorted(found, key=lambda pair: pair[0])[:1]]


# --- the whole --------------------------------------------------------------------------------------------------------


def _common_lean(summary: Summary) -> list[Finding]:
    """Everything early or late against the click: with habits taken out, and as it was heard."""
    effect, mean_ms = summary.habits.effects.get(CONSTANT), summary.timing.mean_ms
    if summary.alignment.reference is Reference.PLAYER or effect is None or mean_ms is None:
        return []
    side = np.sign(effect.value)
    if min(side * effect.value, side * mean_ms) <= FREE_BIAS_MS or not _is_sure(effect):
        return []
    timed = timed_notes(summary.score, summary.alignment)
    off = asynchrony_ms(summary.alignment)[timed]
    bars = tuple(worst_bars(summary, off * side - (off * side).min(), timed))
    fault = "late" if effect.value > 0 else "early"
    return [Finding(fault, "", effect.value, effect.ci, "ms", abs(effect.value) / _CLEAR_BIAS_MS, bars)]


def _unsteady(summary: Summary) -> list[Finding]:
    """A spread beyond what a pass allows, with leans and habits and without; its interval by the normal law of SDs.

    The effect is the spread of the report's tables, so that a student reads one number everywhere.
    """
    sd, left, count = summary.timing.sd_ms, summary.habits.timing_sd_ms, summary.timing.count
    if sd is None or left is None or count < 4 * MIN_SLOTS:
        return []
    limit = min(_MOST_SD_MS, max(_LEAST_SD_MS, _SD_SHARE * _usual_interval_ms(summary)))
    half = Z_95 * sd / (2 * count) ** 0.5
    if min(sd, left) - half <= limit:
        return []
    timed = timed_notes(summary.score, summary.alignment)
    off = asynchrony_ms(summary.alignment)[timed]
    bars = tuple(worst_bars(summary, np.abs(off - np.median(off)), timed))
    return [Finding("unsteady", f"{limit:.0f}", sd, (sd - half, sd + half), "ms", _UNSTEADY_SEVERITY, bars)]


def _usual_interval_ms(summary: Summary) -> float:
    ticks, _ = passages.slots(summary.score)
    waits = np.diff(summary.score.tempo_map.seconds_at(ticks))
    return float(np.median(waits)) * 1e3 if len(waits) else 0.0
