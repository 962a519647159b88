"""Lags that equipment adds, and people who are late by themselves: found, told apart, and what they score.

    .venv/bin/python benchmarks/device_lags.py [--takes 40] [--gmd tests/data/gmd] [--table now|causes|gmd]

The players are made here, of numbers from HUMANS and from nothing under test: the whole wanders (half white, half 1/f
noise), each stroke has its own scatter, each limb its own lean; beside a click they stand 10 to 30 ms early. Beginners
scatter by 35 to 50 ms. Equipment is late by so many ms, with a jitter of 3. Habits are late by a share of the beat, or
with one foot. The drummers of the Groove MIDI Dataset stand beside their click as they do.
"""

import argparse
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.core.units import NS_PER_MS, NS_PER_S, PPQ
from station.drills.library import find_lesson
from station.music.formats.smf.standard_midi import performance_from_midi, read_midi
from station.music.performance import HIT_DTYPE, Performance
from station.music.score import NOTE_DTYPE, Score
from station.music.tempo import TempoMap
from station.practice.session.plan import PlanOptions, plan_practice
from station.practice.session.rising_tempo import Rise
from station.scoring.align import align
from station.scoring.analysis.device_lag import LagCause, LagRun, SharedLag, lag_runs, likely_lag_ms, shared_lag
from station.scoring.analysis.summary import Summary, summarise
from station.scoring.report.advice import advise

Floats = NDArray[np.float64]
LAGS_MS = (-40.0, 0.0, 25.0, 50.0, 75.0, 100.0, 125.0, 150.0)
LEAST_S = 15.0
TEMPI_BPM = (60.0, 90.0, 120.0, 150.0, 180.0)
LESSONS = ("first-groove", "rock-1", "funk-sixteenths-1")


@dataclass(frozen=True, slots=True)
class Player:
    """SD of the whole in ms, where they stand beside a click, SD of the limbs' leans, share of notes left out."""

    sd_ms: float
    stand_ms: float
    lean_sd_ms: float = 8.0
    missed: float = 0.04


def beginner(rng: np.random.Generator) -> Player:
    """One of them: SD 35 to 50 ms, 10 to 30 ms early."""
    return Player(rng.uniform(35, 50), -rng.uniform(10, 30), missed=0.06)


def amateur(rng: np.random.Generator) -> Player:
    """One of them: SD 20 to 30 ms."""
    return Player(rng.uniform(20, 30), -rng.uniform(5, 20), missed=0.02)


def pink(count: int, rng: np.random.Generator) -> Floats:
    """1/f noise of unit variance, (count,)."""
    spectrum = rng.normal(size=count // 2 + 1) + 1j * rng.normal(size=count // 2 + 1)
    spectrum /= np.sqrt(np.maximum(np.arange(count // 2 + 1), 1))
    spectrum[0] = 0
    noise = np.fft.irfft(spectrum, count)
    return np.asarray(noise / noise.std())


def play(score: Score, player: Player, rng: np.random.Generator, shift_ms: Floats | float = 0.0) -> Performance:
    """A take of `score`, each note `shift_ms` later than they would be."""
    ticks, moment = np.unique(score.notes["tick"], return_inverse=True)
    count = max(len(ticks), 4) + len(ticks) % 2
    common = np.sqrt(0.3) * rng.normal(size=count) + np.sqrt(0.3) * pink(count, rng)
    off = player.sd_ms * (common[moment] + np.sqrt(0.4) * rng.normal(size=len(score)))
    leans = rng.normal(0.0, player.lean_sd_ms, 256)
    played = np.unique(score.notes["piece"])
    leans[played] -= leans[played].mean()
    at_ms = score.onset_ns / NS_PER_MS + off + leans[score.notes["piece"]] + player.stand_ms + np.asarray(shift_ms)
    at_ms = at_ms + rng.normal(0.0, 3.0, len(score))
    hits = np.zeros(len(score), HIT_DTYPE)
    for name in ("piece", "zone", "articulation", "openness", "velocity"):
        hits[name] = score.notes[name]
    hits["position"], hits["limb"] = np.nan, -1
    hits["at_ns"] = np.rint(at_ms * NS_PER_MS).astype(np.int64)
    return Performance.from_array(np.sort(hits[rng.random(len(score)) >= player.missed], order="at_ns"))


def lesson_score(name: str, tempo_bpm: float, passes: int = 4) -> Score:
    """A shipped lesson, `passes` times in a row."""
    return plan_practice(find_lesson(name), PlanOptions(tempo_bpm=tempo_bpm, loops=passes)).score


def first_minute(bars: int = 4) -> Score:
    """The first groove at its two tempi, `bars` of each."""
    return plan_practice(
        find_lesson("first-groove"), PlanOptions(tempo_bpm=60, loops=bars, rise=Rise(40, bars, 100))
    ).score


def judged(score: Score, performance: Performance, less_ms: float = 0.0) -> Summary:
    """The take, judged with `less_ms` taken out."""
    moved = performance.shifted(-round(less_ms * NS_PER_MS))
    return summarise(score, moved, align(score, moved, clocked=True))


def runs_of(score: Score, performance: Performance, take: str = "") -> tuple[LagRun, ...]:
    """What a take says of its lag."""
    likely_ms = likely_lag_ms(score, performance)
    moved = performance.shifted(-round(likely_ms * NS_PER_MS))
    return lag_runs(score, align(score, moved, clocked=True), likely_ms, take)


def now_table(takes: int) -> None:
    """What a constant lag costs: the score as it is, and with the lag that was found taken out."""
    print(
        "| lesson | bpm | lag | score as it came | advice as it came | found less true | score, lag out |\n|"
        + "---|" * 7
    )
    for lesson in LESSONS:
        for tempo in TEMPI_BPM:
            score = lesson_score(lesson, tempo)
            for lag in LAGS_MS:
                rows = [_now(score, lag, seed) for seed in range(takes)]
                points, after, off = (np.array([row[k] for row in rows]) for k in (0, 1, 2))
                said = Counter(row[3] for row in rows).most_common(1)[0]
                print(
                    f"| {lesson} | {tempo:g} | {lag:+g} | {points.mean():.0f} | {said[0]} {said[1]}/{takes}"
                    f" | {np.median(off):+.0f} ± {off.std():.0f} | {after.mean():.0f} |"
                )


def _now(score: Score, lag_ms: float, seed: int) -> tuple[float, float, float, str]:
    rng = np.random.default_rng(seed)
    player = beginner(rng)
    performance = play(score, player, rng, lag_ms)
    summary = judged(score, performance)
    lag = shared_lag(runs_of(score, performance))
    after = judged(score, performance, lag.lag_ms if lag.may_be_taken_out else 0.0)
    advice = advise(summary)
    true = lag_ms + player.stand_ms
    return summary.points or 0.0, after.points or 0.0, lag.lag_ms - true, advice[0].fault if advice else "none"


_CAUSES = " | ".join(cause.value for cause in LagCause)
KINDS: dict[str, Callable[[Score, float], Floats | float]] = {
    "equipment": lambda score, late: late,
    "share of the beat": lambda score, late: late * _beats(score) / 800.0,
    "kick alone": lambda score, late: np.where(score.notes["piece"] == Piece.KICK, late, 0.0),
    "hands alone": lambda score, late: np.where(score.notes["piece"] == Piece.KICK, 0.0, late),
}
"""Who is late, by how much: a share of the beat is so many ms at 75 a minute."""


def _beats(score: Score) -> Floats:
    tick = score.notes["tick"]
    return np.asarray((score.tempo_map.ns_at(tick + PPQ) - score.tempo_map.ns_at(tick)) / NS_PER_MS)


def causes_table(takes: int) -> None:
    """Whose a lag is said to be, in the first minute and over two sessions."""
    print(f"| what is played | who | late by | whose | {_CAUSES} | found less true | within 10 |")
    print("|" + "---|" * 11)
    plays = {
        "first groove, 4 + 4 bars": [first_minute(4)],
        "first groove, 6 + 6 bars": [first_minute(6)],
        "rock-1 at 70, then at 100": [lesson_score("rock-1", 70), lesson_score("rock-1", 100)],
        "sixteenths at 80, then at 100": [
            lesson_score("funk-sixteenths-1", 80),
            lesson_score("funk-sixteenths-1", 100),
        ],
    }
    for what, scores in plays.items():
        for who in (beginner, amateur):
            for whose, shift in KINDS.items():
                for late in (0.0, 50.0, 100.0, 150.0) if whose == "equipment" else (60.0, 120.0):
                    found = [_cause(scores, who, shift, late, seed) for seed in range(takes)]
                    print(f"| {what} | {who.__name__} | {late:g} | {whose} | {_causes(found)}", flush=True)


def _cause(
    scores: list[Score],
    who: Callable[[np.random.Generator], Player],
    shift: Callable[[Score, float], Floats | float],
    late_ms: float,
    seed: int,
) -> tuple[SharedLag, float]:
    rng = np.random.default_rng(1000 + seed)
    player = who(rng)
    takes = [runs_of(score, play(score, player, rng, shift(score, late_ms)), str(k)) for k, score in enumerate(scores)]
    lag = shared_lag(run for runs in takes for run in runs)
    return lag, late_ms + player.stand_ms


def _causes(found: list[tuple[SharedLag, float]]) -> str:
    counts = Counter(lag.cause for lag, _ in found)
    off = np.array([lag.lag_ms - true for lag, true in found])
    shares = " | ".join(f"{100 * counts[cause] / len(found):.0f} %" for cause in LagCause)
    return f"{shares} | {np.median(off):+.0f} ± {off.std():.0f} | {100 * (np.abs(off) <= 10).mean():.0f} % |"


# --- the drummers of the dataset -------------------------------------------------------------------------------------


def gmd_table(folder: Path) -> None:
    """Drummers as they are and with a lag added, two takes of different tempi each, against their own click.

    What they meant is the nearest sixteenth or triplet of the click: the score is what they played, quantised, before
    any lag is added; what a take says beyond that is the lag.
    """
    takes: dict[str, list[tuple[float, Score, Performance]]] = {}
    for path in sorted(folder.rglob("*_beat_4-4.mid")):
        performance, tempo = performance_from_midi(read_midi(path)), float(path.stem.split("_")[-3])
        if performance.hits["at_ns"].max() > LEAST_S * NS_PER_S:
            drummer = path.relative_to(folder).parts[0]
            takes.setdefault(drummer, []).append((tempo, quantised(performance, tempo), performance))
    print(
        "| drummers | pairs of takes | added | none | thin | equipment | tempo | pads | found less added | within 10 |"
    )
    print("|" + "---|" * 10)
    pairs = [(slow, fast) for own in takes.values() for slow in own for fast in own if 1.15 * slow[0] < fast[0]]
    chosen = [pairs[k] for k in np.random.default_rng(1).permutation(len(pairs))[:120]]
    bare = [[runs_of(score, take, str(bpm)) for bpm, score, take in pair] for pair in chosen]
    stand = np.array([shared_lag(run for runs in own for run in runs).lag_ms for own in bare])
    print(f"their own stand: median {np.median(stand):+.1f}, 5 to 95 %: {np.quantile(stand, [0.05, 0.95]).round(1)}")
    for added in (0.0, 50.0, 100.0, 150.0):
        found = []
        for pair in chosen:
            moved = [runs_of(score, take.shifted(round(added * NS_PER_MS)), str(bpm)) for bpm, score, take in pair]
            found.append((shared_lag(run for runs in moved for run in runs), added))
        print(f"| {len(takes)} | {len(found)} | {added:g} | {_causes(found)}", flush=True)


def quantised(performance: Performance, tempo_bpm: float) -> Score:
    """What was played on the nearest sixteenth or eighth triplet of the click, once a piece and place."""
    tempo_map = TempoMap.constant(tempo_bpm)
    hits = performance.hits
    beats = hits["at_ns"] * tempo_bpm / 60e9
    places = [np.rint(beats * grid).astype(np.int64) * (PPQ // grid) for grid in (4, 3)]
    far = [np.abs(beats - place / PPQ) for place in places]
    tick = np.where(far[0] <= far[1] + 0.02, *places)
    _, first = np.unique(np.stack([tick, hits["piece"].astype(np.int64)]), axis=1, return_index=True)
    notes = np.zeros(len(first), NOTE_DTYPE)
    for name in ("piece", "zone", "articulation", "velocity"):
        notes[name] = hits[name][first]
    notes["tick"], notes["openness"], notes["limb"] = tick[first], hits["openness"][first], -1
    return Score.from_array(notes[np.lexsort((notes["piece"], notes["tick"]))], tempo_map, int(tick.max()) + PPQ)


def main() -> None:
    """Print the tables."""
    options = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    options.add_argument("--takes", type=int, default=40)
    options.add_argument("--gmd", type=Path, default=Path(__file__).resolve().parents[1] / "tests/data/gmd")
    options.add_argument("--table", choices=("now", "causes", "gmd"), default="causes")
    said = options.parse_args()
    match said.table:
        case "now":
            now_table(said.takes)
        case "causes":
            causes_table(said.takes)
        case _:
            gmd_table(said.gmd)


if __name__ == "__main__":
    main()
