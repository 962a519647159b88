"""How hard a lesson is, measured from its strokes: one number 0–100 for order, and the parts that it is made of.

A part is a plain figure of the loop as it is played round and round (strokes a second, bits, changes a second). Each is
held against a size at which it counts in full, and its share of that, at most 1, is multiplied by its weight; the
weights add to 100. Nothing is all of it at once: the first lessons have about 7, the hardest that ship about 50.
Sizes and weights, and what they were checked against, are told in docs/difficulty.md.

Who plays what is asked of `motion.sticking`, so that a lesson without a sticking is measured as the drummer plays it.
"""

from collections import Counter
from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from itertools import pairwise
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import TOMS, Articulation, Dynamic, Limb, Ornament, Piece
from station.core.units import PPQ
from station.drills.lesson import Lesson
from station.motion.kit.kit import Kit, load_kit
from station.motion.sticking.limbs import limbs_and_reasons
from station.music.score import Score
from station.music.swing import STRAIGHT, Swing

BUSY_S = 2.0
"""Speed is that of the busiest so many seconds: a fill's length at a middle tempo (our choice)."""
REBOUND = 0.5
"""What the second stroke of a diddle, or a grace stroke, counts as a stroke of its hand: a rebound or a drop of the
stick is no whole stroke (HUMANS, Heights: the second bounce of a double comes by itself; half is our choice)."""
ORNAMENTS: Mapping[int, float] = MappingProxyType(
    {Ornament.DIDDLE: 0.6, Ornament.ROLL: 0.8, Ornament.FLAM: 1.0, Ornament.DRAG: 1.5}
)
"""What an ornament in the hands is worth, half of it for having it, all of it at `ORNAMENTS_A_SECOND`.

An exam board brings doubles in its first grade, flams and drags in its third (docs/difficulty.md); that a drag is more
than a flam, and the distances, are our choice.
"""
ORNAMENTS_A_SECOND = 3.0
"""Flam taps in triplets at 90, a test of the middle grades (our choice)."""
ACCENT_STEP = 0.25
"""What a step between normal strokes and accents counts, where one from or to a ghost counts one (our choice)."""
SWINGS = 0.5
"""What swing is worth, as much as triplets (our choice)."""
DIVISIONS: tuple[tuple[tuple[int, ...], float], ...] = (
    ((2, 4, 8), 0.0),
    ((3, 6, 12), 0.5),
    ((5, 10), 2.5),
    ((7, 14), 3.0),
)
"""Divisions of a beat that are felt as one, and what they are worth. Any other counts as the last (our choice)."""
ON_THE_BEAT, HALFWAY, BETWEEN = 0.25, 0.6, 1.0
"""What a bit of independence counts by where in the beat it is.

Books of coordination begin with strokes on the beat, go on to the "and" and end with the sixteenths about it; the sizes
are our choice.
"""
_FINEST = 2520
"""Parts of a beat to which a stroke's place is rounded: 2³·3²·5·7 has all divisions above but the 16th part."""
_HALVES = (_FINEST // 2, _FINEST // 3, _FINEST * 2 // 3)
"""Places of the "and", and of triplets."""
_DRUMS = 1
_VOICES: tuple[frozenset[Piece], ...] = (
    frozenset({Piece.KICK}),
    frozenset({Piece.SNARE, *TOMS}),
    frozenset({Piece.HIHAT_PEDAL}),
)
"""What is heard as one line; all that is struck besides is another, and so are the accents of drums."""


@dataclass(frozen=True, slots=True)
class Part:
    """`weight` of the 100 points, reached where the figure is `full`, none up to `free`; `says` what is measured."""

    weight: float
    free: float
    full: float
    unit: str
    says: str

    def points(self, figure: float) -> float:
        """What a figure adds, 0 to `weight`."""
        return self.weight * min(1.0, max(0.0, figure - self.free) / (self.full - self.free))


PARTS: Mapping[str, Part] = MappingProxyType(
    {
        "hands": Part(14, 2.0, 8.0, "strokes/s", "strokes of the busier hand in the busiest two seconds"),
        "feet": Part(8, 1.0, 6.0, "strokes/s", "the same of the busier foot"),
        "limbs": Part(4, 0.0, 3.0, "limbs", "how many play beside the first"),
        "independence": Part(14, 0.0, 0.8, "bits", "how little a limb's strokes follow from the others' and the beat"),
        "sticking": Part(
            8, 0.0, 1.2, "bits", "where the hands take turns, how little the next hand follows from this one"
        ),
        "rhythm": Part(
            12, 0.0, 3.0, "", "strokes off the beat with none on the next; odd and mixed divisions, odd meters"
        ),
        "variety": Part(8, 1.0, 3.5, "bits", "how many different beats there are, as a power of two"),
        "dynamics": Part(
            8, 0.0, 3.0, "steps/s", "from ghosts to louder strokes and back within a limb; accents a quarter"
        ),
        "ornaments": Part(22, 0.0, 2.0, "", "flams, drags, diddles, buzzes"),
        "movement": Part(2, 0.0, 3.0, "moves/s", "ways of a hand to another piece"),
    }
)
"""The parts in the order of the table. A hand's 8 and a foot's 6 strokes a second are what trained players reach, above
the 5–7 and 5–6 of players in general and below champions (HUMANS, Heights); the rest is our choice, checked as
docs/difficulty.md says."""


@dataclass(frozen=True, slots=True)
class Difficulty:
    """`figures` has the size of each of `PARTS` in its unit, `strokes_per_s` all limbs together when busiest."""

    figures: Mapping[str, float]
    strokes_per_s: float

    @property
    def points(self) -> dict[str, float]:
        """What each part adds, at most its weight."""
        return {name: part.points(self.figures[name]) for name, part in PARTS.items()}

    @property
    def total(self) -> float:
        """0–100; for order, not for comparing people."""
        return sum(self.points.values())


def difficulty(lesson: Lesson, tempo_bpm: float | None = None) -> Difficulty:
    """How hard the loop of `lesson` is at `tempo_bpm` quarter notes a minute, its written tempo if None."""
    speed = 1.0 if tempo_bpm is None else tempo_bpm / lesson.tempo_bpm
    return measured(lesson.loop_score.at_speed(speed), lesson.beat_ticks, lesson.swing)


def goal_difficulty(lesson: Lesson) -> float:
    """The number by which lessons are put in order: how hard it is at the tempo to reach, 0–100 with one decimal."""
    return round(difficulty(lesson, lesson.target_tempo_bpm).total, 1)


def standings(
    prerequisites: Mapping[str, Sequence[str]], hardness: Mapping[str, float]
) -> dict[str, tuple[float, int]]:
    """Where each lesson stands in an order from easy to hard: its place to sort by, by name.

    A lesson stands at its own `hardness`, or at the highest of its `prerequisites`, of theirs and so on, where that is
    higher: whoever plays it can play those. Among equals prerequisites come first; unknown names do not count.
    """
    found: dict[str, tuple[float, int]] = {}

    def standing(name: str, above: frozenset[str]) -> tuple[float, int]:
        if name not in found:
            before = [p for p in prerequisites[name] if p in hardness and p not in above]
            needed = [standing(p, above | {name}) for p in before]
            hardest = max([hardness[name], *(hard for hard, _ in needed)])
            found[name] = hardest, max((steps + 1 for hard, steps in needed if hard == hardest), default=0)
        return found[name]

    for name in hardness:
        standing(name, frozenset())
    return found


def measured(score: Score, beat_ticks: int = PPQ, swing: Swing = Swing()) -> Difficulty:  # noqa: B008 - a value
    """How hard `score` is, played round and round, its beats `beat_ticks` long."""
    if not len(score):
        return Difficulty(MappingProxyType(dict.fromkeys(PARTS, 0.0)), 0.0)
    loop = _Loop.of(score, beat_ticks, swing)
    hands, feet = (Limb.RIGHT_HAND, Limb.LEFT_HAND), (Limb.RIGHT_FOOT, Limb.LEFT_FOOT)
    figures = {
        "hands": max(_busiest(loop, loop.limbs == limb) for limb in hands),
        "feet": max(_busiest(loop, loop.limbs == limb) for limb in feet),
        "limbs": len(loop.who) - 1.0,
        "independence": _independence(loop),
        "sticking": _sticking(loop),
        "rhythm": _syncopation(loop) + _mixture(loop) + _oddness(loop),
        "variety": _variety(loop),
        "dynamics": _steps(loop) / loop.length_s,
        "ornaments": _ornaments(loop),
        "movement": _moves(loop) / loop.length_s,
    }
    return Difficulty(MappingProxyType(figures), _busiest(loop, loop.limbs >= 0))


@dataclass(frozen=True, eq=False)
class _Loop:
    """A score and what the parts ask of it.

    `limbs` (n,) of its rows; `moments` the ticks at which something is struck, grace strokes apart; `states` which
    limbs strike there; `places` where in its beat each row's tick lies, in parts of `_FINEST`.
    """

    score: Score
    limbs: NDArray[np.int8]
    beat_ticks: int
    swing: Swing
    moments: tuple[int, ...]
    states: tuple[frozenset[int], ...]
    places: Mapping[int, int]

    @classmethod
    def of(cls, score: Score, beat_ticks: int, swing: Swing) -> "_Loop":
        limbs, _ = limbs_and_reasons(score, _kit())
        struck: dict[int, set[int]] = {}
        for tick, limb, grace in zip(score.notes["tick"].tolist(), limbs.tolist(), score.is_grace, strict=True):
            if not grace:
                struck.setdefault(tick, set()).add(limb)
        places = _places(score, beat_ticks, swing)
        return cls(score, limbs, beat_ticks, swing, tuple(struck), tuple(map(frozenset, struck.values())), places)

    @property
    def length_s(self) -> float:
        return self.score.length_ns / 1e9

    @property
    def beats(self) -> float:
        return self.score.end_tick / self.beat_ticks

    @cached_property
    def worth(self) -> NDArray[np.float64]:
        """What each row (n,) counts as a stroke: rebounds count `REBOUND`."""
        counts = np.where(self.score.is_grace, REBOUND, 1.0)
        diddles = _is_diddle(self.score.notes)
        for limb in self.who if diddles.any() else ():
            own = self.strokes_of(limb)
            counts[own[diddles[own]][1::2]] = REBOUND
        return counts

    @property
    def who(self) -> list[int]:
        """The limbs that play."""
        return sorted(set(self.limbs.tolist()))

    @property
    def seen(self) -> list[tuple[frozenset[int], int]]:
        """Of each moment who strikes, and its place in the beat."""
        return list(zip(self.states, map(self.place, self.moments), strict=True))

    @property
    def voices(self) -> list[NDArray[np.bool_]]:
        """The rows (n,) of each line that is heard as one."""
        piece = self.score.notes["piece"]
        named = [np.isin(piece, sorted(voice)) for voice in _VOICES]
        accents = named[_DRUMS] & (self.score.notes["dynamic"] == Dynamic.ACCENT)
        apart = [accents] if (accents != named[_DRUMS]).any() else []  # where all are accents they are no other line
        return [*named, ~np.logical_or.reduce(named), *apart]

    def place(self, tick: int) -> int:
        """Where in its beat a tick at which something is struck lies."""
        return self.places[tick]

    def strokes_of(self, limb: int) -> NDArray[np.int64]:
        """Rows of a limb in the order of time, grace strokes left out."""
        rows = np.flatnonzero((self.limbs == limb) & ~self.score.is_grace)
        return rows[np.argsort(self.score.onset_ns[rows], kind="stable")]


def _places(score: Score, beat_ticks: int, swing: Swing) -> dict[int, int]:
    """Where in its beat each tick lies, a swung offbeat as it is written; beats count from their bar's start."""
    ticks, first_rows = np.unique(score.notes["tick"], return_index=True)
    bars = score.bar[first_rows]
    starts = {bar: score.tempo_map.bar_start(bar) for bar in set(bars.tolist())}
    found: dict[int, int] = {}
    for tick, bar in zip(ticks.tolist(), bars.tolist(), strict=True):
        inside = tick - starts[bar]
        offbeat = inside // (2 * swing.unit_ticks) * 2 * swing.unit_ticks + swing.unit_ticks
        is_swung = inside == swing.swung(offbeat, score.tempo_map.meter_at(starts[bar]))
        written = offbeat if is_swung else inside
        found[tick] = round(written % beat_ticks * _FINEST / beat_ticks) % _FINEST
    return found


@cache
def _kit() -> Kit:
    """The kit on which lessons are measured: the usual one."""
    return load_kit()


def _busiest(loop: _Loop, rows: NDArray[np.bool_]) -> float:
    """Strokes a second of these rows in the busiest `BUSY_S`, as the loop goes round; rebounds count `REBOUND`."""
    if not rows.any():
        return 0.0
    times, counts = loop.score.onset_s[rows], loop.worth[rows]
    rounds = int(np.ceil(BUSY_S / loop.length_s)) + 1
    at = np.concatenate([times + i * loop.length_s for i in range(rounds)])
    order = np.argsort(at, kind="stable")
    at, total = at[order], np.concatenate(([0.0], np.cumsum(np.tile(counts, rounds)[order])))
    until = np.searchsorted(at, at + BUSY_S - 1e-6)
    return float((total[until] - total[:-1]).max() / BUSY_S)


def _surprise(pairs: Sequence[tuple[Hashable, Hashable]]) -> float:
    """Bits of the second of each pair that the first does not tell (conditional entropy; Shannon 1948)."""
    both, first = Counter(pairs), Counter(a for a, _ in pairs)
    return sum(n * float(np.log2(first[a] / n)) for (a, _), n in both.items()) / max(1, len(pairs))


def _sticking(loop: _Loop) -> float:
    """Bits a moment of hands that strike alone after a hand that struck alone; kicks between them count as a hand."""
    turns = [(a, b) for a, b in pairwise([*loop.states, loop.states[0]]) if len(a) == 1 == len(b)]
    return _surprise(turns) * len(turns) / len(loop.states)


def _independence(loop: _Loop) -> float:
    """Bits a moment: whether each limb strikes, where the others' strokes and the place in the beat are known."""
    total = 0.0
    for weight, which in ((ON_THE_BEAT, (0,)), (HALFWAY, _HALVES), (BETWEEN, None)):
        seen = [(s, p) for s, p in loop.seen if (p in which if which else p not in (0, *_HALVES))]
        pairs = [[((s - {limb}, place), limb in s) for s, place in seen] for limb in loop.who]
        total += weight * sum(_surprise(one) * len(one) for one in pairs)
    return total / len(loop.moments)


def _syncopation(loop: _Loop) -> float:
    """Strokes a beat that stand off it while their voice leaves out the beat that follows, of all voices together.

    So Longuet-Higgins and Lee (1984) find syncopation, here at the level of the beat alone: backbeats are none.
    """
    found = 0
    for voice in loop.voices:
        ticks = np.unique(loop.score.notes["tick"][voice & ~loop.score.is_grace])
        after = np.append(ticks[1:], ticks[:1] + loop.score.end_tick)
        places = np.array([loop.place(tick) for tick in ticks.tolist()], np.int64) * loop.beat_ticks // _FINEST
        found += int(np.sum((places > 0) & (after - ticks > loop.beat_ticks - places)))
    return found / loop.beats


def _mixture(loop: _Loop) -> float:
    """What the divisions of the beat are worth, and half for each change between them that there is to know."""
    divisions = {_FINEST // int(np.gcd(place, _FINEST)) for _, place in loop.seen if place}
    last = len(DIVISIONS) - 1
    kinds = {next((i for i, (of, _) in enumerate(DIVISIONS) if d in of), last) for d in divisions}
    swings = 0.0 if loop.swing.ratio == STRAIGHT else SWINGS
    return sum(DIVISIONS[kind][1] for kind in kinds) + max(0, len(kinds) - 1) / 2 + swings


def _oddness(loop: _Loop) -> float:
    """Half for beats that are neither twos nor threes, and half for each other meter there is to know (our choice)."""
    meters = {(m.beats, m.unit) for m in loop.score.tempo_map.meters}
    odd = any(beats > 4 and beats % 2 and beats % 3 for beats, _ in meters)
    return (odd + len(meters) - 1) / 2


def _variety(loop: _Loop) -> float:
    """How many beats there are that differ in who strikes what where, as a power of two, each by its frequency."""
    rows = loop.score.notes[["tick", "piece", "dynamic"]].tolist()
    beats: dict[int, set[Hashable]] = {}
    for (tick, *struck), limb in zip(rows, loop.limbs.tolist(), strict=True):
        beats.setdefault(tick // loop.beat_ticks, set()).add((loop.place(tick), limb, *struck))
    return _surprise([(None, frozenset(beat)) for beat in beats.values()])


def _steps(loop: _Loop) -> float:
    """Steps of loudness between strokes of one limb that follow each other."""
    total = 0.0
    for limb in loop.who:
        said = loop.score.notes["dynamic"][loop.strokes_of(limb)]
        steps, ghost = said[1:] != said[:-1], (said == Dynamic.GHOST)
        total += float(np.where(ghost[1:] | ghost[:-1], 1.0, ACCENT_STEP)[steps].sum())
    return total


def _moves(loop: _Loop) -> float:
    """How often a hand goes to another piece."""
    piece = loop.score.notes["piece"].astype(int)
    hands = [limb for limb in loop.who if Limb(limb).is_hand]
    return float(sum(np.count_nonzero(np.diff(piece[loop.strokes_of(limb)])) for limb in hands))


def _is_diddle(notes: NDArray[np.void]) -> NDArray[np.bool_]:
    """Which rows (n,) are one of a diddle's two strokes, in an open roll or alone."""
    doubled = np.isin(notes["ornament"], (Ornament.DIDDLE, Ornament.ROLL))
    return np.asarray(doubled & (notes["articulation"] != Articulation.BUZZ))


def _ornaments(loop: _Loop) -> float:
    """What the ornaments are worth, each kind for itself; a diddle's two rows are one, an open roll is diddles."""
    notes = loop.score.notes[~loop.score.is_grace]
    diddles = _is_diddle(notes)
    kinds = Counter(notes["ornament"][~diddles].tolist())
    kinds[Ornament.DIDDLE] = int(diddles.sum()) // 2
    rates = {kind: kinds[kind] / loop.length_s for kind in ORNAMENTS}
    return sum(ORNAMENTS[kind] * (1 + min(1.0, a_s / ORNAMENTS_A_SECOND)) / 2 for kind, a_s in rates.items() if a_s)
