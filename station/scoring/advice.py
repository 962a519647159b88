"""The three most useful sentences: the strongest findings, each with numbers, bars and what to practise next."""

from dataclasses import dataclass
from types import MappingProxyType

from station.scoring.findings import Finding, find_all
from station.scoring.summary import Summary

MOST = 3
"""More than three things at once nobody practises (our choice)."""


@dataclass(frozen=True, slots=True)
class Advice:
    """One sentence: the fault's word, the text, the lesson's bars (from 1), the effect and its 95 % interval."""

    fault: str
    text: str
    bars: tuple[int, ...]
    effect: float
    ci: tuple[float, float]


def advise(summary: Summary) -> tuple[Advice, ...]:
    """At most three sentences, the most useful first; none where the data cannot bear one."""
    return tuple(_sentence(finding) for finding in find_all(summary)[:MOST])


_TEXTS = MappingProxyType(
    {
        "early": "You play {size:.0f} ms early throughout{where}: wait for the click, or measure your latency once.",
        "late": "You play {size:.0f} ms late throughout{where}: lean into the click, or measure your latency once.",
        "missed": "You leave out {size:.0f} % of the {subject}{where}: play that slowly until every stroke is there.",
        "extra": "{size:.0f} % of your {subject} strokes are not written: play fewer, or raise the pad's threshold.",
        "wrong_piece": "You strike {subject}, {size:.0f} % of the time{where}: loop the change without the rest.",
    }
)
_LEAN = (
    "Your {subject} is {size:.0f} ms {side} against the rest{where}: play it alone with the click, then add the others."
)


def _sentence(finding: Finding) -> Advice:
    bars = tuple(bar + 1 for bar in finding.bars)
    template = _TEXTS.get(finding.fault, _LEAN)
    side = "late" if finding.effect > 0 else "early"
    text = template.format(subject=finding.subject, size=abs(finding.effect), side=side, where=_where(bars))
    return Advice(finding.fault, text, bars, finding.effect, finding.ci)


def _where(bars: tuple[int, ...]) -> str:
    if not bars:
        return ""
    if len(bars) == 1:
        return f", most in bar {bars[0]}"
    return f", most in bars {', '.join(map(str, bars[:-1]))} and {bars[-1]}"
