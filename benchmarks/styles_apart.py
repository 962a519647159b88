"""Whether styles can be told apart by what is seen: a regression check of the motion, no claim about people.

    .venv/bin/python benchmarks/styles_apart.py [--data ../shared/data/gmd] [--scores 16]

The first `SECONDS` of recordings by human drummers (Groove MIDI Dataset, Gillick et al. 2019, CC BY 4.0) are played in
every shipped style with two seeds. Features come from the positions of visible joints alone, never from controls or
angles, and are fixed in `features`: where the parts of the body lie against each other, how far and how fast they move,
and at which rates the head and the trunk go. One score is left out at a time: its performances are named after their
nearest neighbour among those of all other scores, each feature in units of its spread within a style there. And of each
performance the same style with another seed must be nearer than every other style on the same score.
"""

import argparse
from collections import Counter
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from station.motion.drummer import Drummer
from station.motion.kinematics import frame
from station.motion.kinematics.figure import Joint
from station.motion.style.style import Style
from station.motion.style.style_file import load_style, style_names
from station.music.formats.smf.standard_midi import read_midi, score_from_midi
from station.music.score import Score

Array = NDArray[np.float64]

SECONDS, RATE_HZ = 24.0, 50.0
BANDS_HZ = (0.0, 0.4, 0.9, 1.6, 3.0, 6.0)
"""From a phrase to half beats."""
PARTS = (
    (Joint.PELVIS, Joint.SPINE),
    (Joint.SPINE, Joint.NECK),
    (Joint.NECK, Joint.HEAD),
    (Joint.HEAD, Joint.CROWN),
    (Joint.NECK, Joint.RIGHT_SHOULDER),
    (Joint.NECK, Joint.LEFT_SHOULDER),
    (Joint.RIGHT_SHOULDER, Joint.RIGHT_ELBOW),
    (Joint.LEFT_SHOULDER, Joint.LEFT_ELBOW),
    (Joint.RIGHT_ELBOW, Joint.RIGHT_WRIST),
    (Joint.LEFT_ELBOW, Joint.LEFT_WRIST),
    (Joint.RIGHT_WRIST, Joint.RIGHT_HAND),
    (Joint.LEFT_WRIST, Joint.LEFT_HAND),
)
"""Parts of the body by the joints at their ends."""


def features(rows: Array) -> Array:
    """What is seen of a performance, from poses `RATE_HZ` times a second in the layout of `frame`."""
    joints = rows[:, frame.JOINTS].reshape(-1, 21, 3)
    away = np.stack([joints[:, b] - joints[:, a] for a, b in PARTS], 1)
    way = away / np.linalg.norm(away, axis=2, keepdims=True)
    speed = np.linalg.norm(np.diff(way, axis=0), axis=2) * RATE_HZ
    spread = np.log(way.std(0) + 1e-3)
    rates = [_bands(way[:, k, axis]) for k in range(4) for axis in (0, 1)]  # trunk, neck and head, sideways and forward
    heights = [joints[:, Joint.PELVIS, 2].std(), joints[:, Joint.CROWN, 2].std()]
    fast = np.log(np.quantile(speed, (0.5, 0.95), axis=0) + 1e-2)
    return np.concatenate([way.mean(0).ravel(), spread.ravel(), fast.ravel(), *rates, np.log(np.array(heights) + 1e-3)])


def _bands(values: Array) -> Array:
    """The logarithm of the power in each of `BANDS_HZ`."""
    power = np.abs(np.fft.rfft((values - values.mean()) * np.hanning(len(values)))) ** 2 / len(values)
    frequency = np.fft.rfftfreq(len(values), 1 / RATE_HZ)
    edges = np.searchsorted(frequency, BANDS_HZ)
    return np.log(np.array([power[a:b].sum() for a, b in pairwise(edges.tolist())]) + 1e-5)


def beginning(path: Path) -> Score:
    """The first `SECONDS` of a file."""
    score = score_from_midi(read_midi(path))
    early = np.flatnonzero(score.onset_s < SECONDS)
    return Score.from_notes([score[int(k)] for k in early], score.tempo_map)


def performances(score: Score, names: list[str]) -> Array:
    """The features of `score` in each style with two seeds, (styles, 2, features)."""
    at, drummer = np.arange(0.0, SECONDS, 1 / RATE_HZ), Drummer(score)
    styles = [[_seeded(load_style(name), seed) for seed in (1, 2)] for name in names]
    return np.array([[features(drummer.with_style(style).rows(at)) for style in pair] for pair in styles])


def _seeded(style: Style, seed: int) -> Style:
    return replace(style, seed=seed)


def named(found: Array) -> tuple[int, int, Counter[tuple[int, int]]]:
    """How many of `found` (scores, styles, 2, features) are named rightly, of how many, and what is taken for what."""
    scores, styles = found.shape[:2]
    wrong: Counter[tuple[int, int]] = Counter()
    for left_out in range(scores):
        others = np.delete(found, left_out, axis=0)
        scale = others.std(axis=(0, 2)).mean(0) + 1e-6
        known = (others / scale).transpose(1, 0, 2, 3).reshape(styles, -1, found.shape[3])
        for style in range(styles):
            for seen in found[left_out, style] / scale:
                nearest = int(np.argmin(((known - seen) ** 2).sum(2).min(1)))
                wrong[style, nearest] += nearest != style
    total = scores * styles * 2
    return total - wrong.total(), total, wrong


def seeds_nearer(found: Array) -> tuple[int, int]:
    """How often another seed of the style is nearer than every other style on the same score, of how many."""
    scale = found.std(axis=(0, 2)).mean(0) + 1e-6
    near = 0
    for each in found / scale:
        for style in range(len(each)):
            own = ((each[style, 0] - each[style, 1]) ** 2).sum()
            others = ((np.delete(each, style, axis=0) - each[style, 0]) ** 2).sum(2)
            near += bool(own < others.min())
    return near, found.shape[0] * found.shape[1]


def main() -> None:
    """Play, compare and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", type=Path, default=Path("../shared/data/gmd"))
    parser.add_argument("--scores", type=int, default=16)
    said = parser.parse_args()
    files = [p for p in sorted(said.data.rglob("*.mid")) if score_from_midi(read_midi(p)).length_ns > SECONDS * 1e9]
    if not files:
        parser.error(f"{said.data}: no MIDI files of the Groove MIDI Dataset in it; --data says where they are")
    files = [files[k] for k in np.linspace(0, len(files) - 1, min(said.scores, len(files))).astype(int)]
    names = style_names()
    found = np.array([performances(beginning(path), names) for path in files])
    right, total, wrong = named(found)
    moving, _, _ = named(found[..., 3 * len(PARTS) :])
    print(f"from what moves alone, without the mean postures: {moving} of {total}, {100 * moving / total:.1f} %")
    near, pairs = seeds_nearer(found)
    print(f"{len(files)} scores in {len(names)} styles: {right} of {total} named rightly, {100 * right / total:.1f} %")
    for (style, taken), count in wrong.most_common(8):
        if count:
            print(f"  {names[style]} taken for {names[taken]}: {count}")
    print(f"another seed nearer than every other style: {near} of {pairs}, {100 * near / pairs:.1f} %")


if __name__ == "__main__":
    main()
