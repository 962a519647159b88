"""What a teacher would say: one true sentence on what went well, then at most two remarks.

A remark says what was heard, how much and where, what else the data allow, then one thing to do, with a drill that can
be started. Findings come in a teacher's order (`findings`): notes, pulse, lean, dynamics.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import groupby

from station.core.labels import name_of
from station.core.units import PPQ
from station.scoring.analysis.fault_table import FAULTS, PIECE_WORDS
from station.scoring.analysis.finding import Finding
from station.scoring.analysis.findings import find_all
from station.scoring.analysis.summary import Summary
from station.scoring.report.advice_words import DO, HEARD, OR

MOST = 2
"""More than two things at once nobody practises (our choice)."""

SLOWER = 0.85
"""At this share of the tempo a passage that went wrong is practised (our choice; TEACHING steps down by 8 % twice)."""

_MOST_RIVALS = 2
"""More alternatives in one sentence nobody reads; the document has all."""


@dataclass(frozen=True, slots=True)
class Drill:
    """What one click starts: the lesson's bars (first, last, from 1; None: all), beats a minute, what alone to play.

    `pieces` are pieces and limbs by their words; empty: everything.
    """

    bars: tuple[int, int] | None
    tempo_bpm: float
    pieces: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Advice:
    """One remark: the fault's word, the text, the lesson's bars (from 1), the effect, its 95 % interval, and the drill.

    `alternatives` are other faults that would show in the same way: the data cannot tell. `hint` is what the lesson's
    author adds, empty where they add nothing.
    """

    fault: str
    text: str
    bars: tuple[int, ...]
    effect: float
    ci: tuple[float, float]
    alternatives: tuple[str, ...]
    drill: Drill
    hint: str = ""


def advise(summary: Summary) -> tuple[Advice, ...]:
    """At most two remarks in a teacher's order; none where the data cannot bear one."""
    return tuple(_remark(finding, summary) for finding in find_all(summary)[:MOST])


def _remark(finding: Finding, summary: Summary) -> Advice:
    bars = tuple(bar + 1 for bar in finding.bars)
    tempo = summary.score.tempo_map.bpm_at(0) * PPQ / summary.view.beat_ticks
    key, stops = _row_of(finding.fault), _bars_in_words(bars, summary.view.parts)
    text = f"{HEARD[key]}{_or(finding.alternatives)}: {DO[key]}.".format(
        size=abs(finding.effect),
        subject=finding.subject,
        where=stops and f", most in {stops}",
        stops=stops,
        at=stops and f" in {stops}",
        tempo=tempo,
        slow=_slower(tempo),
    )
    drill, hint = _drill(finding, tempo), summary.view.hints.get(finding.fault, "")
    return Advice(finding.fault, text, bars, finding.effect, finding.ci, finding.alternatives, drill, hint)


def _slower(tempo: float) -> float:
    """The tempo to practise at, in whole beats, as the sentence says it."""
    return float(round(SLOWER * tempo))


def _row_of(fault: str) -> str:
    """The key of a fault's words."""
    return fault if fault in FAULTS else f"{fault.partition('_')[0]}_piece"


def _or(alternatives: tuple[str, ...]) -> str:
    """The alternatives in brackets, nothing without any."""
    named = [OR[word] if word in OR else f"your {name_of(word.partition('_')[2])}" for word in alternatives]
    named = list(dict.fromkeys(named))[:_MOST_RIVALS]
    return f" (or {', or '.join(named)}: the strokes are the same)" if named else ""


def _bars_in_words(bars: tuple[int, ...], parts: Mapping[int, str]) -> str:
    """The bars, from 1, and after those of one name that name; `parts` counts bars from 0."""
    runs = [(name, list(run)) for name, run in groupby(bars, lambda bar: parts.get(bar - 1, ""))]
    ends = {run[-1]: f" ({name})" for name, run in runs if name}
    named = [f"{bar}{ends.get(bar, '')}" for bar in bars]
    if len(named) < 2:
        return f"bar {named[0]}" if named else ""
    return f"bars {', '.join(named[:-1])} and {named[-1]}"


_ENTRIES = {"came_in_late", "came_in_early"}
_AT_TEMPO = _ENTRIES | {"drag_slow", "rush_slow", "rushing", "dragging", "early", "late", "extra", "fades", "grows"}
"""Faults that are practised at the tempo itself: going slower would hide them."""

_LIMBS = ("left_hand", "right_hand", "left_foot", "right_foot")


def _drill(finding: Finding, tempo: float) -> Drill:
    """The bars from the first to the last that were named, slower where that helps, the limb or piece alone."""
    bars = (min(finding.bars) + 1, max(finding.bars) + 1) if finding.bars else None
    alone = [limb for limb in _LIMBS if finding.fault.endswith(limb)]
    if finding.fault in PIECE_WORDS:
        alone = ["hihat_pedal" if finding.fault in FAULTS else finding.fault.partition("_")[2]]
    return Drill(bars, round(tempo, 1) if finding.fault in _AT_TEMPO else _slower(tempo), tuple(alone))
