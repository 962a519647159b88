"""Takes that are not played once through: stopped and begun again, a bar left out, a bar played twice.

With a click the player re-enters on the click's bars; without one a pause is as long as it is. A bar is left out or
repeated only where the bars differ enough that a listener who knows the music would hear it.
"""

from dataclasses import replace

import numpy as np

from station.bench.rigs.planted.planted_player import Run, Sheet
from station.bench.rigs.planted.planted_strokes import Written

_FEWEST_BARS = 4
_HEARD_STROKES = 12
"""A bar too many or too few is heard by at least so many strokes that are elsewhere than they should be."""
_PAUSE_S = (2.0, 5.0)
"""Long enough to find the place again, and a bar at least, else nobody would call it stopping; our choice."""
_BARS_HEARD = 3
"""Within so many bars: a listener does not wait to the end; our choice."""


def _starts(written: Written) -> list[float]:
    score = written.score
    ticks = [score.tempo_map.bar_start(b) for b in range(score.bar_count + 1)]
    return [float(s) for s in score.tempo_map.seconds_at(ticks)]


def stopped(written: Written, clocked: bool, sheet: Sheet, rng: np.random.Generator) -> Sheet | None:
    """Breaks off within a bar, waits, and begins again with the pass, or with the music where it has no passes."""
    starts, bars = _starts(written), written.score.bar_count
    if bars < _FEWEST_BARS:
        return None
    bar = int(rng.integers(max(2, bars // 4), max(3, 3 * bars // 4)))
    again = bar // written.music.pass_bars * written.music.pass_bars if written.music.pass_bars else 0
    broken_s = starts[bar] + rng.uniform(0.4, 0.8) * (starts[bar + 1] - starts[bar])
    bar_s = starts[bar + 1] - starts[bar]
    resumed_s = starts[min(bar + 2, bars - 1)] if clocked else broken_s + max(rng.uniform(*_PAUSE_S), bar_s)
    until_s = starts[-1] - (resumed_s - starts[again]) if clocked else starts[-1]  # a session ends with its click
    return replace(sheet, runs=(Run(-1.0, broken_s, -1.0), Run(starts[again], until_s, resumed_s)))


def left_out_bars(written: Written, clocked: bool, sheet: Sheet, rng: np.random.Generator) -> Sheet | None:
    """Goes on with the bar after the next."""
    starts, bars = _starts(written), _bars(written, 1)
    if not bars:
        return None
    bar = int(rng.choice(bars))
    return replace(sheet, runs=(Run(-1.0, starts[bar], -1.0), Run(starts[bar + 1], starts[-1], starts[bar])))


def repeated_bars(written: Written, clocked: bool, sheet: Sheet, rng: np.random.Generator) -> Sheet | None:
    """Plays a bar once more."""
    starts, bars = _starts(written), _bars(written, -1)
    if not bars:
        return None
    bar = int(rng.choice(bars))
    until_s = starts[-1] - (starts[bar] - starts[bar - 1]) if clocked else starts[-1]
    return replace(sheet, runs=(Run(-1.0, starts[bar], -1.0), Run(starts[bar - 1], until_s, starts[bar])))


def _bars(written: Written, jump: int) -> list[int]:
    """The bars at which a jump is heard, those where it cannot be taken for one the other way if there are any."""
    heard = [b for b in _inner(written) if _heard(written, b, b + jump)]
    return [b for b in heard if _heard(written, b + 1, b - 1)] or heard


def _inner(written: Written) -> range:
    return range(2, written.score.bar_count - _BARS_HEARD)


def sounds_as_repeated(written: Written) -> bool:
    """Whether a bar left out sounds like a bar played twice wherever either could be: in loops of two bars."""
    return not any(_heard(written, b + 1, b - 1) for b in _inner(written))


def _heard(written: Written, at: int, played: int) -> bool:
    """Whether playing on from bar `played` where `at` is due puts enough strokes elsewhere within some bars."""
    due, heard = _strokes(written, at), _strokes(written, played)
    return len(due ^ heard) >= _HEARD_STROKES


def _strokes(written: Written, first: int) -> set[tuple[int, int]]:
    score = written.score
    start, stop = score.tempo_map.bar_start(first), score.tempo_map.bar_start(first + _BARS_HEARD)
    rows = written.main & (score.notes["tick"] >= start) & (score.notes["tick"] < stop)
    ticks, pieces = (score.notes["tick"][rows] - start).tolist(), score.notes["piece"][rows].tolist()
    return set(zip(ticks, pieces, strict=True))
