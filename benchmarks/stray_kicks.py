"""Stray kicks measured: what the kit starts or chooses while somebody noodles, ends a song, or means it.

    python benchmarks/stray_kicks.py [--hours N] [--seed N]

Drummers are drawn: phrases of noodling (grooves, fills, a pedal that is tried, single strokes, a resting hi-hat foot)
with pauses between them, the last bars of a song with what follows it, and starts that are meant. Every share and pause
here is our choice, from how drummers behave at a kit; nobody was recorded. The rule of before (two kicks within a
second, nothing between them) stands beside ours. A few seconds.
"""

import argparse
from collections.abc import Callable, Iterable, Iterator

import numpy as np

from station.core.events import Hit
from station.core.pieces import Piece, Zone
from station.core.units import NS_PER_S
from station.practice.control.pad_choice import BEGINS, PadChoice, pads_for
from station.practice.control.pad_gestures import DOUBLE_TRIGGER_NS, TOGETHER_NS, TwoKicks

Stroke = tuple[float, Piece]
"""When, in seconds, and what."""
Random = np.random.Generator

K, S, H, C, F = Piece.KICK, Piece.SNARE, Piece.HIHAT, Piece.CRASH_1, Piece.HIHAT_PEDAL
TOMS = (S, Piece.TOM_1, Piece.TOM_2, Piece.FLOOR_TOM_1)
SCATTER = 0.04
"""Of an interval: an amateur's (HUMANS, Timing)."""
PAUSE_S, PAUSE_SIGMA = 1.2, 0.9
"""Pauses between phrases, log-normal: the median, and the spread of the logarithm; three in ten last two seconds."""
PHRASES = (0.35, 0.30, 0.12, 0.15, 0.08)
"""How often a phrase is a groove, a fill, a pedal that is tried, single strokes, a hi-hat foot."""
KICKS = (0.25, 0.25, 0.2, 0.2, 0.1)
"""How often a pedal is tried 1, 2, 3, 4, 8 times; two are the hardest to tell from a wish."""
ENDS = 2000


def _groove(rng: Random, bars: int) -> list[Stroke]:
    """Eighths on the hi-hat, a backbeat, kicks where they fall."""
    eighth = 30.0 / rng.uniform(70, 160)
    made: list[Stroke] = []
    for place in range(8 * bars):
        at = place * eighth + rng.normal(0, SCATTER * eighth)
        made.append((at, H))
        if place % 4 == 2:
            made.append((at, S))
        elif place % 4 == 0 or rng.random() < 0.2:
            made.append((at, K))
    return made


def _fill(rng: Random) -> list[Stroke]:
    step = 15.0 / rng.uniform(70, 160)
    return [(i * step + rng.normal(0, SCATTER * step), TOMS[rng.integers(4)]) for i in range(rng.integers(4, 24))]


def _row(rng: Random, count: int, piece: Piece, fastest_s: float, slowest_s: float) -> list[Stroke]:
    step = rng.uniform(fastest_s, slowest_s)
    return [(i * step + rng.normal(0, SCATTER * step), piece) for i in range(count)]


def _phrase(rng: Random) -> list[Stroke]:
    kind = rng.choice(len(PHRASES), p=PHRASES)
    if kind == 0:
        return _groove(rng, int(rng.integers(1, 5)))
    if kind == 1:
        return _fill(rng)
    if kind == 2:
        return _row(rng, int(rng.choice([1, 2, 3, 4, 8], p=KICKS)), K, 0.15, 0.8)
    if kind == 3:
        return _row(rng, int(rng.integers(1, 4)), Piece(rng.choice([*TOMS, C, H])), 0.3, 1.2)
    return _row(rng, int(rng.integers(2, 10)), F, 0.3, 0.7)


def _pause(rng: Random) -> float:
    return float(PAUSE_S * np.exp(PAUSE_SIGMA * rng.normal()))


def noodling(rng: Random, hours: float) -> list[Stroke]:
    """Somebody who plays for themselves, in rising order."""
    made: list[Stroke] = []
    now = 0.0
    while now < 3600 * hours:
        phrase = _phrase(rng)
        made += [(now + at, piece) for at, piece in phrase]
        now += max(at for at, _ in phrase) + _pause(rng)
    return sorted(made)


def song_end(rng: Random) -> list[Stroke]:
    """Two bars, the last crash, and half of the time a flourish, a kick or two, within two seconds."""
    made = _groove(rng, 2)
    last = max(at for at, _ in made) + 0.3
    made += [(last, C), (last + rng.normal(0, 0.01), K)]
    if rng.random() < 0.5:
        after = last + rng.uniform(0.3, 2.0)
        kicks = _row(rng, int(rng.integers(1, 4)), K, 0.2, 0.8)
        made += [(after + at, piece) for at, piece in (kicks if rng.random() < 0.5 else _fill(rng))]
    return sorted(made)


def meant(rng: Random, knows: bool) -> list[Stroke]:
    """A phrase, then two kicks: after at least two seconds by who `knows` the rule, after any pause by others."""
    phrase = sorted(_phrase(rng))
    first = phrase[-1][0] + (rng.uniform(2.0, 6.0) if knows else _pause(rng))
    return [*phrase, (first, K), (first + float(np.clip(rng.normal(0.45, 0.12), 0.15, 1.0)), K)]


def hits(strokes: Iterable[Stroke]) -> Iterator[Hit]:
    """The strokes as the kit sends them."""
    return (Hit(round(at * NS_PER_S), piece, Zone.HEAD, 90) for at, piece in strokes)


def starts_before(strokes: Iterable[Stroke]) -> int:
    """How often the rule of before starts."""
    before_ns, starts = None, 0
    for hit in hits(strokes):
        if hit.piece is not K:
            before_ns = None
        elif before_ns is None or hit.at_ns - before_ns > TOGETHER_NS:
            before_ns = hit.at_ns
        elif hit.at_ns - before_ns >= DOUBLE_TRIGGER_NS:
            before_ns, starts = None, starts + 1
    return starts


def starts_now(strokes: Iterable[Stroke]) -> int:
    """How often ours does."""
    kicks, starts, last_ns = TwoKicks(), 0, 0
    for hit in hits(strokes):
        starts += kicks.feed(hit)
        last_ns = hit.at_ns
    return starts + kicks.advance(last_ns + 10 * NS_PER_S)


def choices_before(strokes: Iterable[Stroke]) -> int:
    """How often any stroke on one of the four pads would choose."""
    return sum(piece in TOMS for _, piece in strokes)


def choices_now(strokes: Iterable[Stroke]) -> int:
    """How often what comes next, on four pads, begins; it comes up again each time."""
    pads, made = pads_for(4, {*TOMS, K, H, C}), 0
    choice = PadChoice(pads, 0, BEGINS)
    for hit in hits(strokes):
        if choice.feed(hit) is not None:
            made += 1
            choice = PadChoice(pads, hit.at_ns, BEGINS)
    return made


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description="false starts by the kit, before and now")
    parser.add_argument("--hours", type=float, default=50.0)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    rng = np.random.default_rng(options.seed)
    strokes = noodling(rng, options.hours)
    ends = [song_end(rng) for _ in range(ENDS)]
    print(f"{'':52} before    now")
    _told("false starts in an hour of noodling", strokes, starts_before, starts_now, options.hours)
    _told("next steps by pad in an hour of noodling", strokes, choices_before, choices_now, options.hours)
    each = [_share(ends, rule) for rule in (starts_before, starts_now)]
    print(f"{'ends of a song that start something, %':50} {each[0]:8.1f} {each[1]:6.1f}")
    for knows, words in ((True, "after two seconds or more"), (False, "after any pause")):
        wished = [meant(rng, knows) for _ in range(ENDS)]
        before, now = (_share(wished, rule) for rule in (starts_before, starts_now))
        print(f"{f'meant starts taken, {words}, %':50} {before:8.1f} {now:6.1f}")


def _told(
    what: str,
    strokes: list[Stroke],
    before: Callable[[list[Stroke]], int],
    now: Callable[[list[Stroke]], int],
    hours: float,
) -> None:
    print(f"{what:50} {before(strokes) / hours:8.1f} {now(strokes) / hours:6.1f}")


def _share(many: list[list[Stroke]], rule: Callable[[list[Stroke]], int]) -> float:
    return 100.0 * sum(rule(strokes) > 0 for strokes in many) / len(many)


if __name__ == "__main__":
    main()
