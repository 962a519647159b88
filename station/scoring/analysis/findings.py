"""Every fault that a performance shows, in the order in which a teacher takes them.

A cause that `habits` found, a share of notes, a jump in the way through the score … becomes a finding where two things
hold: it matters, being at least `DECIDE` of the smallest size that a teacher minds (`fault_table`, or what the lesson
asks), and the data bear it. Notes come before pulse, pulse before lean, lean before dynamics; within each group the
largest, in units of its smallest size, comes first. Sentences are written by `advice`.
"""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from station.core.labels import name_of
from station.core.units import PPQ
from station.music import passages
from station.music.score import Score
from station.scoring.analysis.entries import in_words
from station.scoring.analysis.error_rates import misses_and_extras, wilson, wrong_hands, wrong_pieces
from station.scoring.analysis.fault_table import kind_of, of_piece
from station.scoring.analysis.finding import CHANCE, MIN_SLOTS, Finding, farthest_bars, worst_bars
from station.scoring.analysis.habits import FILL_EFFECTS, HANDS, OFFBEATS
from station.scoring.analysis.journey import Journey, journey
from station.scoring.analysis.level_findings import level_findings
from station.scoring.analysis.points import FREE_LEAN_MS, FREE_SWING, ratio_of_place
from station.scoring.analysis.pulse import tempo_change
from station.scoring.analysis.sparse_model import CONSTANT, Effect
from station.scoring.analysis.spread_findings import spread_findings
from station.scoring.analysis.summary import Summary
from station.scoring.analysis.technique.openness import Opening, hat_faults, openings
from station.scoring.analysis.timing_spread import asynchrony_ms

Floats = NDArray[np.float64]

DECIDE = 0.75
"""From this share of the smallest size on a fault is named, so that chance hides few of those that just matter."""

DECIDE_PIECES = 0.88
"""The same for pieces, that lean by 5–10 ms in anyone (HUMANS): 22 ms are three of their SDs."""

DECIDE_PLACES = 0.6
"""The same for places in the music, in which nobody leans without a fault, and which are not all meant alike: what is a
fill, a double or a wait to the player is not always one here (our choice)."""

_WHOLE_SHARE = 0.8
"""The same for all of a take: 24 ms, for professionals stand up to 16 ms ahead of the click (HUMANS)."""

_DECIDE_PULSE = 0.58
"""The same for the tempo without a click: 2.3 % in eight bars, for professionals stray by 1–2 % (HUMANS)."""

_HATS_SHARE = 0.6
"""The same for open and closed hats, of which an even player has none that are wrong."""

_FLAM_SHARE = 0.1
"""A flam is too wide or too narrow from the last tenth of the way from what is written to the limit on: leads scatter
little, and what is usual begins 5 ms behind the limit (HUMANS)."""

_FEWEST_LANDINGS = 4
"""Slots after fills; there are few fills, and each shift is large (our choice)."""


def find_all(summary: Summary) -> list[Finding]:
    """Every finding in a teacher's order; of two by one name the larger."""
    way = journey(summary.score, summary.performance, summary.alignment)
    found = [
        *_entries(summary, way),
        *_jumps(summary, way),
        *misses_and_extras(summary, way),
        *wrong_pieces(summary),
        *wrong_hands(summary),
        *_hats(summary),
        *_pulse(summary),
        *spread_findings(summary),
        *_causes(summary),
        *_flams(summary),
        *level_findings(summary, DECIDE),
    ]
    named = [one for one in found if np.isfinite(summary.view.faults.least(one.fault))]
    return sorted(named, key=lambda one: (kind_of(one.fault).group, -one.severity))


# --- causes in time ---------------------------------------------------------------------------------------------------

_WORDS = {
    "left_hand": ("late_left_hand", "early_left_hand"),
    "right_hand": ("late_right_hand", "early_right_hand"),
    "offbeats": ("late_offbeats", "early_offbeats"),
    "ands": ("late_offbeats", "early_offbeats"),
    "quarters": ("late_offbeats", "early_offbeats"),
    "swing": ("hard_swing", "straight_swing"),
    "fills": ("drag_fills", "rush_fills"),
    "fill_shift": ("drag_fills", "rush_fills"),
    **dict.fromkeys(("landings", "landing_fade"), ("fill_lands_late", "fill_lands_early")),
    **dict.fromkeys(("long_waits", "rests"), ("drag_slow", "rush_slow")),
    "doubles": ("lazy_doubles", "uneven_doubles"),
    CONSTANT: ("late", "early"),
}
"""What an effect is called that is late, and early; pieces by `fault_table.of_piece`."""

_PLACES = frozenset({*FILL_EFFECTS, "long_waits", "rests", "doubles"})


def _words_of(summary: Summary, name: str, effect: Effect) -> tuple[str, ...]:
    """The word of an effect, then the others that mean the same strokes to the same side."""
    late = effect.value > 0
    if name not in _WORDS:
        return (of_piece("late" if late else "early", name),)
    said = _WORDS[name][0 if late else 1]
    if name in OFFBEATS and late:
        ratio = ratio_of_place(0.5 + effect.value / _pair_ms(summary.score, name))
        return ("swung_straight", said) if ratio >= FREE_SWING[0] else (said, "swung_straight")
    return (said,)


def _pair_ms(score: Score, name: str) -> float:
    """Length of the two strokes that swing would share unevenly: half a beat for its quarters, else a beat."""
    beat_ms = 60e3 / score.tempo_map.bpm_at(0)
    return beat_ms / 2 if name == "quarters" else beat_ms


def _size(summary: Summary, name: str, effect: Effect) -> float:
    """How large an effect is in the unit of the fault table."""
    size = abs(effect.value)
    if name == "swing":
        swung = passages.swung(summary.score)
        return size * float(np.median(swung.span_ms[swung.flags]))
    if name == "doubles":
        return 100 * size / passages.double_interval_ms(summary.score)
    return size


def _least(summary: Summary, name: str, fault: str) -> float:
    """From which size `fault` counts: as the table or the lesson has it, and no more than the lesson leaves to feel."""
    asked, free_ms = summary.view.faults.least(fault), summary.view.feel.lean_ms
    is_lean = name not in _WORDS or name in HANDS or name in OFFBEATS
    return min(asked, free_ms) if is_lean and free_ms < FREE_LEAN_MS and np.isfinite(asked) else asked


def _causes(summary: Summary) -> Iterator[Finding]:
    """Each cause in time that matters, with what could as well stand in its place."""
    timing, said = summary.habits.timing, set[str]()
    if timing is None:
        return
    whole = () if CONSTANT in timing.chosen else (CONSTANT,)  # where players usually stand may still be too far
    for name in (*timing.chosen, *whole):
        effect = timing.effects.get(name)
        if effect is None:
            continue
        fault, *same = _words_of(summary, name, effect)
        severity = _size(summary, name, effect) / max(_least(summary, name, fault), 1e-9)
        if fault in said or not _matters(summary, name, effect, severity):
            continue
        said.add(fault)
        rivals = [_words_of(summary, other, there)[0] for other, there in timing.rivals.get(name, {}).items()]
        others = tuple(dict.fromkeys(word for word in (*same, *rivals) if word != fault))
        shown, ci, unit, subject = _shown(summary, name, effect)
        side = np.sign(effect.value)
        bars = farthest_bars(summary, summary.habits.strokes[name], side * asynchrony_ms(summary.alignment))
        yield Finding(fault, subject, shown, ci, unit, severity, bars, others)


def _matters(summary: Summary, name: str, effect: Effect, severity: float) -> bool:
    fewest = _FEWEST_LANDINGS if name in FILL_EFFECTS else MIN_SLOTS
    if effect.slots < fewest or abs(effect.value) < CHANCE * effect.error:
        return False
    if name == "swing" and summary.view.feel.swing_error is not None:
        written = passages.swung(summary.score).written_place
        return not summary.view.feel.allows(ratio_of_place(written + effect.value), ratio_of_place(written))
    if name == CONSTANT:  # with habits taken out, and as it was heard
        mean_ms = summary.timing.mean_ms or 0.0
        heard_ms = mean_ms * np.sign(effect.value)
        return bool(min(severity, heard_ms * severity / abs(effect.value)) >= _WHOLE_SHARE)
    return severity >= (DECIDE_PLACES if name in _PLACES else DECIDE if name in _WORDS else DECIDE_PIECES)


def _shown(summary: Summary, name: str, effect: Effect) -> tuple[float, tuple[float, float], str, str]:
    """Effect and interval in the unit in which they are told, and what is told beside them."""
    if name == "swing":
        written = passages.swung(summary.score).written_place
        asked = ratio_of_place(written)
        held, low, high = (ratio_of_place(written + shift) for shift in (effect.value, *effect.ci))
        return held - asked, (low - asked, high - asked), "ratio", f"{held:.1f}:1 for {asked:.1f}:1"
    subject = "" if name in _WORDS else name_of(name)
    return effect.value, effect.ci, "ms", subject


# --- pulse, way, hats, flams ------------------------------------------------------------------------------------------


def _pulse(summary: Summary) -> Iterator[Finding]:
    """Rushing or dragging without a click."""
    effect = tempo_change(summary.score, summary.performance, summary.alignment)
    if effect is None or abs(effect.value) < CHANCE * effect.error:
        return
    fault = "rushing" if effect.value > 0 else "dragging"
    severity = abs(effect.value) / summary.view.faults.least(fault)
    if severity >= _DECIDE_PULSE:
        yield Finding(fault, "", effect.value, effect.ci, kind_of(fault).unit, severity, ())


def _entries(summary: Summary, way: Journey) -> Iterator[Finding]:
    """Who came in late, or early, by the most that they did: strokes are right, in another place of the click."""
    names, strokes = summary.view.bar_names_of(summary.score), max(len(summary.performance), 1)
    for fault, side in (("came_in_late", 1), ("came_in_early", -1)):
        mine = [entry for entry in way.entries if side * entry.quarters > 0]
        if not mine or len(mine) < summary.view.faults.least(fault):
            continue
        worst = max(mine, key=lambda entry: entry.strokes)
        meter = summary.score.tempo_map.meter_at(summary.score.tempo_map.bar_start(worst.bar))
        quarters, beat = abs(worst.quarters), summary.view.beat_ticks
        beats = quarters * PPQ / beat
        bars = tuple(dict.fromkeys(int(names[min(entry.bar, len(names) - 1)]) for entry in mine))
        share = 100 * sum(entry.strokes for entry in mine) / strokes
        severity = max(share / kind_of("missed").least, 1.0)
        said = in_words(quarters, beat, meter.bar_ticks)
        yield Finding(fault, said, beats, (beats, beats), kind_of(fault).unit, severity, bars)


def _jumps(summary: Summary, way: Journey) -> Iterator[Finding]:
    """One finding of each kind of jump, by how often it happened, with the bars."""
    names = summary.view.bar_names_of(summary.score)
    for fault in ("stopped", "left_out_bars", "repeated_bars"):
        mine = [jump for jump in way.jumps if jump.fault == fault]
        count = float(len(mine))
        if mine and count >= summary.view.faults.least(fault):
            bars = tuple(dict.fromkeys(int(names[min(jump.bar, len(names) - 1)]) for jump in mine))
            again = int(names[min(mine[0].to_bar, len(names) - 1)]) + 1
            others = tuple(dict.fromkeys(rival for jump in mine for rival in jump.rivals))
            yield Finding(fault, str(again), count, (count, count), "times", count, bars, others)


def _hats(summary: Summary) -> Iterator[Finding]:
    """Hi-hats that are open where they should be closed, and the other way round."""
    judged, wrong = hat_faults(summary.score, summary.performance, summary.alignment)
    closed = openings(summary.score.notes["openness"]) == Opening.CLOSED
    for fault, asked in (("open_hats", judged & closed), ("closed_hats", judged & ~closed)):
        bad, of = int((wrong & asked).sum()), int(asked.sum())
        least = summary.view.faults.least(fault) / 100
        if of >= MIN_SLOTS and bad / of >= _HATS_SHARE * least and wilson(bad, of, CHANCE)[0] > least / 5:
            bars = tuple(worst_bars(summary, wrong[asked].astype(np.float64), asked))
            low, high = wilson(bad, of)
            yield Finding(fault, "", 100 * bad / of, (100 * low, 100 * high), "%", bad / of / least, bars)


def _flams(summary: Summary) -> Iterator[Finding]:
    """Flams that are wider or narrower than flams are; the effect is how much wider than written they were."""
    effect, faults = summary.habits.effects.get("flams"), summary.view.faults
    if effect is None or effect.slots < MIN_SLOTS:
        return
    score, flam = summary.score, summary.habits.strokes["flams"]
    written_ms = float(score.notes["lead_ms"][flam].mean())
    off = asynchrony_ms(summary.alignment)
    for fault, side in (("wide_flams", 1), ("tight_flams", -1)):
        limit = faults.least(fault)
        far_ms = abs(limit - written_ms)
        if np.isfinite(limit) and side * (effect.value - limit) > -_FLAM_SHARE * far_ms:
            size = 1.0 + side * (effect.value - limit) / max(far_ms, 1.0)
            ci = (effect.ci[0] - written_ms, effect.ci[1] - written_ms)
            bars = farthest_bars(summary, flam, -side * off)
            yield Finding(fault, f"{effect.value:.0f}", effect.value - written_ms, ci, "ms", size, bars)
