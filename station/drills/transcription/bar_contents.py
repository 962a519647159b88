"""What each bar of a piece is, for comparing bars with each other: whoever plays the same, plays it in the same way."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import CYMBALS, TOMS, Piece
from station.music.score import Score

_CRASHES = frozenset(CYMBALS - {Piece.RIDE, Piece.RIDE_2})
_FILL_SHARE = 0.4
"""A bar of which so many of the hands' strokes are on toms is a fill (our choice)."""


@dataclass(frozen=True, slots=True)
class BarContents:
    """The bars of a piece, from 0.

    `contents` has a number for each, the same for bars that sound and read alike, tempo and meter included. `cuts` are
    the bars before which the tempo or meter changes, `bound` those into which a buzz or a ringing cymbal goes on,
    `crashes` those that begin with a crash, `fills` those that are played on toms. `pick_up` is how many bars,
    silent ones among them, come before the first whole one: where the music begins in the second half of a bar.
    """

    contents: tuple[int, ...]
    cuts: frozenset[int]
    bound: frozenset[int]
    crashes: frozenset[int]
    fills: frozenset[int]
    pick_up: int

    @property
    def count(self) -> int:
        """How many bars there are."""
        return len(self.contents)


def bar_contents(score: Score, beyond: NDArray[np.void]) -> BarContents:
    """The bars of `score`, with what is `beyond` the player in them."""
    starts = [score.tempo_map.bar_start(bar) for bar in range(score.bar_count + 1)]
    settings = [(score.tempo_map.us_per_quarter_at(s), str(score.tempo_map.meter_at(s))) for s in starts[:-1]]
    numbers: dict[object, int] = {}
    contents: list[int] = []
    rows, others = _by_bar(score.notes, starts), _by_bar(beyond, starts)
    for bar, start in enumerate(starts[:-1]):
        key = (settings[bar], _relative(rows[bar], start), _relative(others[bar], start))
        contents.append(numbers.setdefault(key, len(numbers)))
    lasts = score.notes["tick"] + np.maximum(score.notes["duration_ticks"], score.notes["choke_ticks"])
    bound = {
        bar
        for first, last in zip(score.bar.tolist(), score.tempo_map.bars_at(lasts - 1).tolist(), strict=True)
        for bar in range(first + 1, last + 1)
    }
    return BarContents(
        tuple(contents),
        frozenset(bar for bar, (a, b) in enumerate(pairwise(settings), 1) if a != b),
        frozenset(bound),
        frozenset(bar for bar in range(len(rows)) if _begins_with_a_crash(rows[bar], starts[bar])),
        frozenset(bar for bar in range(len(rows)) if _is_fill(rows[bar])),
        _pick_up(score, starts),
    )


def _pick_up(score: Score, starts: list[int]) -> int:
    if not len(score):
        return 0
    bar, tick = int(score.bar[0]), int(score.notes["tick"][0])
    begins_late = 2 * (tick - starts[bar]) >= starts[bar + 1] - starts[bar]
    return bar + 1 if begins_late and bar + 2 < len(starts) else 0


def _by_bar(rows: NDArray[np.void], starts: list[int]) -> list[NDArray[np.void]]:
    return np.split(rows, np.searchsorted(rows["tick"], starts[1:-1]))


def _relative(rows: NDArray[np.void], start: int) -> bytes:
    moved = rows.copy()
    moved["tick"] -= start
    moved["midi_note"] = 0
    return moved.tobytes()


def _begins_with_a_crash(rows: NDArray[np.void], start: int) -> bool:
    return bool(np.isin(rows["piece"][rows["tick"] == start], sorted(_CRASHES)).any())


def _is_fill(rows: NDArray[np.void]) -> bool:
    hands = rows["piece"][~np.isin(rows["piece"], (Piece.KICK, Piece.HIHAT_PEDAL))]
    return len(hands) > 0 and bool(np.isin(hands, TOMS).mean() >= _FILL_SHARE)
