"""Faults of loudness: marks that do not stand out, a weak hand, weak second strokes, a take that fades.

Marks are judged by the contrast that is heard, not by how far each stroke is from its written velocity: accents at
least so many dB over the taps, ghosts and grace strokes at least so many under. What is written says how far a player
is from that; where it asks for less than the table, only a clear loss of it counts.
"""

from collections.abc import Iterator

import numpy as np

from station.core.pieces import Dynamic, Limb
from station.scoring.analysis.fault_table import kind_of
from station.scoring.analysis.finding import CHANCE, MIN_SLOTS, Finding, farthest_bars
from station.scoring.analysis.loudness import level_db
from station.scoring.analysis.sparse_model import Effect
from station.scoring.analysis.summary import Summary

_LEAST_LOSS_DB = 1.5
"""A contrast that is lost by less is no fault, whatever is written (HUMANS: 1 dB is just noticeable to the skilled)."""

_DOUBLES_SHARE = 0.6
"""Second strokes are named from this share on: what is a double to the player is not always one here (our choice)."""

_GRACE_SHARE = 0.8
"""Graces too loud are named from this share of the contrast on that the table asks (our choice, as `DECIDE`)."""


def level_findings(summary: Summary, decide: float) -> list[Finding]:
    """All faults of loudness, each from the share `decide` of its smallest size on; none of an input without levels."""
    level = summary.habits.level
    found = [*_graces(summary)]
    for name in level.chosen if level is not None else ():
        assert level is not None, "it has chosen"
        effect = level.effects.get(name)
        if effect is None or effect.slots < MIN_SLOTS or abs(effect.value) < CHANCE * effect.error:
            continue
        fault = _fault_of(name, effect)
        least = _least(summary, fault) if fault is not None else float("inf")
        if fault is None or not abs(effect.value) >= (_DOUBLES_SHARE if name == "doubles_level" else decide) * least:
            continue
        rivals = [_fault_of(other, there) for other, there in level.rivals[name].items()]
        others = tuple(dict.fromkeys(word for word in rivals if word is not None and word != fault))
        found.append(
            Finding(
                fault,
                _subject(summary, fault, effect),
                effect.value,
                effect.ci,
                kind_of(fault).unit,
                abs(effect.value) / least,
                _bars(summary, name, effect),
                others,
            )
        )
    return found


_WORDS = {
    "accent_level": (None, "flat_accents"),
    "ghost_level": ("loud_ghosts", None),
    "left_level": ("weak_right", "weak_left"),
    "doubles_level": (None, "weak_doubles"),
    "fade": ("grows", "fades"),
}
"""What an effect is called that is louder, and softer; ghosts that are softer and accents that are louder are free."""


def _fault_of(name: str, effect: Effect) -> str | None:
    return _WORDS[name][0 if effect.value > 0 else 1]


def _least(summary: Summary, fault: str) -> float:
    """The smallest loss or difference in dB that counts."""
    asked = summary.view.faults.least(fault)
    dynamic = {"flat_accents": Dynamic.ACCENT, "loud_ghosts": Dynamic.GHOST}.get(fault)
    if dynamic is None or not np.isfinite(asked):
        return asked
    written = abs(written_contrast_db(summary, dynamic) or asked + _LEAST_LOSS_DB)
    return max(written - asked, _LEAST_LOSS_DB)


def written_contrast_db(summary: Summary, dynamic: Dynamic) -> float | None:
    """How much louder strokes of `dynamic` are written than the plain ones, on one piece if it has both, else on all.

    None where nothing is plain.
    """
    notes, main = summary.score.notes, ~summary.score.is_grace
    level = level_db(notes["velocity"])
    marked, plain = main & (notes["dynamic"] == dynamic), main & (notes["dynamic"] == Dynamic.NORMAL)
    both = np.intersect1d(notes["piece"][marked], notes["piece"][plain])
    if len(both):
        marked, plain = marked & np.isin(notes["piece"], both), plain & np.isin(notes["piece"], both)
    if not marked.any() or not plain.any():
        return None
    return float(level[marked].mean() - level[plain].mean())


def _subject(summary: Summary, fault: str, effect: Effect) -> str:
    """The contrast that was heard, in dB."""
    dynamic = {"flat_accents": Dynamic.ACCENT, "loud_ghosts": Dynamic.GHOST}.get(fault)
    written = None if dynamic is None else written_contrast_db(summary, dynamic)
    return "" if written is None else f"{abs(written + effect.value):.0f}"


def _bars(summary: Summary, name: str, effect: Effect) -> tuple[int, ...]:
    """Where the strokes concerned are farthest to the fault's side; a fade is in no bar."""
    if name == "fade":
        return ()
    notes, strokes, off = summary.score.notes, summary.habits.strokes[name], summary.habits.off_db
    if name == "left_level" and effect.value > 0:  # then it is the right hand that is soft
        return farthest_bars(summary, (notes["limb"] == Limb.RIGHT_HAND) & ~summary.score.is_grace, -off)
    return farthest_bars(summary, strokes, np.sign(effect.value) * off)


def _graces(summary: Summary) -> Iterator[Finding]:
    """Grace strokes nearly as loud as their main strokes; the effect is grace less main stroke in dB."""
    effect, asked = summary.habits.effects.get("graces_level"), summary.view.faults.least("loud_graces")
    if effect is None or effect.slots < MIN_SLOTS or not np.isfinite(asked):
        return
    limit = asked / _GRACE_SHARE
    if effect.value > -limit:
        severity = 1.0 + (effect.value + asked) / asked
        bars = farthest_bars(summary, summary.habits.strokes["graces_level"], summary.habits.off_db)
        yield Finding("loud_graces", f"{-effect.value:.0f}", effect.value, effect.ci, "dB", max(severity, 0.8), bars)
