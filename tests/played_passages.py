"""Passages as whoever reads them from paper plays them: each pass the bars, then the ending that bears its number."""

from collections.abc import Iterator, Sequence

from station.music.repeats import Passage


def played_bars(passages: Sequence[Passage]) -> list[int]:
    """For every bar as it is played, in order, the bar on paper that says it."""
    return [bar for passage in passages for number in range(1, passage.times + 1) for bar in _pass(passage, number)]


def _pass(passage: Passage, number: int) -> Iterator[int]:
    yield from range(passage.first_bar, passage.last_bar + 1)
    for ending in passage.endings:
        if number in ending.passes:
            yield from range(ending.first_bar, ending.last_bar + 1)
