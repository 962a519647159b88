"""Ghosts, normal strokes and accents by the player's own levels: at most three a piece, named by musical sense.

The velocities of a piece fall into groups where few strokes lie between many: a smoothed histogram is cut at its
valleys. One group is one way to strike and no accent. Which of ghost, normal and accent several groups are is asked of
the whole take first: where all its levels are the station's own (`Velocities.usual`), that is what they are. Else two
groups are the two of the three whose loudness they are nearest to, in decibels, where that makes sense: accents stand
out from more that is not accented, and what is mostly struck softly is a ghost only where one hand fills in.

What a file says of ghosts and accents itself stays.
"""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations, pairwise
from math import log, sqrt
from statistics import median_low
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Dynamic, Piece
from station.drills.grid.stroke_settings import Velocities
from station.drills.grid.tab_symbols import TabFamily, family_of
from station.music.score import Note

SPREAD = 8.0
"""Standard deviation of a practised player's velocities at one intended loudness (HUMANS: ± 10 of 127)."""
_SMOOTHING = 0.75 * SPREAD
_VALLEY = 0.7
"""A valley is this much lower than the lower of its peaks: groups lie some 3 spreads apart (our choice)."""
_STEP = 18
"""Levels nearer to each other are one: two spreads and a little (our choice; our own are 36 and 48 apart)."""
_FEW, _FEW_SHARE = 3, 0.03
_EMPTY = 3 * SPREAD
"""A group of fewer strokes, or of less than that share, is one only if nothing lies so near to it (our choice)."""
_ENOUGH = 8
"""So many strokes of a piece tell its levels (our choice)."""
_AS_OURS = 9.5
"""Strokes so near to the station's own levels, in the mean, are meant as those: a spread and a lean (our choice). One
piece may lie further off by two standard errors of that mean, each a share of 1 / √(2n) for n strokes."""
_STRAYS = 0.05
_CLEAR = 1.5 * SPREAD
"""Two of a hundred strokes stray so far that they are nearer to the next level; where a piece has no more than that
share of a dynamic, only strokes so near to it are counted as such (our choice)."""
_TIDY = 6
"""So near to the usual velocity people's level is written as the usual one (our choice)."""
_ALL_VELOCITIES = np.arange(128)


@dataclass(frozen=True, slots=True)
class Level:
    """Strokes of one piece that are meant alike: velocities `low` to `high`, `middle` their median, how many."""

    low: int
    high: int
    middle: int
    count: int

    @property
    def is_exact(self) -> bool:
        """Whether all have one velocity, as a program writes them."""
        return self.low == self.high


_Named = Mapping[Piece, Mapping[Dynamic, Level]]


def with_dynamics(notes: Sequence[Note]) -> tuple[list[Note], Velocities]:
    """The main strokes `notes` with their dynamic and its velocity, and the velocities that a lesson says for them."""
    named = _said(notes) if any(n.dynamic is not Dynamic.NORMAL for n in notes) else _heard(notes)
    velocities = _velocities(named)
    return [_struck(n, named[n.piece], velocities) for n in notes], velocities


def _struck(note: Note, levels: Mapping[Dynamic, Level], velocities: Velocities) -> Note:
    dynamic = note.dynamic
    if dynamic not in levels or not levels[dynamic].low <= note.velocity <= levels[dynamic].high:
        dynamic = min(levels, key=lambda d: max(levels[d].low - note.velocity, note.velocity - levels[d].high))
    return replace(note, dynamic=dynamic, velocity=velocities.of(note.piece, dynamic))


def _said(notes: Sequence[Note]) -> _Named:
    """The levels as the file names them."""
    found: dict[Piece, dict[Dynamic, list[int]]] = {}
    for note in notes:
        found.setdefault(note.piece, {}).setdefault(note.dynamic, []).append(note.velocity)
    return {piece: {d: _level(sorted(v)) for d, v in own.items()} for piece, own in found.items()}


# --- groups -----------------------------------------------------------------------------------------------------------


def levels_of(velocities: Sequence[int]) -> list[Level]:
    """The groups that `velocities` fall into, the softest first; one to three."""
    ordered = sorted(velocities)
    groups = _cut(ordered, _valleys(ordered))
    groups = _cut(ordered, [(median_low(a) + median_low(b)) / 2 for a, b in pairwise(groups)])
    while (pair := _too_near(groups, len(ordered))) is not None:
        groups[pair : pair + 2] = [groups[pair] + groups[pair + 1]]
    return [_level(group) for group in groups]


def _level(ordered: Sequence[int]) -> Level:
    return Level(ordered[0], ordered[-1], median_low(ordered), len(ordered))


def _valleys(ordered: Sequence[int]) -> list[float]:
    """Where the smoothed histogram is lowest between peaks that stand out from it."""
    density = _density(ordered)
    peaks = np.flatnonzero((density > np.roll(density, 1)) & (density >= np.roll(density, -1)))
    kept: list[int] = []
    for peak in peaks.tolist():
        if kept and density[kept[-1] : peak + 1].min() > _VALLEY * min(density[kept[-1]], density[peak]):
            kept[-1] = max(kept[-1], peak, key=lambda at: density[at])
        else:
            kept.append(peak)
    return [float(a + np.argmin(density[a : b + 1])) for a, b in pairwise(kept)]


def _density(ordered: Sequence[int]) -> NDArray[np.float64]:
    """The histogram smoothed by a bell; what is cut off at 127, where modules end, counts on this side."""
    counts = np.bincount(ordered, minlength=128).astype(np.float64)
    bells = np.exp(-(((_ALL_VELOCITIES[:, None] - _ALL_VELOCITIES) / _SMOOTHING) ** 2) / 2)
    density: NDArray[np.float64] = (bells / bells.sum(0)) @ counts
    return np.concatenate([density, [0.0]])


def _cut(ordered: Sequence[int], at: Sequence[float]) -> list[list[int]]:
    ends = [0, *np.searchsorted(ordered, at, side="right").tolist(), len(ordered)]
    return [list(ordered[a:b]) for a, b in pairwise(ends) if b > a]


def _too_near(groups: Sequence[Sequence[int]], count: int) -> int | None:
    """The first of two neighbours that are one group: too near, too few, or more than there are words for."""
    gaps = [median_low(b) - median_low(a) for a, b in pairwise(groups)]
    for i, (a, b) in enumerate(pairwise(groups)):
        is_few = min(len(a), len(b)) < max(_FEW, _FEW_SHARE * count)
        are_exact = a[0] == a[-1] and b[0] == b[-1] and max(len(a), len(b)) >= _FEW
        if gaps[i] < _STEP or (is_few and not are_exact and b[0] - a[-1] < _EMPTY):
            return i
    return gaps.index(min(gaps)) if len(groups) > len(Dynamic) else None


# --- names ------------------------------------------------------------------------------------------------------------


def _heard(notes: Sequence[Note]) -> _Named:
    """The levels of each piece by their names; pieces of one kind, such as toms, have the same."""
    by_kind: dict[Piece, list[int]] = {}
    for note in notes:
        by_kind.setdefault(_kind(note.piece), []).append(note.velocity)
    if _are_ours(by_kind.values()):
        common = {kind: _common(heard) for kind, heard in by_kind.items()}
        return _said([replace(n, dynamic=_as_ours(n.velocity, common[_kind(n.piece)])) for n in notes])
    levels = {kind: levels_of(heard) for kind, heard in by_kind.items()}
    return {piece: _named(levels[_kind(piece)], family_of(piece) in _FILLED_IN) for piece in {n.piece for n in notes}}


def _kind(piece: Piece) -> Piece:
    """The first of the pieces that are struck alike: toms, and cymbals that are crashed."""
    kinds = {family_of(p): p for p in sorted(Piece, reverse=True)}
    return piece if family_of(piece) is TabFamily.SMALL else kinds[family_of(piece)]


_ANY = tuple(Dynamic)
_FILLED_IN = (TabFamily.SNARE, TabFamily.TOM)
"""Drums on which ghosts may be most of what is struck: they fill in between (our choice)."""


def _are_ours(kinds: Iterable[Sequence[int]]) -> bool:
    """Whether the station's own levels, two of them at least, with human spread are all that a take has."""
    known = list(kinds)
    many = [heard for heard in known if len(heard) >= _ENOUGH]
    if any(_distance(heard) > _AS_OURS * (1 + 2 / sqrt(2 * len(heard))) for heard in many):
        return False
    return len(set().union(*map(_common, known))) > 1 and _distance([v for heard in known for v in heard]) <= _AS_OURS


def _distance(heard: Sequence[int]) -> float:
    """How far velocities lie from the station's own levels: the root of the mean square."""
    usual = Velocities().usual
    return sqrt(sum((v - usual[_as_ours(v, _ANY)]) ** 2 for v in heard) / len(heard))


def _common(heard: Sequence[int]) -> tuple[Dynamic, ...]:
    """The dynamics that more than strays of these velocities are."""
    counts = Counter(_as_ours(v, _ANY) for v in heard)
    return tuple(d for d in Dynamic if counts[d] > _STRAYS * len(heard))


def _as_ours(velocity: int, common: Sequence[Dynamic]) -> Dynamic:
    """The dynamic whose usual velocity is nearest; one that is not `common` only where it is clear."""
    usual = Velocities().usual
    nearest = min(Dynamic, key=lambda d: abs(usual[d] - velocity))
    if nearest in common or abs(usual[nearest] - velocity) <= _CLEAR:
        return nearest
    return min(common, key=lambda d: abs(usual[d] - velocity))


def _named(levels: Sequence[Level], may_be_filled: bool) -> Mapping[Dynamic, Level]:
    """One, two or three groups of a piece by what they are called; three that make no sense as such are two."""
    if len(levels) == 1:
        return {Dynamic.NORMAL: levels[0]}
    named = [dict(zip(names, levels, strict=True)) for names in combinations(Dynamic, len(levels))]
    possible = [each for each in named if _makes_sense(each, may_be_filled)]
    return min(possible, key=_farness) if possible else _named(_nearest_joined(levels), may_be_filled)


def _farness(named: Mapping[Dynamic, Level]) -> float:
    """How far groups are from the usual loudness of their names."""
    usual = Velocities().usual
    return sum(abs(log(level.middle / usual[d])) for d, level in named.items())


def _makes_sense(named: Mapping[Dynamic, Level], may_be_filled: bool) -> bool:
    """Whether what is marked is half of the strokes at most, strays apart, and ghosts where they may fill in."""
    count = sum(level.count for level in named.values())
    most = count / 2 + max(1, _STRAYS * count)
    rare = [Dynamic.ACCENT] if may_be_filled else [Dynamic.ACCENT, Dynamic.GHOST]
    return all(named[d].count <= most for d in rare if d in named)


def _nearest_joined(levels: Sequence[Level]) -> list[Level]:
    """The levels, the two as one that are nearest to each other."""
    k = min(range(len(levels) - 1), key=lambda i: levels[i + 1].middle - levels[i].middle)
    one, other = levels[k : k + 2]
    most = max(one, other, key=lambda level: level.count)
    return [*levels[:k], Level(one.low, other.high, most.middle, one.count + other.count), *levels[k + 2 :]]


def _velocities(named: _Named) -> Velocities:
    """The velocity of each dynamic, and of the pieces that differ; the usual one where no stroke says otherwise."""
    usual = _usual_of(named)
    of_piece: dict[Piece, tuple[int, int, int]] = {}
    for piece in sorted(named):
        three = _rising(*(_tidy(named[piece].get(d), usual[d], Velocities().usual[d]) for d in Dynamic))
        if three != usual:
            of_piece[piece] = three
    return Velocities(usual, MappingProxyType(of_piece))


def _usual_of(named: _Named) -> tuple[int, int, int]:
    """What is said once for all pieces: of each dynamic the velocity that two of them share, or the only piece has."""
    ours = Velocities().usual
    said = [Counter(_tidy(own[d], ours[d], ours[d]) for own in named.values() if d in own) for d in Dynamic]
    needed = min(2, len(named))
    shared = [
        max(heard, key=lambda v: (heard[v], v == usual)) if heard and max(heard.values()) >= needed else usual
        for heard, usual in zip(said, ours, strict=True)
    ]
    return _rising(*shared)


def _rising(ghost: int, normal: int, accent: int) -> tuple[int, int, int]:
    """No ghost louder than a normal stroke, and no accent softer."""
    return min(ghost, normal), normal, max(normal, accent)


def _tidy(level: Level | None, usual: int, ours: int) -> int:
    """The velocity of a level: `usual` where there is none, `ours` where it is near to that."""
    if level is None:
        return usual
    return ours if not level.is_exact and abs(level.middle - ours) <= _TIDY else level.middle
