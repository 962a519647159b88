"""A tempo that rises while it is played: so many beats a minute more every so many bars.

    RISE = +BPM/BARS | +BPM/BARS:TOP, the + may be left out: 5/8 is 5 bpm more every 8 bars

It counts the beat that the lesson counts, as the tempo is shown (dotted quarters in 6/8). It rises at the starts of
bars, counted over all passes, up to `TOP`, or up to the lesson's target where none is said. Pure: a score in, the same
strokes at the tempi of its bars out; the click, the drummer and the judgement follow the score's own tempo map.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace

from station.core.errors import BadInput
from station.core.units import PPQ
from station.drills.lesson import Lesson
from station.music.score import Score

MOST_BPM_A_STEP = 50.0
"""Our choice: TEACHING's ladder goes up 5 % at a time; ten times that is no ladder any more."""
MOST_BARS = 1000
"""Our choice: more bars than a lesson has."""
EXPECTED = "so many bpm more every so many bars such as 5/8, and up to where such as 5/8:140"
_NUMBER = r"\d{1,4}(?:\.\d{1,3})?"
_RISE = re.compile(rf"\+?({_NUMBER})/(\d{{1,4}})(?::({_NUMBER}))?", re.ASCII)


@dataclass(frozen=True, slots=True)
class Rise:
    """`add_bpm` more every `every_bars` bars, up to `top_bpm` (None: the lesson's target), in the beat that counts."""

    add_bpm: float
    every_bars: int
    top_bpm: float | None = None

    def __str__(self) -> str:
        return f"{self.add_bpm:g}/{self.every_bars}" + ("" if self.top_bpm is None else f":{self.top_bpm:g}")


@dataclass(frozen=True, slots=True)
class TempoStep:
    """From `bar` of all passes in a row (from 0) on, `tempo_bpm` quarter notes a minute."""

    bar: int
    tempo_bpm: float


def rise_of(text: str, source: str = "--rise") -> Rise:
    """The rise that `text` asks for; raises `BadInput` that names `source` and the text."""
    found = _RISE.fullmatch(text)
    if found is None:
        raise BadInput(source, text[:40], f"expected {EXPECTED}")
    add_bpm, every_bars, top = float(found[1]), int(found[2]), found[3]
    if not 0 < add_bpm <= MOST_BPM_A_STEP:
        raise BadInput(source, text, f"expected up to {MOST_BPM_A_STEP:g} bpm at a time")
    if not 1 <= every_bars <= MOST_BARS:
        raise BadInput(source, text, f"expected 1 to {MOST_BARS} bars")
    return Rise(add_bpm, every_bars, None if top is None else float(top))


def steps_of(rise: Rise, lesson: Lesson, tempo_bpm: float, bars: int) -> tuple[TempoStep, ...]:
    """The tempi of `bars` bars in a row that begin at `tempo_bpm`, in quarter notes, the first among them.

    Raises `BadInput` where there is nothing to reach.
    """
    quarters = lesson.beat_ticks / PPQ
    first = tempo_bpm / quarters
    top = lesson.target_tempo_bpm / quarters if rise.top_bpm is None else rise.top_bpm
    if top <= first:
        say = f"say a slower tempo, or how far, such as {rise.add_bpm:g}/{rise.every_bars}:{first + 4 * rise.add_bpm:g}"
        what = "the lesson's target" if rise.top_bpm is None else "it should rise to"
        raise BadInput("--rise", str(rise), f"it begins at {first:g} bpm, and {what} is {top:g}; {say}")
    steps = [TempoStep(0, tempo_bpm)]
    for bar in range(rise.every_bars, bars, rise.every_bars):
        bpm = min(first + rise.add_bpm * (bar // rise.every_bars), top)
        steps.append(TempoStep(bar, bpm * quarters))
        if bpm == top:
            break
    return tuple(steps)


def risen(score: Score, steps: Sequence[TempoStep]) -> Score:
    """The same strokes at the tempi of `steps`, whose first is the tempo of the score; without steps itself."""
    if not steps:
        return score
    tempo_map = score.tempo_map
    speeds = [(tempo_map.bar_start(step.bar), step.tempo_bpm / steps[0].tempo_bpm) for step in steps]
    return replace(score, tempo_map=tempo_map.sped(speeds))
