"""The drummer who plays a score as a video with sound, as numbered pictures, or as one picture."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from station.app.pictures import picture_of
from station.app.soundtrack import Sounds, Soundtrack
from station.core.errors import DeviceError
from station.motion.drummer import Drummer
from station.render.drawers import artist
from station.render.picture import Shot
from station.render.quality import QUALITIES
from station.render.snapshot import Snapshot

Tell = Callable[[int], None]
"""Is told how many pictures are done."""


@dataclass(frozen=True, slots=True)
class Take:
    """Which stretch is filmed: `pictures` of them, `fps` a second, the first at `start_s` of the score."""

    start_s: float
    pictures: int
    fps: Fraction

    @property
    def times_s(self) -> NDArray[np.float64]:
        """The score's time of every picture, shape (pictures,)."""
        return self.start_s + np.arange(self.pictures) / float(self.fps)


def encoder() -> str:
    """What encodes videos here; raises `DeviceError` that says what to do where nothing does."""
    try:
        from station.render.video_file import encoder_name
    except ImportError as fault:
        raise DeviceError(f"videos need FFmpeg's libraries ({fault}): pip install av") from fault
    return encoder_name()


def write_film(drummer: Drummer, take: Take, shot: Shot, sounds: Sounds, path: Path, tell: Tell) -> None:
    """A video at `path`, whole or not at all; raises `DeviceError` without OpenGL, disk or encoder."""
    encoder()
    from station.render.video_file import EFFORTS, VideoFormat, video_file

    soundtrack = Soundtrack(drummer.score, take.start_s, sounds)
    effort = EFFORTS[QUALITIES.index(shot.quality)]
    video = VideoFormat(shot.size, take.fps, soundtrack.rate_hz, effort)
    with artist(shot, take.pictures) as who, video_file(path, video) as sink:
        for done, planes in enumerate(who.film(_snapshots(drummer, take)), 1):
            sink.add_picture(planes)
            sink.add_sound(soundtrack.until(float(done / take.fps)))
            tell(done)


def write_pictures(drummer: Drummer, take: Take, shot: Shot, paths: Iterable[Path], tell: Tell) -> None:
    """A PNG a picture, each whole or not at all; raises `DeviceError` without OpenGL or disk."""
    with artist(shot, take.pictures) as who:
        for done, _ in enumerate(who.pngs(_snapshots(drummer, take), paths), 1):
            tell(done)


def _snapshots(drummer: Drummer, take: Take) -> Iterator[Snapshot]:
    return (picture_of(drummer, float(at_s)) for at_s in take.times_s)
