"""`station animate SCORE --out FILE`: the drummer who plays a score, as video, pictures or motion for others."""

import argparse
import re
from collections.abc import Sequence
from math import inf
from pathlib import Path

import numpy as np

from station.cli.animate_motion import WRITERS
from station.cli.console import say, say_beyond
from station.cli.drummer_options import add_drums_options, led_score, planned
from station.core.errors import BadInput
from station.core.units import NS_PER_S
from station.motion.drummer import Drummer
from station.motion.kinematics.figure import (
    GREATEST_STATURE_M,
    LEAST_STATURE_M,
    Figure,
    figure_names,
    figure_of,
    load_figure,
)
from station.motion.style.proposal import PROPOSED, propose_style
from station.motion.style.style_file import load_style, style_names
from station.music.score import Score
from station.render.camera import NamedView

MAX_PIXELS = 7680
"""No side of a picture is longer: what common drivers draw into at once is twice that; our choice."""
MIN_FPS, MAX_FPS = 1.0, 1000.0
LEAD_S = 1.0
"""Motion begins so long before its first bar, so that the first preparation is there; our choice."""
RING_S = 1.0
"""A video goes on so long after the score's end, so that what rings is heard; our choice."""
LEVELS = ("low", "middle", "high")
"""The levels of `station.render.quality.QUALITIES`."""

NUMBER = re.compile(r"(%0?\d*d)")
"""What numbers pictures in a name."""
_DRAWN = ("picture", "pictures", "video", "loop")
_MEANT_FOR = {
    **dict.fromkeys(("beat", "time"), ("picture",)),
    **dict.fromkeys(("size", "quality", "view", "mirror", "no_score"), _DRAWN),
    "fps": ("pictures", "video", "loop", "motion"),
    "seconds": ("pictures", "video", "motion"),
    "click": ("video",),
}
"""Which options say something of what."""
_VIEWS = tuple(view.name.lower() for view in NamedView)
_USUAL = {
    "beat": 1.0,
    "size": (1280, 720),
    "quality": LEVELS[1],
    "view": _VIEWS[NamedView.SHOULDER],
    "mirror": False,
    "no_score": False,
    "fps": 60.0,
    "click": False,
}
_USUAL_OF_LOOPS = {"size": (640, 360), "fps": 20.0}
"""What a GIF can bear: a two-bar groove is about 2 MB (our choice)."""
MOST_LOOP_S = 60.0
"""No GIF lasts longer: tens of megabytes, in which nobody can stop or go back (our choice)."""
_WORDS = {
    "loop": "a GIF",
    "picture": "a picture",
    "pictures": "numbered pictures",
    "video": "a video",
    "motion": "motion",
}


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add this command's words."""
    parser.add_argument("score", metavar="SCORE", help="a lesson, a MIDI file, a text score or a take (.capture)")
    parser.add_argument("--out", metavar="FILE", type=Path, required=True, help=_OUT)
    styles = f"{', '.join(style_names())}, {PROPOSED} (what the score itself suggests), or a file"
    parser.add_argument("--style", metavar="NAME", default="natural", help=styles)
    add_drums_options(parser)
    body = parser.add_mutually_exclusive_group()
    body.add_argument("--figure", metavar="NAME", default="", help=f"{', '.join(figure_names())}, or a file")
    body.add_argument("--stature", type=float, metavar="M", help="the drummer's height in metres, usual proportions")
    parser.add_argument("--fps", type=float, metavar="N", help="pictures or poses a second (60)")
    parser.add_argument("--start-bar", type=int, metavar="A", default=1, help="the first bar, from 1 (%(default)s)")
    parser.add_argument("--end-bar", type=int, metavar="B", help="the last bar (the score's)")
    parser.add_argument("--seconds", type=float, metavar="S", help="no more than so many seconds")
    _add_picture_options(parser)


def _add_picture_options(parser: argparse.ArgumentParser) -> None:
    pictures = parser.add_argument_group("video and pictures")
    pictures.add_argument("--size", metavar="WxH", type=_size, help="in pixels (1280x720)")
    pictures.add_argument("--quality", choices=LEVELS, help=f"how fine ({_USUAL['quality']})")
    pictures.add_argument("--view", choices=_VIEWS, help=f"from where ({_USUAL['view']})")
    pictures.add_argument(
        "--mirror", action="store_true", default=None, help="left and right swapped, to learn face to face"
    )
    pictures.add_argument("--no-score", action="store_true", default=None, help="no score below; title and beat stay")
    pictures.add_argument("--click", action="store_true", default=None, help="a video with a click under the drums")
    moment = pictures.add_mutually_exclusive_group()
    moment.add_argument("--beat", type=float, metavar="T", help="the beat that a picture shows (1)")
    moment.add_argument("--time", type=float, metavar="S", help="the second of the score that a picture shows")


def run(arguments: argparse.Namespace) -> int:
    """Draw an instant or some bars, or write the motion of some bars."""
    out: Path = arguments.out
    ending = out.suffix.lower()
    if ending not in (_STILL, _FILM, _LOOP, *WRITERS):
        raise BadInput(out, "", f"expected a name that ends in {_ENDINGS}")
    _check_meant(arguments, _made(out))
    if ending in (_FILM, _LOOP):
        _check_even(arguments.size)
    whole = score = led_score(arguments)
    if ending == _LOOP:
        score = _looped(whole, arguments)
    style = propose_style(score) if arguments.style == PROPOSED else load_style(arguments.style)
    plan = planned(score, _figure(arguments), arguments)
    drummer = Drummer(score, plan.kit, plan.figure, style, plan)
    if ending in WRITERS:
        start_s, length_s = _stretch(drummer.score, arguments, 0.0)
        times_s = start_s + np.arange(round(length_s * arguments.fps) + 1) / arguments.fps
        WRITERS[ending]()(drummer, out, times_s)
        kind = "motion "
    else:
        kind = _draw(drummer, whole, arguments)
    say_beyond(drummer.assignment.warnings)
    say(f"{kind}  {out}")
    return 0


def _made(out: Path) -> str:
    """What a name asks for."""
    ending = out.suffix.lower()
    if ending == _FILM:
        return "video"
    if ending == _LOOP:
        return "loop"
    if ending != _STILL:
        return "motion"
    numbers = out.name.count("%")
    if numbers == 0:
        return "picture"
    if numbers > 1 or not NUMBER.search(out.name):
        raise BadInput(out, "", "expected one number such as %05d in the name, and no other %")
    return "pictures"


def _check_meant(arguments: argparse.Namespace, made: str) -> None:
    """Refuse what says nothing of what is made, and fill in the usual where nothing was said."""
    for name, kinds in _MEANT_FOR.items():
        if getattr(arguments, name) is None:
            usual = _USUAL | _USUAL_OF_LOOPS if made == "loop" else _USUAL
            setattr(arguments, name, usual.get(name))
        elif made not in kinds:
            option = f"--{name.replace('_', '-')}"
            raise BadInput(option, "", f"{arguments.out.name} makes {_WORDS[made]}; this is for {_listed(kinds)}")


def _listed(kinds: Sequence[str]) -> str:
    return ", ".join(_WORDS[kind] for kind in kinds)


def _looped(score: Score, arguments: argparse.Namespace) -> Score:
    """The bars that a GIF shows, as they are played over and over."""
    from station.scenes.film import FilmLoop

    _check_fps(arguments)
    start, end = _ticks(score, arguments)
    start_s, end_s = score.tempo_map.seconds_at([start, end]).tolist()
    if end_s - start_s > MOST_LOOP_S:
        fault = f"a GIF lasts {MOST_LOOP_S:g} s at most, these bars {end_s - start_s:.0f} s: choose some of them"
        raise BadInput("--start-bar, --end-bar", "", f"{fault}, or make an .mp4")
    return FilmLoop.score(score, *_bars(score, arguments))


def _draw(drummer: Drummer, whole: Score, arguments: argparse.Namespace) -> str:
    """Draw what the name asks for; returns what it is, for people."""
    from station.cli import animate_pictures as pictures

    made = _made(arguments.out)
    if made == "picture":
        pictures.draw_still(drummer, _moment_s(drummer.score, arguments), arguments)
        return "picture"
    if made == "loop":
        pictures.draw_loop(drummer, whole, _bars(whole, arguments)[0], arguments)
        return "loop   "
    stretch = _stretch(drummer.score, arguments, RING_S)
    if made == "pictures":
        pictures.draw_sequence(drummer, stretch, arguments)
        return "pictures"
    pictures.draw_film(drummer, stretch, arguments)
    return "video  "


def _figure(arguments: argparse.Namespace) -> Figure:
    """The body that plays."""
    if arguments.stature is None:
        return load_figure(arguments.figure or "median")
    if not LEAST_STATURE_M <= arguments.stature <= GREATEST_STATURE_M:
        expected = f"expected {LEAST_STATURE_M:g} to {GREATEST_STATURE_M:g} metres"
        raise BadInput("--stature", f"{arguments.stature:g}", expected)
    return figure_of(arguments.stature)


def _moment_s(score: Score, arguments: argparse.Namespace) -> float:
    """The time that a picture shows."""
    if arguments.time is not None:
        length_s = score.length_ns / NS_PER_S
        if not 0 <= arguments.time <= length_s:
            raise BadInput("--time", f"{arguments.time:g}", f"the score has seconds 0 to {length_s:.3f}")
        return float(arguments.time)
    start, _ = _ticks(score, arguments)
    meter = score.tempo_map.meter_at(start)
    if not 1 <= arguments.beat < meter.beats + 1:
        raise BadInput("--beat", f"{arguments.beat:g}", f"the bar has beats 1 to {meter.beats}")
    return float(score.tempo_map.seconds_at(start + round((arguments.beat - 1) * meter.beat_ticks)))


def _stretch(score: Score, arguments: argparse.Namespace, ring_s: float) -> tuple[float, float]:
    """Where it begins, a little before the first bar, and how long it lasts: to the last bar's end, in seconds.

    Where that is the score's end, `ring_s` more.
    """
    _check_fps(arguments)
    most_s = arguments.seconds
    if most_s is not None and not 0 < most_s < inf:
        raise BadInput("--seconds", f"{most_s:g}", "expected a number above 0")
    first, last = _ticks(score, arguments)
    start_s, end_s = score.tempo_map.seconds_at([first, last]).tolist()
    length_s = end_s - start_s + LEAD_S + (ring_s if last >= score.end_tick else 0.0)
    return start_s - LEAD_S, length_s if most_s is None else min(length_s, most_s)


def _check_fps(arguments: argparse.Namespace) -> None:
    if not MIN_FPS <= arguments.fps <= MAX_FPS:
        raise BadInput("--fps", f"{arguments.fps:g}", f"expected {MIN_FPS:g} to {MAX_FPS:g} a second")


def _ticks(score: Score, arguments: argparse.Namespace) -> tuple[int, int]:
    """First tick of the first bar, last of the last."""
    first, last = _bars(score, arguments)
    return score.tempo_map.bar_start(first), score.tempo_map.bar_start(last + 1)


def _bars(score: Score, arguments: argparse.Namespace) -> tuple[int, int]:
    """The first and the last bar, from 0."""
    first = arguments.start_bar
    last = score.bar_count if arguments.end_bar is None else arguments.end_bar
    named = "--start-bar, --end-bar", f"{first}-{last}"
    if not (1 <= first <= score.bar_count and 1 <= last <= score.bar_count):
        raise BadInput(*named, f"the score has bars 1 to {score.bar_count}")
    if last < first:
        raise BadInput(*named, "the last bar is before the first")
    return first - 1, last - 1


# --- formats ---------------------------------------------------------------------------------------------------------

_STILL, _FILM, _LOOP = ".png", ".mp4", ".gif"
_ENDINGS = ".mp4, .gif, .png, .npz, .bvh or .glb"
_OUT = f"the file to write: {_ENDINGS}; %%05d.png in a name numbers the pictures of all bars"


def _check_even(size: tuple[int, int]) -> None:
    if any(side % 2 for side in size):
        raise BadInput(
            "--size", "{}x{}".format(*size), "a video's and a GIF's width and height are even numbers of pixels"
        )


def _size(text: str) -> tuple[int, int]:
    width, _, height = text.lower().partition("x")
    try:
        size = int(width), int(height)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r}: expected a size such as 1280x720") from None
    if not all(16 <= side <= MAX_PIXELS for side in size):
        raise argparse.ArgumentTypeError(f"{text!r}: expected sides of 16 to {MAX_PIXELS} pixels")
    return size
