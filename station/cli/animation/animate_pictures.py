"""What `station animate` draws: one picture, numbered pictures, a GIF that loops, or a video with sound."""

import re
from collections.abc import Callable, Iterator
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

from station.cli.animation.animate_options import AnimateOptions, PictureOptions
from station.cli.console import Progress
from station.core.settings import load_settings
from station.motion.drummer import Drummer
from station.music.score import Score
from station.render.framing import Stage, named
from station.render.picture import Shot
from station.render.quality import QUALITIES
from station.scenes.film import FilmLoop, FilmSpan, write_film, write_loop, write_pictures
from station.scenes.score_words import ScoreWords
from station.scenes.soundtrack import Sounds
from station.sound.samples.load_kit import load_kit

_NUMBER = re.compile(r"(%0?\d*d)")
"""What numbers pictures in a name."""
RATE_HZ = 48_000
"""Of a video's sound: what players and sites take as it is."""
_MOST_DENOMINATOR = 1001
"""Of pictures a second: 30000/1001 is what televisions call 29.97."""

Span = tuple[float, float]
"""From which second of the score on, and for how many seconds."""


def draw_picture(drummer: Drummer, at_s: float, words: ScoreWords, options: AnimateOptions) -> None:
    """The picture of one instant."""
    write_pictures(
        drummer,
        FilmSpan(at_s, 1, Fraction(1), words),
        _shot(drummer, options.picture),
        [options.out],
        lambda _: None,
    )


def draw_sequence(drummer: Drummer, span: Span, words: ScoreWords, options: AnimateOptions) -> None:
    """Numbered pictures, from 1."""
    film = replace(_film_span(span, options.fps), words=words)
    shot = _shot(drummer, options.picture)
    _with_progress(film, lambda show: write_pictures(drummer, film, shot, _numbered(options.out, film), show))


def draw_loop(drummer: Drummer, whole: Score, first_bar: int, words: ScoreWords, options: AnimateOptions) -> None:
    """A GIF of bars of the `whole` score from `first_bar` (from 0) on, which `drummer` plays over and over."""
    loop = FilmLoop.of(drummer, first_bar, whole.bar_count, words)
    shot = _shot(drummer, options.picture)
    progress = Progress(round(loop.length_s * options.fps))
    try:
        write_loop(drummer, loop, options.fps, shot, options.out, progress.show)
    finally:
        progress.close()


def draw_film(drummer: Drummer, span: Span, words: ScoreWords, options: AnimateOptions) -> None:
    """A video with sound."""
    film = replace(_film_span(span, options.fps), words=words)
    settings = load_settings()
    sounds = Sounds(load_kit(settings.drums, RATE_HZ), settings.click if options.picture.click else None)
    shot = _shot(drummer, options.picture)
    _with_progress(film, lambda show: write_film(drummer, film, shot, sounds, options.out, show))


def _with_progress(span: FilmSpan, work: Callable[[Callable[[int], None]], None]) -> None:
    progress = Progress(span.pictures)
    try:
        work(progress.show)
    finally:
        progress.close()


def _film_span(span: Span, fps: float) -> FilmSpan:
    start_s, length_s = span
    exact = Fraction(fps).limit_denominator(_MOST_DENOMINATOR)
    return FilmSpan(start_s, max(1, round(length_s * exact)), exact)


def _numbered(out: Path, span: FilmSpan) -> Iterator[Path]:
    before, number, after = _NUMBER.split(out.name, maxsplit=1)
    return (out.with_name(f"{before}{number % k}{after}") for k in range(1, span.pictures + 1))


def _shot(drummer: Drummer, picture: PictureOptions) -> Shot:
    camera = replace(
        named(picture.view, Stage(drummer.kit, drummer.figure, drummer.style.stand)), mirrored=picture.mirror
    )
    return Shot(picture.size, QUALITIES[picture.quality], camera, not picture.no_score)
