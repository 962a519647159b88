"""How well the station knows where a player is: takes whose way is known, against an oracle who knows it too.

What is measured is asked as any caller would: the final alignment, the live follower, the passes of a lesson, the
score. `measure` does one take; benchmarks/journeys.py does thousands.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.bench.harness.benchmark import Benchmark, Measurement
from station.bench.rigs.journey_truth import Truth
from station.bench.rigs.journeys import CLICK_KINDS, KINDS, Take, journey
from station.core.units import NS_PER_S
from station.music.judgement import Label
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.align import align
from station.scoring.analysis.summary import summarise
from station.scoring.following.follower import Follower
from station.scoring.following.loops import times_played
from station.scoring.matching.alignment import Alignment

OFFSETS_S = (0.0, 0.007, 1.3, 12.0)
"""Where in its file a take may lie: at once, a hair later, after a count-in, after a talk."""
_AFTER_NS = 30 * NS_PER_S
"""So long after the last hit nobody waits for anything."""


@dataclass(frozen=True, slots=True)
class Result:
    """What became of one take; None where it was not asked.

    `f1`, `oracle_f1` of the pairs; `legs`, `stretches` how often the player set out, and how often we say so;
    `live_notes` how many notes the player came by, `live_equal` on how many of them the last live word and the final
    one agree; `score_change` the largest change of the score among `OFFSETS_S`; `passes`, `passes_told` of a lesson.
    """

    kind: str
    seed: int
    name: str
    clocked: bool
    oracle_f1: float
    f1: float
    legs: int
    stretches: int
    live_notes: int | None = None
    live_equal: int | None = None
    score_change: float | None = None
    passes: int | None = None
    passes_told: int | None = None

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


def live_labels(take: Take) -> NDArray[np.uint8]:
    """The last word on each note (n,) of who judges hit by hit; MISS where nothing was said."""
    follower = Follower(take.score, clocked=take.clocked)
    label_of: dict[int, Label] = {}
    hit_of: dict[int, int] = {}
    note_of: dict[int, int] = {}
    hits = take.performance
    words = [v for hit in hits for v in (*follower.advance(hit.at_ns), *follower.hit(hit, hit.at_ns))]
    last_ns = int(hits.hits["at_ns"][-1]) if len(hits) else 0
    for verdict in (*words, *follower.advance(last_ns + _AFTER_NS)):
        note, hit = verdict.note_index, verdict.hit_index
        if hit is not None and hit in note_of:
            before = note_of.pop(hit)
            hit_of.pop(before, None)
            label_of.pop(before, None)
        if note is not None:
            note_of.pop(hit_of.pop(note, -1), None)
            label_of[note] = verdict.label
            if hit is not None:
                hit_of[note], note_of[hit] = hit, note
    labels = np.full(len(take.score), Label.MISS, np.uint8)
    told = [(note, label) for note, label in label_of.items() if label is not Label.PENDING]
    labels[[note for note, _ in told]] = [label for _, label in told]
    return labels


def come_by(take: Take) -> NDArray[np.bool_]:
    """Which notes (n,) lie on the player's way."""
    tick = take.score.notes["tick"]
    return np.any([(tick >= leg.first) & (tick < leg.last) for leg in take.legs], axis=0)


def score_change(take: Take) -> float:
    """The largest change of the score among the offsets at which the same take may lie in its file."""
    at_zero = take.performance.shifted(-int(take.performance.hits["at_ns"][0]))
    points = [_points(take.score, at_zero.shifted(round(offset * NS_PER_S))) for offset in OFFSETS_S]
    return max(points) - min(points)


def _points(score: Score, performance: Performance) -> float:
    return summarise(score, performance, align(score, performance, clocked=False)).points or 0.0


def measure(kind: str, seed: int, clocked: bool, live: bool = True, offsets: bool = True) -> Result:
    """One take; `live` and `offsets` say whether those are asked, too."""
    take = journey(kind, seed, clocked)
    truth = Truth(take)
    alignment = align(take.score, take.performance, clocked=clocked)
    here = come_by(take)
    equal = (live_labels(take) == alignment.note_label)[here].sum() if live else None
    lesson = take.score.bars(0, take.score.bar_count // take.passes - 1) if take.passes else None
    return Result(
        kind=kind,
        seed=seed,
        name=take.name,
        clocked=clocked,
        oracle_f1=truth.f1(truth.oracle()),
        f1=truth.f1(matched(alignment)),
        legs=len(take.legs),
        stretches=len(np.unique(alignment.stretch)),
        live_notes=int(here.sum()) if live else None,
        live_equal=None if equal is None else int(equal),
        score_change=score_change(take) if offsets and not clocked else None,
        passes=take.passes or None,
        passes_told=None if lesson is None else passes_told(lesson, take.performance),
    )


# --- the rows ---------------------------------------------------------------------------------------------------------

_SEEDS = range(3)
"""Of each kind: one of each family of music, so that the rows take seconds."""


def _worst_share(kinds: tuple[str, ...], clocked: bool) -> Callable[[], Measurement]:
    def run() -> Measurement:
        results = [measure(kind, seed, clocked, live=False, offsets=False) for kind in kinds for seed in _SEEDS]
        below = np.array([result.loss for result in results])
        worst = max(results, key=lambda result: result.loss)
        return Measurement(
            float(np.percentile(below, 95)),
            None,
            f"{len(results)} takes, median {np.median(below):.4f}, worst {worst.kind} {worst.seed}: {worst.loss:.3f}",
        )

    return run


def _live_equal(kinds: tuple[str, ...], clocked: bool) -> Callable[[], Measurement]:
    def run() -> Measurement:
        results = [measure(kind, seed, clocked, offsets=False) for kind in kinds for seed in _SEEDS]
        notes = sum(result.live_notes or 0 for result in results)
        return Measurement(100 * sum(result.live_equal or 0 for result in results) / notes, None, f"{notes} notes")

    return run


def _passes_exact() -> Measurement:
    results = [measure("passes", seed, clocked=False, live=False, offsets=False) for seed in range(60)]
    wrong = [f"{r.name} {r.passes}: {r.passes_told}" for r in results if r.passes != r.passes_told]
    return Measurement(100 * (1 - len(wrong) / len(results)), None, ", ".join(wrong[:3]))


BENCHMARKS = (
    Benchmark("journeys_f1_below_oracle_p95", "F1", 0.03, "lower", None, _worst_share(KINDS, False)),
    Benchmark("journeys_f1_below_oracle_p95_click", "F1", 0.03, "lower", None, _worst_share(CLICK_KINDS, True)),
    Benchmark("journeys_live_equals_final", "%", 98.0, "higher", None, _live_equal(KINDS, False)),
    Benchmark("journeys_live_equals_final_click", "%", 99.5, "higher", None, _live_equal(CLICK_KINDS, True)),
    Benchmark("journeys_passes_exact", "%", 99.0, "higher", None, _passes_exact),
)
