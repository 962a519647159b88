"""Benchmarks of drawing off screen at the lowest quality: whole pictures, and the first one.

The peer is bare moderngl: the same triangles by the same shaders, with the same read-back, but nothing posed, no score
and no words. Without a graphics card everything here is the processor's work.
"""

import subprocess
import sys

from station.bench.benchmark import Benchmark, Measured, median_s
from station.core.pieces import Limb, Piece, Zone
from station.core.units import PPQ
from station.motion.drummer import Drummer
from station.motion.figure import figure_of
from station.motion.kit import load_kit
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.render.bare import BareScene
from station.render.picture import PictureMaker
from station.render.quality import QUALITIES
from station.render.snapshot import Hud, Snapshot

SIZE = (1280, 720)
_FRAMES = 12
_ROUNDS = 3
_FIRST = (
    "from station.bench.drawing import snapshots, SIZE\n"
    "from station.render.picture import PictureMaker\n"
    "from station.render.quality import QUALITIES\n"
    "PictureMaker(SIZE, QUALITIES[0]).draw(snapshots(1)[0])\n"
)


def snapshots(count: int) -> list[Snapshot]:
    """Consecutive frames, 60 a second, of a drummer who plays sixteenths on the hat over kick and snare."""
    notes = [Note(k * PPQ // 4, Piece.HIHAT, Zone.BOW, limb=Limb.RIGHT_HAND) for k in range(64)]
    notes += [Note(k * PPQ, Piece.SNARE if k % 2 else Piece.KICK) for k in range(16)]
    score = Score.from_notes(notes, TempoMap.constant(100.0))
    kit, figure = load_kit(), figure_of()
    drummer = Drummer(score, kit, figure)
    hud = Hud("Sixteenths", "Pass 1 of 4", 1, 2, 4, 4, 100.0, None, 12, 14)
    times = [1.0 + k / 60 for k in range(count)]
    return [Snapshot(score, t, kit, figure, drummer.pose(t), hud=hud) for t in times]


def _pictures() -> Measured:
    frames = snapshots(_FRAMES)
    maker = PictureMaker(SIZE, QUALITIES[0])
    bare = BareScene(SIZE, frames[0].kit, frames[0].figure, QUALITIES[0])
    maker.draw(frames[0])
    bare.pose(frames[0])
    ours_s = median_s(lambda: [maker.draw(frame) for frame in frames], _ROUNDS) / _FRAMES
    theirs_s = median_s(lambda: [bare.draw() for _ in frames], _ROUNDS) / _FRAMES
    return Measured(1 / ours_s, 1 / theirs_s, f"{bare.triangles} triangles")


def _first_picture() -> Measured:
    words = [sys.executable, "-c", _FIRST]
    return Measured(median_s(lambda: subprocess.run(words, check=True, capture_output=True), _ROUNDS))


BENCHMARKS = (
    Benchmark("pictures_lowest_quality_1280x720", "pictures/s", 60.0, "higher", "bare moderngl", _pictures),
    Benchmark("first_picture", "s", 2.0, "lower", None, _first_picture),
)
