"""A benchmark of videos: pictures of the lowest quality drawn, encoded and written with sound.

Beside it stands the encoder alone, at work on planes that are drawn already: what it leaves for drawing.
"""

from collections.abc import Iterable
from fractions import Fraction
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from station.bench.harness.benchmark import Benchmark, Measurement, median_s
from station.bench.rigs.drawer import SIZE, snapshots
from station.render.files.video_file import VideoFormat, video_file
from station.render.gpu.nv12 import Planes
from station.render.picture import Shot
from station.render.quality import QUALITIES
from station.render.render_pool import artist

_FRAMES = 120
_FPS = 60
_RATE_HZ = 48_000
_ROUNDS = 3


def _video() -> Measurement:
    frames = snapshots(_FRAMES)
    with TemporaryDirectory() as folder, artist(Shot(SIZE, QUALITIES[0]), _FRAMES) as who:
        path = Path(folder) / "film.mp4"
        drawn = list(who.film(frames))
        ours_s = median_s(lambda: _write(who.film(frames), path), _ROUNDS) / _FRAMES
        theirs_s = median_s(lambda: _write(drawn, path), _ROUNDS) / _FRAMES
    return Measurement(1 / ours_s, 1 / theirs_s)


def _write(pictures: Iterable[Planes], path: Path) -> None:
    silence = np.zeros((_RATE_HZ // _FPS, 2), np.float32)
    with video_file(path, VideoFormat(SIZE, Fraction(_FPS), _RATE_HZ)) as sink:
        for planes in pictures:
            sink.add_picture(planes)
            sink.add_sound(silence)


BENCHMARKS = (
    Benchmark("video_lowest_quality_1280x720", "pictures/s", 90.0, "higher", "x264 alone, nothing drawn", _video),
)
