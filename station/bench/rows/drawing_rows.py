"""Benchmarks of drawing off screen at the lowest quality: whole pictures, turned ones, the first one, and memory.

The peer is bare moderngl: the same triangles by shaders that light every pixel, with the same read-back, but nothing
posed, no score and no words, and nothing kept from one picture to the next. Without a graphics card everything here is
the processor's work.
"""

import mmap
import subprocess
import sys
from dataclasses import replace
from functools import partial
from pathlib import Path

from station.bench.harness.benchmark import Benchmark, Measurement, median_s
from station.bench.rigs.drawer import SIZE, snapshots
from station.core.named_view import NamedView
from station.music.judgement import Label
from station.render.bare_scene import BareScene
from station.render.framing import named
from station.render.gpu.gl import RenderTarget, standalone_context
from station.render.painter import Arrangement, Painter
from station.render.picture import PictureMaker
from station.render.quality import QUALITIES
from station.render.snapshot import no_marks

_SETTLES, _GROWS_FOR = 200, 500
_SESSION = 10 * 60 * 60
"""Pictures of ten minutes at 60 a second."""
_MEMORY = Path("/proc/self/statm")
"""Linux's account of this process: its second number counts the resident pages."""
_FRAMES = 12
_ROUNDS = 3


def _pictures() -> Measurement:
    frames = snapshots(_FRAMES)
    maker = PictureMaker(SIZE, QUALITIES[0])
    bare = BareScene(SIZE, frames[0].kit, frames[0].figure, QUALITIES[0])
    maker.draw(frames[0])
    bare.pose(frames[0])
    ours_s = median_s(lambda: [maker.draw(frame) for frame in frames], _ROUNDS) / _FRAMES
    theirs_s = median_s(lambda: [bare.draw() for _ in frames], _ROUNDS) / _FRAMES
    return Measurement(1 / ours_s, 1 / theirs_s, f"{bare.triangles} triangles, of which the peer draws all every time")


def _turned() -> Measurement:
    """The camera moves from picture to picture, as while the user drags it: nothing can be kept."""
    frames = snapshots(_FRAMES)
    ctx = standalone_context()
    with ctx:
        painter, target = Painter(ctx, QUALITIES[0]), RenderTarget(ctx, SIZE)
        cameras = [named(NamedView.SHOULDER).orbited(0.01 * k, 0.0) for k in range(_FRAMES)]

        def draw() -> None:
            for frame, camera in zip(frames, cameras, strict=True):
                arrangement = Arrangement(is_rough=True)
                painter.draw(frame, target.framebuffer, (0, 0, *SIZE), camera, arrangement=arrangement)
                target.read()

        return Measurement(_FRAMES / median_s(draw, _ROUNDS))


def _growth(pictures: int) -> Measurement:
    """The process's memory after many pictures with ever new words and marks, less that after the first few hundred."""
    if not _MEMORY.exists():
        return Measurement(None, note=f"memory is read from {_MEMORY}")
    frames, maker = snapshots(_GROWS_FOR // 20), PictureMaker((320, 180), QUALITIES[0])
    settled = 0
    for k in range(_SETTLES + pictures):
        frame = frames[k % len(frames)]
        marks = no_marks(frame.score)
        marks["label"][: k % len(marks)] = Label.MATCH
        words = replace(frame.hud, bar=k // 60 + 1, right=k, judged=k + 1, message=f"picture {k}")
        maker.draw(replace(frame, marks=marks, hud=words))
        if k == _SETTLES:
            settled = _memory_bytes()
    return Measurement((_memory_bytes() - settled) / 1e6, note=f"{pictures} pictures")


def _memory_bytes() -> int:
    return int(_MEMORY.read_text(encoding="ascii").split()[1]) * mmap.PAGESIZE


def _first_picture() -> Measurement:
    words = [sys.executable, "-m", "station.bench.rigs.drawer", "1"]
    return Measurement(median_s(lambda: subprocess.run(words, check=True, capture_output=True), _ROUNDS))


BENCHMARKS = (
    Benchmark("pictures_lowest_quality_1280x720", "pictures/s", 60.0, "higher", "bare moderngl", _pictures),
    Benchmark("pictures_camera_turns_1280x720", "pictures/s", 30.0, "higher", None, _turned),
    Benchmark("pictures_memory_growth", "MB", 0.5, "lower", None, partial(_growth, _GROWS_FOR)),
    Benchmark(
        "ten_minutes_of_pictures_memory_growth", "MB", 5.0, "lower", None, partial(_growth, _SESSION), True, 1_800.0
    ),
    Benchmark("first_picture", "s", 2.0, "lower", None, _first_picture),
)
