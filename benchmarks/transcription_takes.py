"""How many lessons come back from a take of them, and how fine the Groove MIDI Dataset is cut.

    .venv/bin/python benchmarks/transcription_takes.py [--passes 4] [--seeds 1] [--every 1] [--gmd FOLDER]

Takes are made here and not by the station's own student: every moment of the lesson is played so many ms beside its
time (Gaussian), with a lean, a wrong tempo, or errors that wander as 1/f noise as human tapping does (Gilden, Thornton
& Mallon 1995; Hennig et al. 2011). Of shipped lessons those count whose strokes lie 75 ms apart or more. Same means:
every tick and piece, every meter, and the swing by ratio and unit.
"""

import argparse
import time
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_MS, NS_PER_S, PPQ
from station.drills.lesson import Lesson
from station.drills.reading.lesson_file import parse_lesson
from station.drills.transcription.strokes.ornament_finder import found_ornaments
from station.drills.transcription.timing.grid_times import GridTimes, quantised_times
from station.music.formats.format_table import read_part
from station.music.score import Score

LESSONS = Path(__file__).resolve().parents[1] / "lessons"
MIN_GAP_MS = 75
FINEST_TICKS = PPQ // 8
"""A thirty-second."""


@dataclass(frozen=True, slots=True)
class Playing:
    """How a take is played: Gaussian spread, constant lean and 1/f wander in ms, and by how much too slow."""

    spread_ms: float = 12.0
    lean_ms: float = 0.0
    slow: float = 1.0
    wander_ms: float = 0.0


CONDITIONS: Mapping[str, Playing] = {
    "SD 12 ms": Playing(),
    "and 20 ms late": Playing(lean_ms=20),
    "and 20 ms early": Playing(lean_ms=-20),
    "and 12 ms of 1/f": Playing(wander_ms=12),
    "and 1 % too slow": Playing(slow=1.01),
    "and 1 % too fast": Playing(slow=0.99),
}


def apart(every: int) -> Iterator[tuple[str, Lesson]]:
    """Every so manieth shipped lesson whose strokes lie far enough apart, with its folder's name."""
    found: list[tuple[str, Lesson]] = []
    for path in sorted(LESSONS.rglob("*.toml")):
        lesson = parse_lesson(path.read_text(encoding="utf-8"), path.stem, path.stem).lesson
        if lesson is None:
            continue
        times = np.unique(lesson.score.onset_ns)
        if len(times) > 1 and np.diff(times).min() >= MIN_GAP_MS * NS_PER_MS:
            found.append((path.parent.name, lesson))
    yield from found[::every]


def wander(count: int, rng: np.random.Generator) -> NDArray[np.float64]:
    """1/f noise of standard deviation 1, by its spectrum."""
    frequencies = np.fft.rfftfreq(count)[1:]
    phases = rng.uniform(0, 2 * np.pi, len(frequencies))
    noise: NDArray[np.float64] = np.fft.irfft(np.concatenate([[0], np.exp(1j * phases) / np.sqrt(frequencies)]), count)
    noise /= noise.std()
    return noise


def take(score: Score, playing: Playing, rng: np.random.Generator) -> Score:
    """The score as it is played; all strokes of one piece at one tick go together, a flam with its grace stroke."""
    rows = score.notes.copy()
    moments, of_row = np.unique(np.stack([rows["tick"], rows["piece"]]), axis=1, return_inverse=True)
    spread: NDArray[np.float64] = rng.normal(0, playing.spread_ms, (moments.shape[1],))
    errors = spread[of_row.ravel()] + playing.lean_ms
    if playing.wander_ms:
        errors += playing.wander_ms * wander(len(rows), rng)
    times_s = score.tempo_map.ns_at(rows["tick"]) / NS_PER_S * playing.slow + errors / 1000
    rows["tick"] = score.tempo_map.ticks_at(np.maximum(times_s, 0))
    rows["swing_ticks"] = 0
    return Score.from_array(rows, score.tempo_map)


def is_same(lesson: Lesson, written: Score, found: GridTimes) -> bool:
    """Whether the take came back as it was written."""
    strokes = [
        sorted(zip(s.notes["tick"].tolist(), s.notes["piece"].tolist(), strict=True)) for s in (written, found.score)
    ]
    meters = [[str(m) for m in s.tempo_map.meters] for s in (written, found.score)]
    swings = found.swing == lesson.swing or found.swing.ratio == lesson.swing.ratio == 1
    return strokes[0] == strokes[1] and meters[0] == meters[1] and swings


def lessons_table(passes: int, seeds: int, every: int) -> Iterator[str]:
    """A row for each condition: how many came back the same, by kind of lesson, and then which did not."""
    lessons = list(apart(every))
    for name, playing in CONDITIONS.items():
        same: Counter[str] = Counter()
        others: list[str] = []
        for kind, lesson in lessons:
            written = lesson.score.repeated(passes)
            for seed in range(seeds):
                rng = np.random.default_rng([seed, len(written)])
                if is_same(lesson, written, quantised_times(take(written, playing, rng), is_played=True)):
                    same[kind] += 1
                else:
                    others.append(lesson.name)
        total = Counter(kind for kind, _ in lessons)
        kinds = ", ".join(f"{kind} {same[kind]}/{total[kind] * seeds}" for kind in total)
        share = 100 * same.total() / (total.total() * seeds)
        yield f"| {name} | {share:.1f} % of {total.total() * seeds} | {kinds} |"
        yield f"  others: {', '.join(others) or 'none'}"


def gmd_table(folder: Path) -> Iterator[str]:
    """For each file what it was read as, and last the share of bars that are cut finer than a thirty-second."""
    bars = finer = 0
    for path in sorted(folder.rglob("*.mid")):
        score = read_part(path).score
        mains = Score.from_notes(found_ornaments(score, None).mains, score.tempo_map, score.end_tick)
        began = time.process_time()
        found = quantised_times(mains, is_played=False)
        spent = time.process_time() - began
        fine = {int(score.tempo_map.bars_at(b.tick)) for b in found.beats if b.length_ticks < FINEST_TICKS * b.cells}
        bars, finer = bars + found.score.bar_count, finer + len(fine)
        cells = dict(sorted(Counter(b.cells for b in found.beats).items()))
        feel = f"lean {found.lean_ms:.0f} ms, SD {found.spread_ms:.0f} ms, swing {found.swing.ratio:g}"
        yield f"{path.stem}: {feel}, cells a beat {cells}, {len(fine)} bars finer, {spent:.1f} s"
    yield f"{finer} of {bars} bars cut finer than a thirty-second: {100 * finer / max(bars, 1):.1f} %"


def main() -> None:
    """Print one table or the other."""
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--passes", type=int, default=4)
    words.add_argument("--seeds", type=int, default=1)
    words.add_argument("--every", type=int, default=1)
    words.add_argument("--gmd", type=Path)
    asked = words.parse_args()
    rows = gmd_table(asked.gmd) if asked.gmd else lessons_table(asked.passes, asked.seeds, asked.every)
    for row in rows:
        print(row, flush=True)


if __name__ == "__main__":
    main()
