"""The battling drummer's model on drummers that it has not heard: bits, speed, size, and whether an ear can tell.

    OMP_NUM_THREADS=1 PYTHONPATH=. python benchmarks/battle_model.py [--data ../shared/data/gmd] [--out PAGE.md]

Of the drummers with at least eight takes one at a time is left out of all training, the mixing's and the tables' too.
`--part bits`, `times` or `experts` makes one part alone. With `--out` the tables between the marks of that page are
replaced. About ten minutes on one core.
"""

import argparse
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from benchmarks.battle_baselines import ChordNgrams, position_bits
from benchmarks.battle_experts.experts_test import experts_tables
from station.practice.battle.improvising.beat_model import MODEL_FILE, BeatModel
from station.practice.battle.improvising.continuation import continued
from station.practice.battle.improvising.wanted import Wanted
from tools.battle_training.fit_model import fitted_model
from tools.battle_training.takes import GrooveTake, groove_takes, on_sixteenths

Floats = NDArray[np.float64]
DRUMMERS = ("drummer1", "drummer5", "drummer7", "drummer8")
"""Those of whom there are at least eight takes."""
SEED = 14
NGRAMS = (1, 2, 3, 4)
_ISSUE = {"position alone": "3.9", "n-grams": "3.6", "network": "2.0", "network and memory": "1.7"}
"""What a trial gave before (issue 19)."""


@dataclass(frozen=True, eq=False)
class Scored:
    """How many bits a take cost under a way of reckoning: by step or by beat (n,)."""

    way: str
    take: GrooveTake
    bits: Floats


def folds(takes: Sequence[GrooveTake]) -> Iterator[tuple[list[GrooveTake], list[GrooveTake]]]:
    """Training and test takes, a drummer left out at a time."""
    for drummer in DRUMMERS:
        yield [t for t in takes if t.drummer != drummer], [t for t in takes if t.drummer == drummer]


def bits_tables(takes: Sequence[GrooveTake]) -> str:
    """Bits a step on sixteenths, and bits a beat over beats with their own division."""
    fours = [on_sixteenths(take) for take in takes if take.is_straight_four]
    steps = [scored for train, test in folds(fours) for scored in _step_bits(train, test)]
    beats = [scored for train, test in folds(takes) for scored in _beat_bits(train, test)]
    return "\n".join([*_steps_table(steps), "", *_beats_table(beats)])


def _step_bits(train: Sequence[GrooveTake], test: Sequence[GrooveTake]) -> Iterator[Scored]:
    model = fitted_model(train, SEED)
    ngrams = {order: ChordNgrams(train, order) for order in NGRAMS}
    for take in test:
        yield Scored("position alone", take, position_bits(train, take))
        for order, chords in ngrams.items():
            yield Scored(f"{order}-grams", take, chords.bits(take))
        yield Scored("network", take, model.surprise(take.beats, take.music, 0.0).step)
        yield Scored("network and memory", take, model.surprise(take.beats, take.music).step)


def _beat_bits(train: Sequence[GrooveTake], test: Sequence[GrooveTake]) -> Iterator[Scored]:
    model = fitted_model(train, SEED)
    for take in test:
        for way, memory in (("network", 0.0), ("network and memory", 1.0)):
            surprise = model.surprise(take.beats, take.music, memory)
            yield Scored(way, take, surprise.of_beat)
            yield Scored(f"{way}: division", take, surprise.division)


def _mean(scored: Sequence[Scored], way: str, keep: Callable[[GrooveTake], bool]) -> str:
    bits = [s.bits for s in scored if s.way == way and keep(s.take)]
    return f"{np.concatenate(bits).mean():.2f}" if bits else "–"


def _steps_table(scored: Sequence[Scored]) -> Iterator[str]:
    """Bits a step, with the issue's figures beside ours."""
    best = min((f"{n}-grams" for n in NGRAMS), key=lambda way: float(_mean(scored, way, lambda _: True)))
    takes = {s.take.file for s in scored}
    yield f"Bits a step of sixteenths, nine instruments, straight takes in 4/4 ({len(takes)} takes of four drummers):"
    yield ""
    yield "| | trial before | all takes | without the shared grooves | " + " | ".join(DRUMMERS) + " |"
    yield "|---|---|---|---|" + "---|" * len(DRUMMERS)
    for row, way in zip(_ISSUE, ("position alone", best, "network", "network and memory"), strict=True):
        by_drummer = [_mean(scored, way, lambda t, d=d: t.drummer == d) for d in DRUMMERS]
        said = f"{row} (best: {way})" if row != way else row
        cells = [said, _ISSUE[row], _mean(scored, way, lambda _: True), _mean(scored, way, lambda t: not t.is_shared)]
        yield "| " + " | ".join([*cells, *by_drummer]) + " |"


def _beats_table(scored: Sequence[Scored]) -> Iterator[str]:
    """Bits a beat, division and strokes together, straight and triplet takes apart."""
    yield "Bits a beat, each with its own division (in brackets the division's share of them):"
    yield ""
    yield "| | straight takes | without the shared grooves | triplet takes | beats straight/triplet |"
    yield "|---|---|---|---|---|"
    kinds = (lambda t: not t.is_triplet, lambda t: not t.is_triplet and not t.is_shared, lambda t: t.is_triplet)
    counts = [sum(len(s.bits) for s in scored if s.way == "network" and kind(s.take)) for kind in kinds]
    for way in ("network", "network and memory"):
        cells = [f"{_mean(scored, way, k)} ({_mean(scored, f'{way}: division', k)})" for k in kinds]
        yield f"| {way} | " + " | ".join(cells) + f" | {counts[0]}/{counts[2]} |"


def times_table(takes: Sequence[GrooveTake]) -> str:
    """Milliseconds a bar and megabytes of the model that ships."""
    model = BeatModel.load()
    take = max((t for t in takes if t.is_straight_four), key=lambda t: t.beats.bars)
    eight = take.beats.of_bars(0, 8)
    rng = np.random.default_rng(SEED)
    rows = (
        ("scored by the network", 8, lambda: model.surprise(eight, take.music, 0.0)),
        ("scored with the memory", 8, lambda: model.surprise(eight, take.music)),
        ("played after eight bars", 4, lambda: continued(model, [eight], 4, Wanted(take.music), rng)),
    )
    lines = [
        f"{model.network.weights} weights, {MODEL_FILE.stat().st_size / 1e6:.3f} MB.",
        "",
        "| | ms a bar |",
        "|---|---|",
    ]
    return "\n".join([*lines, *(f"| {said} | {_fastest_ms(work) / bars:.2f} |" for said, bars, work in rows)])


def _fastest_ms(work: Callable[[], object]) -> float:
    found = []
    for _ in range(5):
        begun = time.perf_counter()
        work()
        found.append(1000 * (time.perf_counter() - begun))
    return min(found)


def experts(takes: Sequence[GrooveTake]) -> str:
    """The experts' test by proxy."""
    models = {drummer: fitted_model(train, SEED) for drummer, (train, _) in zip(DRUMMERS, folds(takes), strict=True)}
    return experts_tables(takes, models)


PARTS: dict[str, Callable[[Sequence[GrooveTake]], str]] = {
    "bits": bits_tables,
    "times": times_table,
    "experts": experts,
}


def main() -> None:
    """Print the tables, and put them into the page where asked."""
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--data", type=Path, default=Path("../shared/data/gmd"))
    words.add_argument("--out", type=Path)
    words.add_argument("--part", choices=PARTS, action="append")
    asked = words.parse_args()
    if not (asked.data / "info.csv").exists():
        words.error(f"{asked.data}: no info.csv of the Groove MIDI Dataset in it")
    takes = groove_takes(asked.data)
    for part in asked.part or PARTS:
        table = PARTS[part](takes)
        print(table, "\n", flush=True)
        if asked.out:
            _put(asked.out, part, table)


def _put(page: Path, part: str, table: str) -> None:
    """Put the table between the marks of its part."""
    begin, end = f"<!-- {part} -->", f"<!-- end of {part} -->"
    written = page.read_text(encoding="utf-8")
    head, rest = written.split(begin)
    _, tail = rest.split(end)
    page.write_text(f"{head}{begin}\n{table}\n{end}{tail}", encoding="utf-8")


if __name__ == "__main__":
    main()
