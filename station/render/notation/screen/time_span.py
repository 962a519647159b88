"""How much music is ahead of the play line where notes roll towards it: two bars at any tempo, more if there is room.

Times are seconds of the score.
"""

import numpy as np

from station.core.units import NS_PER_S
from station.music.score import Score
from station.render.notation.screen.score_lines import CLOSEST_APART, LEAST_BARS

BEHIND_SHARE = 0.26
"""Where the play line stands, as a share of the width: most is for what comes, the rest for what was played.
(SMED, figure 4.4, has it in the middle; with a bar and a quarter ahead nobody can read in time.)"""
MOST_AHEAD_S, _LEAST_AHEAD_S = 4.0, 2.0
"""Seconds ahead in which two bars have room, at the most and at the least (our choice)."""
_APART, _CLOSER = 1.6, 0.1
"""Staff spaces between strokes that follow each other, a head and a third of one, and how many of them may stand closer
(our choice)."""


def two_bars_s(score: Score) -> float:
    """How long two bars in a row last at the most: so much ahead is at least two bars, wherever one is in them."""
    tempo_map, count = score.tempo_map, max(score.bar_count, LEAST_BARS)
    starts_s = np.asarray(tempo_map.seconds_at([tempo_map.bar_start(bar) for bar in range(count + 1)]), np.float64)
    return float((starts_s[LEAST_BARS:] - starts_s[:-LEAST_BARS]).max())


def ahead_s(score: Score, spaces: float) -> float:
    """Seconds of music ahead of the play line, so that strokes stand apart on `spaces` staff spaces ahead of it."""
    apart_s = _gap_s(score)
    fitting_s = MOST_AHEAD_S if apart_s is None else spaces * apart_s / _APART
    return max(min(max(fitting_s, _LEAST_AHEAD_S), MOST_AHEAD_S), two_bars_s(score))


def rolling_spaces(score: Score) -> float:
    """Staff spaces that the music must be wide for two bars ahead of the line, even if strokes all but touch."""
    apart_s = _gap_s(score)
    return 0.0 if apart_s is None else two_bars_s(score) / apart_s * CLOSEST_APART / (1 - BEHIND_SHARE)


def _gap_s(score: Score) -> float | None:
    """From a stroke to the next where they follow each other closely; None without two of them."""
    gaps_ns = np.diff(np.unique(score.onset_ns[~score.is_grace]))
    return float(np.quantile(gaps_ns, _CLOSER)) / NS_PER_S if len(gaps_ns) else None


def visible_bars(score: Score, first_s: float, last_s: float) -> range:
    """The bars of the score that a span of time touches, and the bar line after the last."""
    ticks = score.tempo_map.ticks_at([max(first_s, 0.0), max(last_s, 0.0)])
    first, last = score.tempo_map.bars_at(ticks).tolist()
    return range(first, min(last, score.bar_count) + 1) if last_s >= 0 else range(0)
