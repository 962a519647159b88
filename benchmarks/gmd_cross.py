"""Drummers against each other: the five grooves that four drummers of the Groove MIDI Dataset played to one click.

    .venv/bin/python benchmarks/gmd_cross.py [--data tests/data/gmd] [--out docs/gmd-cross.md] [--show GROOVE A B]

Each drummer's file is the score, as it was played, and each other's file the performance, aligned without a click. The
truth: a note and a hit belong together that lie on the same slot (the nearest 1/16 or 1/24 of a whole note on the
click) and piece, where either plays that piece once there. Notes and hits without such a partner are not scored. F1
counts pairs: a pair is wrong that gives a scored note or hit to somebody else. `--show` prints one pairing for reading
by hand.
"""

import argparse
import itertools
import re
import time
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece, word
from station.core.units import NS_PER_MS, NS_PER_S, PPQ
from station.music.formats.smf.standard_midi import performance_from_midi, read_midi, score_from_midi
from station.music.judgement import Label
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.align import align
from station.scoring.matching.alignment import Alignment
from station.scoring.matching.match_classes import match_classes

Indices = NDArray[np.int64]
_DATA = Path(__file__).resolve().parents[1] / "tests/data/gmd"
_CLASSES = match_classes()


@dataclass(frozen=True, eq=False)
class Take:
    """One drummer's performance of a groove, as both sides read it, and the slot in ticks of each stroke (m,)."""

    score: Score
    performance: Performance
    slots: Indices

    @property
    def places(self) -> list[tuple[int, int]]:
        """Slot and class of each stroke."""
        classes = _CLASSES[self.performance.hits["piece"]]
        return list(zip(self.slots.tolist(), classes.tolist(), strict=True))


def read(path: Path) -> Take:
    """A file of the dataset."""
    midi = read_midi(path)
    score, performance = score_from_midi(midi), performance_from_midi(midi)
    ticks = score.tempo_map.ticks_at_ns(performance.hits["at_ns"])
    nearest = [np.rint(ticks / step).astype(np.int64) * step for step in (PPQ // 4, PPQ // 6)]
    return Take(score, performance, np.where(abs(ticks - nearest[0]) <= abs(ticks - nearest[1]), *nearest))


def true_pairs(one: Take, other: Take) -> dict[int, int]:
    """Hit of `one` -> hit of `other`, where each plays a piece once on a slot."""
    counts = [Counter(take.places) for take in (one, other)]
    there = {place: hit for hit, place in enumerate(other.places)}
    return {
        hit: there[place] for hit, place in enumerate(one.places) if counts[0][place] == 1 and counts[1].get(place) == 1
    }


def note_of_each_hit(take: Take) -> dict[int, int]:
    """Hit of a take -> note of the same take read as a score: the same stroke of the file."""
    notes: dict[tuple[int, int], list[int]] = {}
    for note, (at_ns, number) in enumerate(
        zip(take.score.onset_ns.tolist(), take.score.notes["midi_note"], strict=True)
    ):
        notes.setdefault((round(at_ns / NS_PER_MS), int(number)), []).append(note)
    hits = take.performance.hits
    keys = [(round(int(hit["at_ns"]) / NS_PER_MS), int(hit["midi_note"])) for hit in hits]
    return {hit: notes[key].pop(0) for hit, key in enumerate(keys) if notes.get(key)}


def f1(alignment: Alignment, truth: dict[int, int]) -> float:
    """F1 over note -> hit; pairs of a note and a hit that nobody scored do not count."""
    scored_hits = set(truth.values())
    said = {n: h for n, h in enumerate(alignment.hit_of_note.tolist()) if alignment.note_label[n] == Label.MATCH}
    claimed = {n: h for n, h in said.items() if n in truth or h in scored_hits}
    right = sum(truth.get(n) == h for n, h in claimed.items())
    return 2 * right / (len(claimed) + len(truth)) if claimed or truth else 1.0


def compared(one: Take, other: Take) -> tuple[Alignment, dict[int, int], float]:
    """The alignment, the truth as note -> hit, and how long it took in ms (the fastest of three)."""
    own_note = note_of_each_hit(one)
    truth = {own_note[a]: b for a, b in true_pairs(one, other).items() if a in own_note}
    took = []
    for _ in range(3):
        fresh = Score(one.score.notes, one.score.tempo_map, one.score.end_tick)
        begun = time.process_time()
        alignment = align(fresh, other.performance, clocked=False)
        took.append(time.process_time() - begun)
    return alignment, truth, 1e3 * min(took)


def grooves(data: Path) -> dict[str, dict[str, Take]]:
    """Groove -> drummer -> take."""
    found: dict[str, dict[str, Take]] = {}
    for path in sorted(data.glob("drummer*/eval_session/*.mid")):
        name = re.sub(r"^(\d+_[^_]+)_.*", r"\1", path.stem)
        found.setdefault(name, {})[path.parent.parent.name] = read(path)
    return dict(sorted(found.items()))


def table(data: Path) -> str:
    """A line for each pair of drummers and groove."""
    lines = ["| groove | score | played | notes | hits | scored | F1 | mean, ms | SD, ms | time, ms |"]
    lines.append("|---|---|---|---|---|---|---|---|---|---|")
    scores = []
    for groove, takes in grooves(data).items():
        for a, b in itertools.permutations(takes, 2):
            alignment, truth, took = compared(takes[a], takes[b])
            scores.append(f1(alignment, truth))
            off = alignment.asynchrony_ns[alignment.note_label == Label.MATCH] / NS_PER_MS
            sizes = f"{len(takes[a].score)} | {len(takes[b].performance)} | {len(truth)}"
            timing = f"{off.mean():+.1f} | {off.std(ddof=1):.1f} | {took:.1f}"
            lines.append(f"| {groove} | {a[7:]} | {b[7:]} | {sizes} | {scores[-1]:.3f} | {timing} |")
    lines.append(f"\nF1: median {np.median(scores):.3f}, mean {np.mean(scores):.3f}, least {min(scores):.3f}.")
    return "\n".join(lines) + "\n"


def show(one: Take, other: Take) -> None:
    """Notes with their hits, and where the truth has another."""
    alignment, truth, _ = compared(one, other)
    for note, hit in enumerate(alignment.hit_of_note.tolist()):
        written = one.score[note]
        beat = written.tick / PPQ
        heard = "–"
        if hit >= 0:
            struck = other.performance[hit]
            heard = f"{word(Piece(struck.piece)):12} {struck.at_ns / NS_PER_S:8.3f} {other.slots[hit] / PPQ:8.3f}"
        verdict = "" if note not in truth else "ok" if truth[note] == hit else f"WRONG, truth {truth[note]}"
        label = word(Label(alignment.note_label[note]))
        print(f"{beat:8.3f} {word(written.piece):12} {label:12} {heard:32} {verdict}")


def main() -> None:
    """Print the table or one pairing, and write the table where asked."""
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--data", type=Path, default=_DATA)
    words.add_argument("--out", type=Path)
    words.add_argument("--show", nargs=3, metavar=("GROOVE", "A", "B"))
    asked = words.parse_args()
    if not any(asked.data.glob("drummer*/eval_session/*.mid")):
        words.error(f"{asked.data}: no drummer*/eval_session/*.mid in it")
    if asked.show:
        takes = next(takes for name, takes in grooves(asked.data).items() if name.startswith(asked.show[0]))
        show(takes[f"drummer{asked.show[1]}"], takes[f"drummer{asked.show[2]}"])
        return
    lines = table(asked.data)
    print(lines)
    if asked.out:
        written = asked.out.read_text(encoding="utf-8") if asked.out.exists() else ""
        by_hand = written[written.index(_BY_HAND) :] if _BY_HAND in written else f"{_BY_HAND}\n"
        asked.out.write_text(f"{_HEAD}\n{lines}\n{by_hand}", encoding="utf-8")


_BY_HAND = "## Read by hand"
_HEAD = """# Drummers against each other

Written by `benchmarks/gmd_cross.py` from the Groove MIDI Dataset (Gillick et al. 2019, CC BY 4.0): five grooves of the
`eval_session`, four drummers, each one's file as the score of each other's. They play fills and ghost notes of their
own, so that only strokes which both have, piece and slot alike, are scored. Mean and SD are the asynchronies that
`station assess` reports, against the other's strokes: two players' spread, not one's.
"""


if __name__ == "__main__":
    main()
