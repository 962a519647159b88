"""How well the station knows where a player is: takes whose way is known, against an oracle who knows it too.

What is measured is asked as any caller would: the final alignment, the live follower, the passes of a lesson, the
score. `measure` does one take; benchmarks/journeys.py does thousands.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache, partial

import numpy as np
from numpy.typing import NDArray

from station.bench.harness.benchmark import Benchmark, Measurement
from station.bench.rigs.journeys.journey_takes import Take
from station.bench.rigs.journeys.journey_truth import Truth, alike, keys
from station.bench.rigs.journeys.journeys import CLICK_KINDS, KINDS, journey
from station.core.units import NS_PER_S
from station.music.judgement import Label
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.align import align
from station.scoring.analysis.summary import summarise
from station.scoring.following.follower import Follower
from station.scoring.following.passes import times_played
from station.scoring.matching.alignment import Alignment

OFFSETS_S = (0.0, 0.007, 1.3, 12.0)
"""Where in its file a take may lie: at once, a hair later, after a count-in, after a talk."""
_AFTER_NS = 30 * NS_PER_S
"""So long after the last hit nobody waits for anything."""


@dataclass(frozen=True, slots=True)
class Result:
    """What became of one take; None where it was not asked.

    `f1`, `oracle_f1` of the pairs; `turns` that could be heard, `turns_missed` of them, and `false_turns` that nobody
    took; `live_notes` how many notes the player came by, `live_equal` on how many of them the last live word and the
    final one agree, `live_hits` the share of hits on which they do, notes that are alike counting as one;
    `score_change` the largest change of the score among `OFFSETS_S`; `passes`, `passes_told` of a lesson, and whether
    its loop `has_seam`: no shorter figure makes it up, so that its bars fix the passes.
    """

    kind: str
    seed: int
    name: str
    clocked: bool
    oracle_f1: float
    f1: float
    turns: int
    turns_missed: int
    false_turns: int
    live_notes: int | None = None
    live_equal: int | None = None
    live_hits: float | None = None
    score_change: float | None = None
    passes: int | None = None
    passes_told: int | None = None
    has_seam: bool = False

    @property
    def loss(self) -> float:
        """How far we are below the oracle."""
        return self.oracle_f1 - self.f1


def passes_told(lesson: Score, performance: Performance) -> int:
    """How many passes of a lesson we say were played."""
    return times_played(lesson, performance)


def matched(alignment: Alignment) -> NDArray[np.int64]:
    """The note that each hit (m,) is matched with, −1 for none."""
    return np.where(alignment.hit_label == Label.MATCH, alignment.note_of_hit, -1)


@dataclass(frozen=True, eq=False)
class Live:
    """The last live words: a label a note (n,), MISS where nothing was said; a label and a note or −1 a hit (m,)."""

    note_label: NDArray[np.uint8]
    hit_label: NDArray[np.uint8]
    note_of_hit: NDArray[np.int64]


def live(take: Take) -> Live:
    """What is judged hit by hit: a word replaces all earlier ones on its note and on its hit."""
    follower, hits = Follower(take.score, clocked=take.clocked), take.performance
    label_of: dict[int, Label] = {}
    hit_of: dict[int, int] = {}
    note_of: dict[int, int] = {}
    hit_label = np.full(len(hits), Label.PENDING, np.uint8)
    words = [word for hit in hits for word in (*follower.advance(hit.at_ns), *follower.hit(hit, hit.at_ns))]
    last_ns = int(hits.hits["at_ns"][-1]) if len(hits) else 0
    for word in (*words, *follower.advance(last_ns + _AFTER_NS)):
        note, hit = word.note_index, word.hit_index
        if hit is not None:
            hit_label[hit] = word.label
            if hit in note_of:
                before = note_of.pop(hit)
                del hit_of[before], label_of[before]
        if note is not None:
            note_of.pop(hit_of.pop(note, -1), None)
            label_of[note] = word.label
            if hit is not None:
                hit_of[note], note_of[hit] = hit, note
    labels, notes = np.full(len(take.score), Label.MISS, np.uint8), np.full(len(hits), -1, np.int64)
    told = [(note, label) for note, label in label_of.items() if label is not Label.PENDING]
    labels[[note for note, _ in told]] = [label for _, label in told]
    notes[list(note_of)] = list(note_of.values())
    return Live(labels, hit_label, notes)


def equal_hits(truth: Truth, words: Live, alignment: Alignment) -> float:
    """The share of hits that live and final words label alike and give to notes that are alike."""
    classes = np.append(truth.classes, -1)
    same = (classes[words.note_of_hit] == classes[alignment.note_of_hit]) & (words.hit_label == alignment.hit_label)
    return float(same.mean())


_NEAR_NS = NS_PER_S
"""So near a turn is told in its place: a beat or two, our choice."""


def turns_told(truth: Truth, alignment: Alignment) -> tuple[int, int, int]:
    """How many turns could be heard, how many of them our segments miss, and how many of ours nobody took."""
    at_ns = truth.take.performance.hits["at_ns"]
    breaks = np.flatnonzero(np.diff(alignment.segment))
    since, until = at_ns[breaks], at_ns[breaks + 1]
    near = [(until >= t.since_ns - _NEAR_NS) & (since <= t.until_ns + _NEAR_NS) for t in truth.turns]
    heard = [bool(n.any()) for n, turn in zip(near, truth.turns, strict=True) if turn.is_heard]
    taken = np.any(near, axis=0) if near else np.zeros(len(breaks), bool)
    return len(heard), len(heard) - sum(heard), int((~taken).sum())


def come_by(take: Take) -> NDArray[np.bool_]:
    """Which notes (n,) lie on the player's way."""
    tick = take.score.notes["tick"]
    by: NDArray[np.bool_] = np.any([(tick >= leg.first) & (tick < leg.last) for leg in take.legs], axis=0)
    return by


def score_change(take: Take) -> float:
    """The largest change of the score among the offsets at which the same take may lie in its file."""
    at_zero = take.performance.shifted(-int(take.performance.hits["at_ns"][0]))
    points = [_points(take.score, at_zero.shifted(round(offset * NS_PER_S))) for offset in OFFSETS_S]
    return max(points) - min(points)


def _points(score: Score, performance: Performance) -> float:
    return summarise(score, performance, align(score, performance, clocked=False)).points or 0.0


def measure(kind: str, seed: int, clocked: bool, with_live: bool = True, offsets: bool = True) -> Result:
    """One take; `with_live` and `offsets` say whether those are asked, too."""
    take = journey(kind, seed, clocked)
    truth, alignment = Truth(take), align(take.score, take.performance, clocked=clocked)
    turns, missed, false = turns_told(truth, alignment)
    result = Result(
        kind,
        seed,
        take.name,
        clocked,
        truth.f1(truth.oracle()),
        truth.f1(matched(alignment), alignment.hit_score_ns),
        turns,
        missed,
        false,
    )
    if with_live:
        words, here = live(take), come_by(take)
        equal = int((words.note_label == alignment.note_label)[here].sum())
        hits = equal_hits(truth, words, alignment)
        result = replace(result, live_notes=int(here.sum()), live_equal=equal, live_hits=hits)
    if offsets and not clocked:
        result = replace(result, score_change=score_change(take))
    if take.passes:
        lesson = take.score.bars(0, take.score.bar_count // take.passes - 1)
        told, has_seam = (
            passes_told(lesson, take.performance),
            len(np.unique(alike(lesson))) == len(np.unique(keys(lesson))),
        )
        result = replace(result, passes=take.passes, passes_told=told, has_seam=has_seam)
    return result


# --- the rows ---------------------------------------------------------------------------------------------------------

_SEEDS = range(6)
"""Of each kind: two of each family of music, so that the rows take half a minute."""


@cache
def _results(clocked: bool) -> tuple[Result, ...]:
    kinds = CLICK_KINDS if clocked else KINDS
    return tuple(measure(kind, seed, clocked, offsets=False) for kind in kinds for seed in _SEEDS)


def _below_oracle(clocked: bool) -> Measurement:
    results = _results(clocked)
    below = np.array([result.loss for result in results])
    worst = max(results, key=lambda result: result.loss)
    told = f"median {np.median(below):.4f}, worst {worst.kind} {worst.seed}: {worst.loss:.3f}"
    return Measurement(float(np.percentile(below, 95)), None, f"{len(results)} takes, {told}")


def _live_equal(clocked: bool) -> Measurement:
    results = _results(clocked)
    notes = sum(result.live_notes or 0 for result in results)
    return Measurement(100 * sum(result.live_equal or 0 for result in results) / notes, None, f"{notes} notes")


def _passes_exact() -> Measurement:
    results = [measure("passes", seed, clocked=False, with_live=False, offsets=False) for seed in range(60)]
    wrong = [f"{r.name} {r.passes}: {r.passes_told}" for r in results if r.passes != r.passes_told]
    return Measurement(100 * (1 - len(wrong) / len(results)), None, ", ".join(wrong[:3]))


def _row(name: str, unit: str, target: float, measured: Callable[[], Measurement], group: str = "") -> Benchmark:
    return Benchmark(name, unit, target, "lower" if unit == "F1" else "higher", None, measured, group=group)


BENCHMARKS = (
    _row("journeys_f1_below_oracle_p95", "F1", 0.03, partial(_below_oracle, False), "journeys"),
    _row("journeys_live_equals_final", "%", 98.0, partial(_live_equal, False), "journeys"),
    _row("journeys_f1_below_oracle_p95_click", "F1", 0.03, partial(_below_oracle, True), "journeys_click"),
    _row("journeys_live_equals_final_click", "%", 99.5, partial(_live_equal, True), "journeys_click"),
    _row("journeys_passes_exact", "%", 99.0, _passes_exact),
)
