"""Where else a student without a click may be: the places where his last hits fit (`locate`), near before far.

Close by he may have taken any tempo; at the beginning, or after a skip, one near the last. The whole score is too much
for one look: what lies beyond the near places is taken piece by piece, to the left and right, one piece a look.
Times are seconds; score time is at the written tempo.
"""

from bisect import bisect_left, bisect_right

import numpy as np
from numpy.typing import NDArray

from station.scoring.following.evidence import best_evidence
from station.scoring.following.locate import Candidate, Hits, Notes, Search, candidates
from station.scoring.following.shifts import LEAST_JUMP_S
from station.scoring.following.tempo_tracker import Place

Floats = NDArray[np.float64]

SLOWEST, FASTEST = 0.4, 2.5
"""Beyond these nobody plays what is written (our choice)."""

_NEAR_S, _FAR_S, _CLOSE_S = 45.0, 300.0, 4.0
"""Seconds to both sides: where a skip is looked for first, how much a look beyond takes, where the tempo may jump."""

_NEAR_RATES = np.exp(np.arange(-4, 5) * 0.02)
_RATES = np.exp(np.arange(-18, 19) * 0.02)
"""Tempi tried: up to 8 % from the last after a skip, up to 43 % in place or at the beginning."""

_SLACK_RATE = 0.05
"""A place found may be so much beyond the tempi tried (our choice)."""

_ENOUGH = 0.5
"""Share of all possible evidence with which a place is believed without looking farther."""


class Elsewhere:
    """Looks for hits among `notes`, at least one."""

    def __init__(self, notes: Notes) -> None:
        self._notes = notes
        self._note_s: list[float] = notes.at_s.tolist()

    def places(self, window: Hits, here: Place, look: int) -> list[Place]:
        """Where `window` may have begun if not `here`; `look` counts from 1 since the hits last fitted."""
        possible = float(best_evidence(self._notes.rates[window.classes]).sum())
        here_s, rate, first_s = here.score_s, min(max(here.rate, SLOWEST), FASTEST), self._note_s[0]
        tried = self._candidates(window, _around(here_s, LEAST_JUMP_S), _RATES * rate, here_s)
        tried += self._candidates(window, _around(here_s, _CLOSE_S), _RATES * rate, here_s)
        if here_s > first_s + _CLOSE_S:
            tried += self._candidates(window, (first_s, first_s + _CLOSE_S), _NEAR_RATES * rate, first_s)
        tried += self._candidates(window, _around(here_s, _NEAR_S), _NEAR_RATES * rate, here_s)
        if look > 1 and max((candidate.nats for candidate in tried), default=0.0) < _ENOUGH * possible:
            tried += self._candidates(window, self._far(here_s, look), _NEAR_RATES * rate, here_s)
        slow, fast = rate * float(_RATES[0]) - _SLACK_RATE, rate * float(_RATES[-1]) + _SLACK_RATE
        return [candidate.place for candidate in tried if slow < candidate.place.rate < fast]

    def _candidates(
        self, window: Hits, among_s: tuple[float, float], rates: Floats, expected_s: float
    ) -> list[Candidate]:
        end_s = among_s[1] + float((window.at_s[-1] - window.at_s[0]) * rates[-1])
        among = slice(bisect_left(self._note_s, among_s[0]), bisect_right(self._note_s, end_s))
        return candidates(self._notes, _Anywhere(among, rates, expected_s), window)

    def _far(self, here_s: float, look: int) -> tuple[float, float]:
        """The part of the score that this look takes: first around `here_s`, then the next to the left and right."""
        steps = int((self._note_s[-1] - self._note_s[0]) / (2 * _FAR_S)) + 1
        turn = (look - 1) % (2 * steps)
        return _around(here_s + (turn + 1) // 2 * (1 if turn % 2 else -1) * 2 * _FAR_S, _FAR_S)


def _around(middle_s: float, reach_s: float) -> tuple[float, float]:
    return middle_s - reach_s, middle_s + reach_s


class _Anywhere(Search):
    """A search in which no place is likelier than another: what a jump costs is told later, line by line."""

    def cost(self, score_s: Floats) -> Floats:
        """Nothing."""
        return np.zeros(np.shape(score_s))
