"""Ways on through the score that rival each other, and what speaks for each, in nats.

A way is worth what its hits say (`evidence`), less what the notes say that it passed and nobody hit, less what it costs
to get there: far jumps and new tempi are rare. Whoever has just stopped may be anywhere, so that little is asked then.
"""

from bisect import bisect_left
from dataclasses import dataclass

from station.scoring.following.doubt import SLACK_S
from station.scoring.following.evidence import nats
from station.scoring.following.locate import MISS_COST, Notes
from station.scoring.following.shifts import LEAST_JUMP_S
from station.scoring.following.tempo_tracker import Place

_NEW_TEMPO, _SAME_TEMPO = 0.2, 0.06
"""SD of log tempo at the beginning and after a stop, and against the tempo so far (our choice)."""

_JUMP_COST = 18.0
"""Nats against a change of place (`pursuit` asks 15 of whoever knows what comes after)."""

_PER_S = 2.0
"""Nats more for each second of a jump (our choice: so early, where bars are alike, little but nearness decides)."""

_MOST_FOR_TIME, _MOST_FOR_TEMPO = 10.0, 6.0
"""Nats at most against a far jump, and against another tempo (our choice)."""

_RESUMED_COST = 5.0
"""Nats against a place after a stop, besides its distance: nothing is sure, so little is asked (our choice)."""


@dataclass(slots=True, eq=False)
class Line:
    """A way on: `hits` from the first for which it holds, their places and evidence, the `place` it has reached.

    `total` is what speaks for it in nats, on the scale of the way that is believed.
    """

    hits: list[int]
    places_s: list[float]
    nats: list[float]
    place: Place
    total: float = 0.0


def jump_cost(jump_s: float, log_tempo: float, is_resumed: bool) -> float:
    """Nats against a jump over `jump_s` to a tempo of `log_tempo` against the last; `is_resumed` after a stop."""
    new_tempo = log_tempo / (_NEW_TEMPO if is_resumed else _SAME_TEMPO)
    base = _RESUMED_COST if is_resumed or jump_s < LEAST_JUMP_S else _JUMP_COST
    return base + min(_PER_S * jump_s, _MOST_FOR_TIME) + min(0.5 * new_tempo * new_tempo, _MOST_FOR_TEMPO)


class Scales:
    """Weighs hits and the notes that they leave out."""

    def __init__(self, notes: Notes) -> None:
        self._note_s: list[float] = notes.at_s.tolist()
        self._rate_of: list[float] = notes.rates.tolist()

    def said(self, distance_s: float, match_class: int) -> float:
        """What a hit says that lies `distance_s` from the nearest note of its class."""
        return nats(distance_s, self._rate_of[match_class])

    def passed(self, place_s: float) -> int:
        """How many notes are passed at `place_s`."""
        return bisect_left(self._note_s, place_s + SLACK_S)

    def worth(self, places_s: list[float], said: list[float], before: int | None = None) -> list[float]:
        """What each hit says, less what the notes say that were passed since the hit before.

        `before` notes were passed before the first; None if it is not asked for those that it passed.
        """
        worth = []
        for place, nat in zip(places_s, said, strict=True):
            passed = self.passed(place)
            unheard = 0 if before is None else passed - before
            worth.append(nat + MISS_COST * ((nat > 0.0) - unheard))
            before = passed
        return worth
