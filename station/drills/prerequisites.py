"""What should come before what: the prerequisites that lessons and courses name, and what is wrong with them."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass

from station.core.did_you_mean import did_you_mean

Named = Mapping[str, Sequence[str]]
"""What each one names as coming before it."""


@dataclass(frozen=True, slots=True)
class OrderFault:
    """What is wrong with the `index`-th prerequisite of `name`."""

    name: str
    index: int
    text: str


def order_faults(named: Named, known: Collection[str], noun: str) -> list[OrderFault]:
    """The prerequisites that are not `known`, and the circles: each once, in the first name of the alphabet on it.

    `noun` is what they are called: lesson, course.
    """
    return [*_unknown(named, known, noun), *_circles(named)]


def _unknown(named: Named, known: Collection[str], noun: str) -> Iterator[OrderFault]:
    for name, before in named.items():
        for index, word in enumerate(before):
            if word not in known:
                yield OrderFault(name, index, f"no such {noun}: {word}{did_you_mean(word, known)}")


def _circles(named: Named) -> Iterator[OrderFault]:
    for name, before in named.items():
        for index, word in enumerate(before):
            way = _way(named, word, name)
            if way and min(way) == name:
                yield OrderFault(name, index, f"a circle: {' needs '.join([name, *way])}")
                break


def _way(named: Named, start: str, goal: str) -> tuple[str, ...]:
    """The shortest way from `start` to `goal` over prerequisites, both included; empty where there is none."""
    ways: list[tuple[str, ...]] = [(start,)]
    seen = {start}
    for way in ways:  # which grows meanwhile
        if way[-1] == goal:
            return way
        onward = [word for word in named.get(way[-1], ()) if word not in seen]
        seen.update(onward)
        ways += [(*way, word) for word in onward]
    return ()
