"""Takes with planted faults, and what the station says of them, counted word by word.

A word is named when an advice has it as its fault or among its `alternatives`. Words whose strokes are the same to
nine tenths are one explanation, and either is right: where the hi-hat plays all off-beats and nothing else, a late
hi-hat is late off-beats.
"""

import zlib
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cache
from itertools import combinations

import numpy as np

from station.bench.rigs.planted.planted_faults import FAULTS
from station.bench.rigs.planted.planted_music import Music
from station.bench.rigs.planted.planted_oracle import SAME_STROKES
from station.bench.rigs.planted.planted_player import Conditions, Sheet, play
from station.bench.rigs.planted.planted_routes import sounds_as_repeated
from station.bench.rigs.planted.planted_stage import Planted, Stage
from station.bench.rigs.planted.planted_strokes import Mask, Written
from station.core.pieces import Limb, Piece, word
from station.music.performance import Performance
from station.scoring.align import align
from station.scoring.analysis.summary import SummaryView, summarise
from station.scoring.report.advice import Advice, advise

SDS_MS = (10.0, 15.0, 20.0)
_SHARE_OF_GAP = 0.15
"""A player's SD is at most that share of the music's short intervals, else 10 ms (HUMANS: novices 6–10 %)."""
_MOST_ALTERNATIVES = 3
"""More explanations than that at once are none; our choice."""
_APART = 0.2
"""Of its information at most that share a fault loses to the other of a pair; its error grows by a tenth."""


def stage(music: Music, sd_ms: float, clocked: bool, times: float = 1.0) -> Stage:
    """Music under conditions; a player's scatter is never more than the music can bear."""
    written = Written(music)
    bearable = sd_ms if sd_ms <= _SHARE_OF_GAP * written.short_gap_ms else min(SDS_MS)
    return Stage(written, Conditions(bearable, clocked), times)


@cache
def exercised(of: Stage) -> dict[str, Planted]:
    """The faults that a stage exercises, at their sizes."""
    if of.written.is_buzzed:
        return {}
    made = {name: make(of) for name, make in FAULTS.items()}
    assert of.explanations  # made while the precision is there
    of.forget()
    return {name: fault for name, fault in made.items() if fault is not None}


def accepted(fault: Planted, of: Stage) -> frozenset[str]:
    """The words that say the same of this music, so far as anybody can tell."""
    if fault.kind in of.explanations:
        return of.explanations[fault.kind].as_good({fault.word: fault.size})
    if fault.kind == "spread":
        others = [each for each in exercised(of).values() if each.kind == "spread"]
        return frozenset(each.word for each in others if _common(each.strokes, fault.strokes) >= SAME_STROKES)
    if fault.kind == "route" and fault.word != "stopped" and sounds_as_repeated(of.written):
        return frozenset({"left_out_bars", "repeated_bars"})
    return frozenset({fault.word})


def _common(one: Mask, other: Mask) -> float:
    either = int((one | other).sum())
    return int((one & other).sum()) / either if either else 0.0


@dataclass(frozen=True, slots=True)
class Heard:
    """What the station said of a take: the words of each advice, its own first, then its alternatives."""

    items: tuple[tuple[str, ...], ...]

    def first(self, words: frozenset[str]) -> bool:
        """Whether the first advice says one of the words, as its own or as an alternative."""
        return bool(self.items) and bool(words.intersection(self.items[0]))

    def first_only_beside(self, words: frozenset[str]) -> bool:
        """Whether the first advice says one of the words only as an alternative."""
        return self.first(words) and self.items[0][0] not in words

    def anywhere(self, words: frozenset[str]) -> bool:
        """Whether any advice says one of the words."""
        return any(words.intersection(item) for item in self.items)


def heard(of: Stage, faults: Iterable[Planted], seed: Sequence[int]) -> Heard:
    """One take with these faults: played, aligned, summarised, advised."""
    rng = np.random.default_rng(seed)
    sheet = Sheet.as_written(of.written)
    for fault in faults:
        sheet = fault.plant(sheet, rng)
    return said(of, play(of.written, sheet, of.conditions, rng))


def said(of: Stage, performance: Performance) -> Heard:
    """What the station says of a performance."""
    music, clocked = of.written.music, of.conditions.clocked
    alignment = align(music.score, performance, clocked=clocked, may_share_base=False)
    view = SummaryView(pass_bars=music.pass_bars, first_bar=music.first_bar)
    return Heard(tuple(_words(item) for item in advise(summarise(music.score, performance, alignment, view))))


def _words(item: Advice) -> tuple[str, ...]:
    """Its word and its alternatives, none of them where it names so many that it says nothing."""
    alternatives: tuple[str, ...] = getattr(item, "alternatives", ())
    return (item.fault, *(alternatives if len(alternatives) <= _MOST_ALTERNATIVES else ()))


_BLAMED = frozenset(
    {f"{side}_{word(p)}" for p in Piece for side in ("late", "early")}
    | {f"{side}_{word(limb)}" for limb in Limb if limb.is_hand for side in ("late", "early")}
    | {f"unsteady_{word(limb)}" for limb in Limb}
    | {"slow_hihat_foot", "early_hihat_foot", "weak_left", "weak_right"}
)
"""Words that blame a piece or a limb."""


@dataclass
class Tally:
    """Takes of one word: in how many it was named first, only beside another, at all, an innocent first, nothing said.

    `instead` counts what was said first where it was not the word, "-" for nothing; `stages` where.
    """

    takes: int = 0
    first: int = 0
    beside: int = 0
    named: int = 0
    innocent: int = 0
    silent: int = 0
    instead: Counter[str] = field(default_factory=Counter)
    stages: Counter[str] = field(default_factory=Counter)
    sizes: list[float] = field(default_factory=list)

    def add(self, of: Stage, size: float, words: frozenset[str], what: Heard) -> None:
        """Count one take."""
        self.takes += 1
        self.sizes.append(size)
        self.silent += not what.items
        self.named += what.anywhere(words)
        self.beside += what.first_only_beside(words)
        if what.first(words):
            self.first += 1
            return
        first = what.items[0][0] if what.items else "-"
        self.innocent += first in _BLAMED
        self.instead[first] += 1
        self.stages[of.written.music.name + (" click" if of.conditions.clocked else " free")] += 1

    def merge(self, other: "Tally") -> None:
        """Add another's counts."""
        for name in ("takes", "first", "beside", "named", "innocent", "silent"):
            setattr(self, name, getattr(self, name) + getattr(other, name))
        self.instead += other.instead
        self.stages += other.stages
        self.sizes += other.sizes


NONE, PAIRS = "none", "pairs"


def seed_of(name: str, stage_at: int, take: int) -> tuple[int, int, int]:
    """A seed of its own for every word, stage and take, the same in every run."""
    return zlib.crc32(name.encode()), stage_at, take


def single(name: str, of: Stage, at: int, takes: range, tally: Tally) -> None:
    """Takes of one fault on one stage."""
    fault = exercised(of)[name]
    words = accepted(fault, of)
    for take in takes:
        tally.add(of, fault.size, words, heard(of, [fault], seed_of(name, at, take)))


def faultless(of: Stage, at: int, takes: range, tally: Tally) -> None:
    """Takes without a fault: only silence is right."""
    for take in takes:
        what = heard(of, [], seed_of(NONE, at, take))
        tally.takes += 1
        tally.silent += not what.items
        tally.first += not what.items
        if what.items:
            tally.instead[what.items[0][0]] += 1
            tally.innocent += what.items[0][0] in _BLAMED
            tally.stages[of.written.music.name + (" click" if of.conditions.clocked else " free")] += 1


def pairs_on(of: Stage) -> list[tuple[Planted, Planted]]:
    """Two faults that can be heard beside each other, in an order of the music's own."""
    faults = [each for each in exercised(of).values() if each.kind not in ("route", "errors")]
    pairs = [pair for pair in combinations(faults, 2) if _go_together(of, *pair)]
    order = np.random.default_rng(zlib.crc32(of.written.music.name.encode())).permutation(len(pairs))
    return [pairs[k] for k in order.tolist()]


def _go_together(of: Stage, one: Planted, other: Planted) -> bool:
    """Whether both can be told at once: different kinds, or strokes so different that no third word explains both."""
    if one.kind != other.kind:
        return True
    if one.kind not in of.explanations:
        return False
    told = of.explanations[one.kind]
    return told.overlap(one.word, other.word) < _APART and not told.as_good(
        {each.word: each.size for each in (one, other)}
    )


def pair(of: Stage, at: int, takes: range, tally: Tally) -> None:
    """Takes of two faults at once: right where both are named."""
    pairs = pairs_on(of)
    for take in takes:
        if not pairs:
            return
        faults = pairs[take % len(pairs)]
        what = heard(of, faults, seed_of(PAIRS, at, take))
        each = [what.anywhere(accepted(fault, of)) for fault in faults]
        tally.takes += 1
        tally.first += all(each)
        tally.named += any(each)
        for fault, was_named in zip(faults, each, strict=True):
            tally.instead[fault.word] += not was_named
        tally.silent += not what.items


def spread_takes(stages: Sequence[int], takes: int) -> Iterator[tuple[int, range]]:
    """So many takes dealt out over stages, as evenly as goes."""
    for k, at in enumerate(stages):
        count = takes // len(stages) + (k < takes % len(stages))
        if count:
            yield at, range(count)
