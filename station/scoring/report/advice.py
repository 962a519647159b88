"""The three most useful sentences: the severest findings, each with its numbers, its bars and what to practise next.

A sentence says what was heard, how much and where, then one thing to do. Effects are named as drummers say them.
"""

from dataclasses import dataclass
from types import MappingProxyType

from station.core.units import PPQ
from station.scoring.analysis.finding import Finding
from station.scoring.analysis.findings import find_all
from station.scoring.analysis.summary import Summary

MOST = 3
"""More than three things at once nobody practises (our choice)."""

SLOWER = 0.85
"""At this share of the tempo a passage that went wrong is practised (our choice; TEACHING steps down by 8 % twice)."""


@dataclass(frozen=True, slots=True)
class Advice:
    """One sentence: the fault's word, the text, the lesson's bars (from 1), the effect and its 95 % interval."""

    fault: str
    text: str
    bars: tuple[int, ...]
    effect: float
    ci: tuple[float, float]


_HEARD = MappingProxyType(
    {
        "late_kick": "Your kick is {size:.0f} ms late against the hands{where}",
        "early_kick": "Your kick is {size:.0f} ms early against the hands{where}",
        "slow_hihat_foot": "Your hi-hat foot closes {size:.0f} ms late{where}",
        "early_hihat_foot": "Your hi-hat foot closes {size:.0f} ms early{where}",
        "rush_fills": "You rush by {size:.0f} ms in the fills{where}",
        "drag_fills": "You drag by {size:.0f} ms in the fills{where}",
        "drag_slow": "After long waits you come in {size:.0f} ms late{where}",
        "rush_slow": "After long waits you come in {size:.0f} ms early{where}",
        "uneven_doubles": "The second stroke of your doubles comes {size:.0f} ms early{where}",
        "lazy_doubles": "The second stroke of your doubles comes {size:.0f} ms late{where}",
        "wide_flams": "Your grace notes come {size:.0f} ms too far ahead of the main stroke{where}",
        "tight_flams": "Your grace notes come {size:.0f} ms too close to the main stroke{where}",
        "weak_left": "Your left hand is {size:.1f} dB softer than your right{where}",
        "weak_right": "Your right hand is {size:.1f} dB softer than your left{where}",
        "loud_ghosts": "Your ghost notes are {size:.1f} dB too loud{where}",
        "flat_accents": "Your accents are {size:.1f} dB too soft{where}",
        "straight_swing": "Your swing is straighter than written, {subject}{where}",
        "hard_swing": "Your swing is sharper than written, {subject}{where}",
        "early": "You play {size:.0f} ms early throughout{where}",
        "late": "You play {size:.0f} ms late throughout{where}",
        "unsteady": "Your strokes spread by {size:.0f} ms where {subject} would do{where}",
        "missed": "You leave out {size:.0f} % of the {subject}{where}",
        "extra": "{size:.0f} % of your strokes on the {subject} are not written",
        "wrong_piece": "{size:.0f} % of the time you strike {subject}{where}",
    }
)
_HEARD_LEAN = "Your {subject} is {size:.0f} ms {side} against the other hand{where}"

_DO = MappingProxyType(
    {
        "late_kick": "play kick and hi-hat alone at {slow:.0f} bpm until they sound as one",
        "early_kick": "play kick and hi-hat alone at {slow:.0f} bpm until they sound as one",
        "slow_hihat_foot": "tap the foot alone on the click at {slow:.0f} bpm, heel up, then add the ride",
        "early_hihat_foot": "tap the foot alone on the click at {slow:.0f} bpm, then add the ride",
        "rush_fills": "loop the fill with the bar before it at {slow:.0f} bpm and count its subdivision aloud",
        "drag_fills": "loop the fill with the bar before it at {slow:.0f} bpm and lead with the sticking",
        "drag_slow": "count the rest aloud in 16ths at {tempo:.0f} bpm before you come in",
        "rush_slow": "count the rest aloud in 16ths at {tempo:.0f} bpm and let it pass",
        "uneven_doubles": "play the doubles at {slow:.0f} bpm and accent every second stroke",
        "lazy_doubles": "play the doubles at {slow:.0f} bpm and let the second stroke rebound",
        "wide_flams": "start the grace hand lower, at {slow:.0f} bpm, so that both sticks fall together",
        "tight_flams": "lift the main hand higher, at {slow:.0f} bpm, so that the grace note leads",
        "weak_left": "lead the same bars with the left hand at {slow:.0f} bpm, at the right hand's height",
        "weak_right": "lead the same bars with the right hand at {slow:.0f} bpm, at the left hand's height",
        "loud_ghosts": "play them at {slow:.0f} bpm from three centimetres above the head",
        "flat_accents": "play them at {slow:.0f} bpm from full height and drop back at once",
        "straight_swing": "play the ride alone at {slow:.0f} bpm and count triplets",
        "hard_swing": "play the ride alone at {slow:.0f} bpm and count triplets",
        "early": "wait for the click, or measure the latency once if you play on it",
        "late": "play ahead of where you feel the click, or measure the latency once",
        "unsteady": "go down to {slow:.0f} bpm and up again by 5 % once it holds",
        "missed": "play it at {slow:.0f} bpm until every stroke is there",
        "extra": "leave out all that is not written for one pass, or raise that pad's threshold",
        "wrong_piece": "loop that move alone at {slow:.0f} bpm",
    }
)
_DO_LEAN = "play it with the click alone at {slow:.0f} bpm, then add the rest"


def advise(summary: Summary) -> tuple[Advice, ...]:
    """At most three sentences, the most useful first; none where the data cannot bear one."""
    return tuple(_sentence(finding, summary) for finding in find_all(summary)[:MOST])


def _sentence(finding: Finding, summary: Summary) -> Advice:
    bars = tuple(bar + 1 for bar in finding.bars)
    tempo = summary.score.tempo_map.bpm_at(0) * PPQ / summary.view.beat_ticks
    template = f"{_HEARD.get(finding.fault, _HEARD_LEAN)}: {_DO.get(finding.fault, _DO_LEAN)}."
    text = template.format(
        size=abs(finding.effect),
        subject=finding.subject,
        side="late" if finding.effect > 0 else "early",
        where=_where(bars),
        tempo=tempo,
        slow=SLOWER * tempo,
    )
    return Advice(finding.fault, text, bars, finding.effect, finding.ci)


def _where(bars: tuple[int, ...]) -> str:
    if not bars:
        return ""
    if len(bars) == 1:
        return f", most in bar {bars[0]}"
    return f", most in bars {', '.join(map(str, bars[:-1]))} and {bars[-1]}"
