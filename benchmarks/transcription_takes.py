"""How many lessons come back from a take of them, and how fine the Groove MIDI Dataset is cut.

    .venv/bin/python benchmarks/transcription_takes.py [--passes 4] [--seeds 1] [--every 1] [--only WORD] [--gmd FOLDER]

End to end: the bytes of a MIDI file (`played_takes`) go through `read_part` and `transcribe`, and the lesson that comes
out is held against the one that was played. Of shipped lessons those count whose strokes lie 75 ms apart or more, a
flam, a drag or a buzz each as one stroke. Same means: every tick and piece, every meter, and the swing by ratio and
unit; of takes with mistakes, which cannot come back the same, the share counts of the strokes that were played and
stand where they were written. Flams, drags and buzzes, diddles, and dynamics have columns of their own, by strokes.
"""

import argparse
import tempfile
import time
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from zlib import crc32

import numpy as np

from benchmarks.played_takes import Playing, take_of
from station.core.errors import BadInput
from station.core.pieces import Articulation, Ornament
from station.core.units import NS_PER_MS, PPQ
from station.drills.lesson import Lesson
from station.drills.reading.lesson_file import parse_lesson
from station.drills.transcription.strokes.ornament_finder import found_ornaments
from station.drills.transcription.timing.grid_times import quantised_times
from station.drills.transcription.transcribe import transcribe
from station.music.formats.format_table import read_part
from station.music.score import Score

LESSONS = Path(__file__).resolve().parents[1] / "lessons"
MIN_GAP_MS = 75
FINEST_TICKS = PPQ // 8
"""A thirty-second."""

CONDITIONS: Mapping[str, Playing] = {
    "SD 12 ms": Playing(),
    "and 20 ms late": Playing(lean_ms=20),
    "and 20 ms early": Playing(lean_ms=-20),
    "and 12 ms of 1/f": Playing(wander_ms=12),
    "and 1 % too slow": Playing(slow=1.01),
    "and 1 % too fast": Playing(slow=0.99),
    "and 5 % missing": Playing(missing=0.05),
    "and 5 % extra": Playing(extra=0.05),
}
_GRACED = (Ornament.FLAM, Ornament.DRAG)
_DOUBLED = (Ornament.DIDDLE, Ornament.ROLL)

Place = tuple[int, int]
"""Tick and piece of a main stroke."""


@dataclass(frozen=True, eq=False)
class Outcome:
    """What came back: whether all of it, a line on what did not, and counts of strokes by what was asked."""

    is_same: bool
    fault: str = ""
    right: Counter[str] = field(default_factory=Counter)
    asked: Counter[str] = field(default_factory=Counter)


def apart(every: int) -> Iterator[tuple[str, Lesson]]:
    """Every so manieth shipped lesson whose main strokes lie far enough apart, with its folder's name."""
    found: list[tuple[str, Lesson]] = []
    for path in sorted(LESSONS.rglob("*.toml")):
        lesson = parse_lesson(path.read_text(encoding="utf-8"), path.stem, path.stem).lesson
        if lesson is None:
            continue
        times = np.unique(lesson.score.onset_ns[~lesson.score.is_grace])
        if len(times) > 1 and np.diff(times).min() >= MIN_GAP_MS * NS_PER_MS:
            found.append((path.parent.name, lesson))
    yield from found[::every]


def come_back(lesson: Lesson, passes: int, playing: Playing, seed: int) -> Outcome:
    """A take of so many passes of the lesson, written to a file, imported, and held against the lesson."""
    written = lesson.score.repeated(passes)
    take = take_of(written, playing, np.random.default_rng([seed, crc32(lesson.name.encode())]))
    with tempfile.NamedTemporaryFile(suffix=".mid") as file:
        file.write(take.data)
        file.flush()
        try:
            found = transcribe(read_part(Path(file.name)), "take").lesson
        except BadInput as refused:
            return Outcome(False, str(refused))
    names, read = _names(written), _names(found.score)
    right, asked = Counter[str](), Counter[str]()
    for place, is_played in zip(_places(written), take.played, strict=True):
        for question, answer in names[place].items() if is_played else ():
            asked[question] += 1
            right[question] += read.get(place, {}).get(question) == answer
    faults = list(_faults(lesson, written, found))
    return Outcome(not faults, ", ".join(faults), right, asked)


def _faults(lesson: Lesson, written: Score, found: Lesson) -> Iterator[str]:
    """What is not as it was written, in words."""
    if strokes := set(_places(written)) ^ set(_places(found.score)):
        yield f"{len(strokes)} strokes"
    meters = [[(m.tick, m.beats, m.unit) for m in s.tempo_map.meters] for s in (written, found.score)]
    if meters[0] != meters[1]:
        yield f"meter {meters[1][:3]}"
    if not (found.swing == lesson.swing or found.swing.ratio == lesson.swing.ratio == 1):
        yield f"swing {found.swing.ratio:g} for {lesson.swing.ratio:g}"


def _places(score: Score) -> list[Place]:
    mains = score.notes[~score.is_grace]
    return list(zip(mains["tick"].tolist(), mains["piece"].tolist(), strict=True))


def _names(score: Score) -> dict[Place, dict[str, int]]:
    """Of each main stroke what is asked of it: that it is there, its ornament, whether it is doubled, its dynamic."""
    found: dict[Place, dict[str, int]] = {}
    for note in score:
        if note.lead_ms:
            continue
        names = {"strokes": 1, "dynamics": int(note.dynamic)}
        if note.ornament in _GRACED or note.articulation is Articulation.BUZZ:
            names["ornaments"] = int(note.ornament)
        elif note.ornament in _DOUBLED:
            names["diddles"] = 1
        found[note.tick, int(note.piece)] = names
    return found


def lessons_table(passes: int, seeds: int, every: int, only: str) -> Iterator[str]:
    """A row for each condition: how many came back the same, by kind of lesson, and then which did not."""
    lessons = list(apart(every))
    total = Counter(kind for kind, _ in lessons)
    for name, playing in CONDITIONS.items():
        if only not in name:
            continue
        same, right, asked = Counter[str](), Counter[str](), Counter[str]()
        others: list[str] = []
        for kind, lesson in lessons:
            for seed in range(seeds):
                found = come_back(lesson, passes, playing, seed)
                same[kind] += found.is_same
                right.update(found.right)
                asked.update(found.asked)
                if not found.is_same:
                    others.append(f"{lesson.name} ({found.fault})")
        kinds = ", ".join(f"{kind} {same[kind]}/{total[kind] * seeds}" for kind in total)
        share = 100 * same.total() / (total.total() * seeds)
        columns = " | ".join(f"{question} {100 * right[question] / asked[question]:.1f} %" for question in asked)
        yield f"| {name} | {share:.1f} % of {total.total() * seeds} | {columns} | {kinds} |"
        yield f"  others: {'; '.join(others) or 'none'}"


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
    words.add_argument("--only", default="")
    words.add_argument("--gmd", type=Path)
    asked = words.parse_args()
    rows = gmd_table(asked.gmd) if asked.gmd else lessons_table(asked.passes, asked.seeds, asked.every, asked.only)
    for row in rows:
        print(row, flush=True)


if __name__ == "__main__":
    main()
