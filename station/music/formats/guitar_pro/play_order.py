"""In which order the written bars are played: repeats, their endings, D.C., D.S., coda and Fine.

As books read them, and Guitar Pro plays them: a repeat without a beginning goes back to the end of the one before, an
ending lasts until the next ending or the repeat's end, and after D.C. and D.S. repeats are not made again: each is
passed through as the last time.
"""

from collections.abc import Callable, Iterator, Sequence

from station.core.errors import BadInput
from station.music.formats.guitar_pro.tab_song import MOST_TAB_BARS, Jump, Sign, TabBar


def play_order(bars: Sequence[TabBar], source: str) -> list[int]:
    """Indices of `bars` as they are played; raises `BadInput` where they grow beyond `MOST_TAB_BARS`."""
    order: list[int] = []
    for bar in _Player(bars).played():
        order.append(bar)
        if len(order) > MOST_TAB_BARS:
            raise BadInput(source, f"bar {bar + 1}", f"repeats make more than {MOST_TAB_BARS} bars")
    return order


class _Player:
    """Walks through the bars; `number` is which time the repeat around is played, from 1."""

    def __init__(self, bars: Sequence[TabBar]) -> None:
        self.bars = bars
        self.at = self.start = 0
        self.number = 1
        self.endings: frozenset[int] = frozenset()
        self.until: Sign | None = None
        self.has_jumped = False
        self.done: set[tuple[int, Jump]] = set()
        self.places = {sign: i for i, bar in reversed(list(enumerate(bars))) for sign in bar.signs}
        self.last_ending = _most_until_next_repeat(bars, lambda bar: max(bar.endings, default=0))
        self.passes = _most_until_next_repeat(bars, lambda bar: max(bar.plays, *bar.endings, 1))

    def played(self) -> Iterator[int]:
        while self.at < len(self.bars):
            bar = self.bars[self.at]
            self._enter(bar)
            if self.endings and self.number not in self.endings:
                self._skip(bar)
                continue
            yield self.at
            if Sign.FINE in bar.signs and self.until is Sign.FINE:
                return
            self._leave(bar)

    def _enter(self, bar: TabBar) -> None:
        if bar.opens_repeat and self.at != self.start:
            self._begin_repeat(self.at)
        if bar.endings:
            self.endings = bar.endings

    def _begin_repeat(self, at: int) -> None:
        """What follows from `at` on is a repeat of its own, after a jump in its last pass."""
        self.start, self.endings = at, frozenset()
        self.number = self.passes[at] if self.has_jumped and at < len(self.bars) else 1

    def _leave(self, bar: TabBar) -> None:
        last = max(bar.plays, self.last_ending[self.start])
        jump = next((j for j in bar.jumps if self._acts(j)), None)
        if bar.plays and self.number < last and not self.has_jumped:
            self.at, self.number, self.endings = self.start, self.number + 1, frozenset()
        elif jump is not None:
            self._jump(jump)
        else:
            self.at += 1
            if bar.plays:
                self._begin_repeat(self.at)

    def _skip(self, bar: TabBar) -> None:
        if bar.plays:
            self.endings = frozenset()
        self.at += 1

    def _acts(self, jump: Jump) -> bool:
        if (self.at, jump) in self.done or (jump.target is not None and jump.target not in self.places):
            return False
        return not jump.is_to_coda or self.until is jump.target

    def _jump(self, jump: Jump) -> None:
        self.done.add((self.at, jump))
        self.until = None if jump.is_to_coda else jump.until
        self.has_jumped = True
        self.at = 0 if jump.target is None else self.places[jump.target]
        self._begin_repeat(self.at)


def _most_until_next_repeat(bars: Sequence[TabBar], value: Callable[[TabBar], int]) -> list[int]:
    """For every bar the greatest `value` from it on, up to where the next repeat opens."""
    found = [0] * (len(bars) + 1)
    for i in range(len(bars) - 1, -1, -1):
        is_last = i + 1 == len(bars) or bars[i + 1].opens_repeat
        found[i] = max(value(bars[i]), 0 if is_last else found[i + 1])
    return found
