"""The drummer who plays a score as a video with sound, as a GIF that loops, as numbered pictures, or as one picture."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import islice
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from station.core.errors import DeviceError
from station.core.units import NS_PER_S
from station.motion.drummer import Drummer
from station.motion.style.automation_lanes import in_passes
from station.motion.style.style import Style
from station.music.score import Score
from station.render.picture import Shot
from station.render.quality import QUALITIES
from station.render.render_pool import artist
from station.render.snapshot import Snapshot
from station.scenes.pictures import directed, picture_of
from station.scenes.score_words import NO_WORDS, ScoreWords, bar_numbers
from station.scenes.soundtrack import Sounds, Soundtrack

ShowProgress = Callable[[int], None]
"""Shows how many pictures are done."""


@dataclass(frozen=True, slots=True)
class FilmSpan:
    """What is filmed: `pictures` of them, `fps` a second, the first at `start_s` of the score.

    The `words` stand by its notes; their cues are followed, what they say and their views.
    """

    start_s: float
    pictures: int
    fps: Fraction
    words: ScoreWords = NO_WORDS

    @property
    def times_s(self) -> NDArray[np.float64]:
        """The score's time of every picture, shape (pictures,)."""
        return self.start_s + np.arange(self.pictures) / float(self.fps)


def encoder() -> str:
    """What encodes videos here; raises `DeviceError` that says what to do where nothing does."""
    try:
        from station.render.files.video_file import encoder_name
    except ImportError as fault:
        raise DeviceError(f"videos need FFmpeg's libraries ({fault}): pip install av") from fault
    return encoder_name()


def write_film(drummer: Drummer, span: FilmSpan, shot: Shot, sounds: Sounds, path: Path, show: ShowProgress) -> None:
    """A video at `path`, whole or not at all; raises `DeviceError` without OpenGL, disk or encoder."""
    soundtrack = Soundtrack.of_score(drummer.score, span.start_s, sounds)
    write_video(_snapshots(drummer, span), span, shot, soundtrack, (path, show))


def write_video(
    snapshots: Iterable[Snapshot],
    span: FilmSpan,
    shot: Shot,
    soundtrack: Soundtrack,
    into: tuple[Path, ShowProgress],
) -> None:
    """The pictures of `snapshots`, one for each of `span`, with their sound, as a video at a path, whole or not at all.

    Raises `DeviceError` without OpenGL, disk or encoder.
    """
    encoder()
    from station.render.files.video_file import EFFORTS, VideoFormat, video_file

    path, show = into
    effort = EFFORTS[QUALITIES.index(shot.quality)]
    video = VideoFormat(shot.size, span.fps, soundtrack.rate_hz, effort)
    with artist(shot, span.pictures) as drawer, video_file(path, video) as sink:
        for done, planes in enumerate(drawer.film(snapshots), 1):
            sink.add_picture(planes)
            sink.add_sound(soundtrack.until(float(done / span.fps)))
            show(done)


def write_pictures(drummer: Drummer, span: FilmSpan, shot: Shot, paths: Iterable[Path], show: ShowProgress) -> None:
    """A PNG a picture, each whole or not at all; raises `DeviceError` without OpenGL or disk."""
    with artist(shot, span.pictures) as drawer:
        for done, _ in enumerate(drawer.pngs(_snapshots(drummer, span), paths), 1):
            show(done)


@dataclass(frozen=True, slots=True)
class FilmLoop:
    """Bars that are played for ever: the score of `drummer` is three passes in a row of `length_s`, the second is seen.

    So the motion has no seam, nor the notes that pass. `first_bar` (from 0) and `bar_count` are the whole score's, as
    are its `words`.
    """

    length_s: float
    first_bar: int
    bar_count: int
    words: ScoreWords = NO_WORDS

    @classmethod
    def of(cls, drummer: Drummer, first_bar: int, bar_count: int, words: ScoreWords) -> "FilmLoop":
        """The loop of a drummer who plays what `score` gave, where no take's spelling fits."""
        return cls(drummer.score.length_ns / NS_PER_S / _PASSES, first_bar, bar_count, replace(words, spelling=None))

    @staticmethod
    def score(score: Score, first_bar: int, last_bar: int) -> Score:
        """What the drummer of a loop of these bars plays."""
        return score.bars(first_bar, last_bar).repeated(_PASSES)

    @staticmethod
    def style(style: Style, first_bar: int, last_bar: int) -> Style:
        """`style`, whose lanes count the whole score's bars, for what `score` gives."""
        return in_passes(style, first_bar, last_bar - first_bar + 1, _PASSES)


_PASSES = 3
_SAMPLES = 12
"""So many pictures choose a GIF's colours (our choice: more of them chose the same)."""


def write_loop(drummer: Drummer, loop: FilmLoop, fps: float, shot: Shot, path: Path, show: ShowProgress) -> None:
    """A GIF at `path`, whole or not at all; raises `DeviceError` without OpenGL, disk or encoder."""
    encoder()
    from station.render.files.gif_file import gif_times, pixels_of, write_gif

    times = gif_times(loop.length_s, fps)
    seen = [loop.length_s * (1 + begin / times.end) for begin in times.begins]
    samples = seen[:: -(-len(seen) // _SAMPLES)]
    shown = (_in_loop(picture_of(drummer, at_s, loop.words), loop) for at_s in [*samples, *seen])
    with artist(shot, len(samples) + len(seen)) as drawer:
        drawn = map(pixels_of, drawer.film(shown))
        for done in write_gif(path, drawn, list(islice(drawn, len(samples))), times):
            show(done)


def _in_loop(snapshot: Snapshot, loop: FilmLoop) -> Snapshot:
    """The snapshot with the bars' own numbers."""
    numbers = bar_numbers(loop.words.sections, loop.first_bar, snapshot.score.bar_count // _PASSES, passes=None)
    hud = snapshot.hud
    if hud.bar is not None:
        hud = replace(hud, bar=numbers.of(hud.bar - 1), bar_count=loop.bar_count)
    return directed(replace(snapshot, hud=hud, bar_numbers=numbers), loop.words.cues)


def _snapshots(drummer: Drummer, span: FilmSpan) -> Iterator[Snapshot]:
    words = span.words
    return (directed(picture_of(drummer, float(at_s), words), words.cues) for at_s in span.times_s)
