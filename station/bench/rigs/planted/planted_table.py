"""The words, one after the other: on which music each is planted, how often, and the table of what came of it."""

from collections.abc import Iterable
from functools import cache

import numpy as np

from station.bench.rigs.planted.planted_music import grooves, lessons
from station.bench.rigs.planted.planted_stage import Stage
from station.bench.rigs.planted.planted_trials import (
    NONE,
    PAIRS,
    SDS_MS,
    Tally,
    exercised,
    faultless,
    pair,
    seed_of,
    single,
    spread_takes,
    stage,
)

MOST_STAGES = 60
"""Stages that a word is planted on at most, drawn; our choice."""

HEAD = """| word | takes | size | first % | as alternative % | named % | innocent first % | silent % | said instead |
|---|---|---|---|---|---|---|---|---|"""


@cache
def stages(quick: bool, times: float = 1.0) -> list[Stage]:
    """All music under all conditions; `quick`, each once, under one of them in turn."""
    music = [*lessons(), *grooves()]
    every = [(sd_ms, clocked) for clocked in (True, False) for sd_ms in SDS_MS]
    if quick:
        return [stage(each, *every[k * 5 % len(every)], times) for k, each in enumerate(music)]
    return [stage(each, *conditions, times) for each in music for conditions in every]


def places(name: str, of: list[Stage]) -> list[int]:
    """The stages that exercise a word, in an order of the word's own."""
    if name in (NONE, PAIRS):
        found = [k for k, each in enumerate(of) if not each.written.is_buzzed]
    else:
        found = [k for k, each in enumerate(of) if name in exercised(each)]
    order = np.random.default_rng(seed_of(name, 0, 0)).permutation(len(found))
    return [found[k] for k in order.tolist()]


def measure(name: str, takes: int, quick: bool, times: float = 1.0) -> Tally:
    """All takes of a word (or of none, or of pairs), dealt out over its stages; faults `times` their size."""
    tally, music = Tally(), stages(quick, times)
    where = places(name, music)
    if name not in (NONE, PAIRS):
        where = where[:MOST_STAGES]
    for at, each in spread_takes(where, takes):
        of = music[at]
        if name == NONE:
            faultless(of, at, each, tally)
        elif name == PAIRS:
            pair(of, at, each, tally)
        else:
            single(name, of, at, each, tally)
    return tally


def row(name: str, tally: Tally) -> str:
    """A line of the table; empty where no music exercises the word."""
    if not tally.takes:
        return ""
    counts = (tally.first, tally.beside, tally.named, tally.innocent, tally.silent)
    shares = " | ".join(f"{100 * count / tally.takes:.1f}" for count in counts)
    size = f"{np.median(tally.sizes):.1f}" if tally.sizes else ""
    return f"| `{name}` | {tally.takes} | {size} | {shares} | {_most(tally.instead.most_common(4))} |"


def missed_on(tally: Tally) -> str:
    """The music on which a word was missed most."""
    return _most(tally.stages.most_common(12))


def _most(counted: Iterable[tuple[str, int]]) -> str:
    return ", ".join(f"{each} {count}" for each, count in counted)
