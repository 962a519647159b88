"""The bars in which the click is silent: so many in turn, or at random and more and more of them.

    GAP = ON/OFF | random | random:SHARE | random:SHARE-SHARE, and a number behind another colon

`4/1` sounds for four bars and is silent for one. `random` draws the silent bars from a seed, so that nobody can count
them and yet the same words give the same silences; the share may rise as a session goes on. Pure: the bar decides, not
the clock. What is drawn is drawn in blocks of `BLOCK_BARS`, each with its share of silent bars to the nearest bar, so
that a short session is as quiet as a long one. The first bar always sounds, and never more than `MOST_QUIET` bars in a
row are silent.
"""

import random
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import accumulate

from station.core.counts import is_count
from station.core.errors import BadInput

BLOCK_BARS = 8
"""A phrase of most grooves (our choice): 12.5 % is the smallest share that such a block can have."""
MOST_QUIET = 3
"""The longest silence of TEACHING's gap clicks (1/3)."""
LEAST_PCT, MOST_PCT = 10, 60
"""Below, a block has no silent bar; above (six of eight), `MOST_QUIET` leaves 1/3 in turn alone, which is no chance."""
FIRST_PCT, LAST_PCT = 20, 60
"""What `random` alone means: as quiet as TEACHING's 4/1 at first, in the end nearly as 1/3."""
RISE_BARS = 32
"""Bars after which the last share is reached: a minute at 128 bpm (our choice)."""
MOST_BARS = 1000
"""Longest stretch of `ON/OFF` (our choice: more than a lesson has)."""
MOST_SEED = 2**31 - 1
_RANDOM = "random"
EXPECTED = "bars with and without a click such as 4/1, or random, random:30%, random:20-60%"


@dataclass(frozen=True, slots=True)
class Gap:
    """The click sounds for some bars, then is silent for some: the quiet count."""

    sounding: int
    quiet: int

    def __post_init__(self) -> None:
        assert self.sounding >= 1, "a click that never sounds is none"
        assert self.quiet >= 1, "a gap lasts a bar at least"

    def is_quiet(self, bar: int) -> bool:
        """Whether the click is silent in `bar`, from 0."""
        return bar % (self.sounding + self.quiet) >= self.sounding

    def __str__(self) -> str:
        return f"{self.sounding}/{self.quiet}"


@dataclass(frozen=True, slots=True)
class RandomGap:
    """Silent bars at random: `first_pct` of them at the start, `last_pct` from bar `RISE_BARS` on.

    `seed` None is one that is to be drawn before a person plays (`drawn`), and means 0 where nobody draws. `before`
    counts bars that were played before bar 0, where a session goes on in another pass.
    """

    first_pct: int = FIRST_PCT
    last_pct: int = LAST_PCT
    seed: int | None = None
    before: int = 0

    def __post_init__(self) -> None:
        assert LEAST_PCT <= self.first_pct <= MOST_PCT, "a share that a block can have"
        assert LEAST_PCT <= self.last_pct <= MOST_PCT, "a share that a block can have"

    def is_quiet(self, bar: int) -> bool:
        """Whether the click is silent in `bar`, from 0."""
        block, within = divmod(bar, BLOCK_BARS)
        blocks = 1 << block.bit_length()  # few lengths, so that few rows are drawn and kept
        return _drawn_bars(self, blocks)[block * BLOCK_BARS + within]

    def share(self, bar: int) -> float:
        """The share of silent bars about `bar`, 0 to 1."""
        done = min((bar + self.before) / RISE_BARS, 1.0)
        return (self.first_pct + done * (self.last_pct - self.first_pct)) / 100.0

    def going_on(self, bars: int, turn: int) -> "RandomGap":
        """The same after `bars` bars, in the `turn`-th pass: other silences, and the share goes on rising."""
        return replace(self, seed=(self.seed or 0) + turn, before=self.before + bars) if turn else self

    def __str__(self) -> str:
        is_even = self.first_pct == self.last_pct
        share = f"{self.first_pct}%" if is_even else f"{self.first_pct}-{self.last_pct}%"
        return f"{_RANDOM}:{share}" + ("" if self.seed is None else f":{self.seed}")


QuietBars = Gap | RandomGap
"""Which bars are silent; its text is what `gap_of` reads."""


def gap_words(gap: QuietBars) -> str:
    """What a gap does, for people."""
    if isinstance(gap, Gap):
        return f"{_bars(gap.sounding)} of click, {gap.quiet} without, in turn"
    is_even = gap.first_pct == gap.last_pct
    share = f"{gap.first_pct} %" if is_even else f"{gap.first_pct} to {gap.last_pct} %"
    return f"the click drops out at random, {share} of the bars"


def _bars(count: int) -> str:
    return "1 bar" if count == 1 else f"{count} bars"


def drawn(gap: QuietBars | None) -> QuietBars | None:
    """The gap with a seed where one is still to be drawn."""
    if isinstance(gap, RandomGap) and gap.seed is None:
        return replace(gap, seed=random.SystemRandom().randrange(1000))  # short enough to say again
    return gap


# --- words ------------------------------------------------------------------------------------------------------------


def gap_of(text: str, source: str = "gap") -> QuietBars:
    """The gap that `text` asks for; raises `BadInput` that names `source` and the text."""
    word, _, rest = text.partition(":")
    if text == _RANDOM:
        return RandomGap()
    gap = _random_of(rest) if word == _RANDOM else _regular_of(text)
    if gap is None:
        raise BadInput(source, text[:40], f"expected {EXPECTED}")
    return gap


def _regular_of(text: str) -> Gap | None:
    numbers = [_number(part, MOST_BARS) for part in text.split("/")]
    if len(numbers) != 2 or not numbers[0] or not numbers[1]:
        return None
    return Gap(numbers[0], numbers[1])


def _random_of(rest: str) -> RandomGap | None:
    """What stands behind `random:`."""
    share, colon, number = rest.partition(":")
    seed = _number(number, MOST_SEED) if colon else None
    if colon and seed is None:
        return None
    shares = [_number(part, MOST_PCT) for part in share.removesuffix("%").split("-")]
    if len(shares) > 2 or shares[0] is None or shares[-1] is None or min(shares[0], shares[-1]) < LEAST_PCT:
        return None
    return RandomGap(shares[0], shares[-1], seed)


def _number(text: str, most: int) -> int | None:
    """A whole number from 0 to `most`, None for anything else."""
    return int(text) if text.isascii() and is_count(text) and int(text) <= most else None


# --- drawing ----------------------------------------------------------------------------------------------------------


@lru_cache(maxsize=32)
def _drawn_bars(gap: RandomGap, blocks: int) -> tuple[bool, ...]:
    """Which of the first `blocks` blocks of bars are silent, one after the other."""
    chance = random.Random(f"{gap.seed or 0}/{gap.before}")  # a string: the same numbers in every version of Python
    bars: list[bool] = []
    for block in range(blocks):
        quiet = round(BLOCK_BARS * gap.share(block * BLOCK_BARS))
        bars += chance.choice(_rows(quiet, _run(bars), is_first=block == 0))
    return tuple(bars)


def _run(bars: list[bool]) -> int:
    """How many bars at the end are silent."""
    return next((i for i, is_quiet in enumerate(reversed(bars)) if not is_quiet), len(bars))


@lru_cache(maxsize=128)
def _rows(quiet: int, before: int, is_first: bool) -> tuple[tuple[bool, ...], ...]:
    """Every row of a block with `quiet` silent bars, behind so many silent ones `before`."""
    rows = (tuple(bool(bits >> bar & 1) for bar in range(BLOCK_BARS)) for bits in range(1 << BLOCK_BARS))
    return tuple(
        row for row in rows if sum(row) == quiet and _longest(row, before) <= MOST_QUIET and not (is_first and row[0])
    )


def _longest(row: tuple[bool, ...], before: int) -> int:
    return max(accumulate(row, lambda run, is_quiet: run + 1 if is_quiet else 0, initial=before))
