"""`station animate SCORE --out FILE`: the drummer who plays a score, as a picture or as motion for other programs."""

import argparse
from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from station.app.commands.drums import add_drums_options, led_score, planned
from station.app.commands.output import say, say_beyond
from station.core.errors import BadInput
from station.motion.drummer import Drummer
from station.motion.figure import (
    GREATEST_STATURE_M,
    LEAST_STATURE_M,
    Figure,
    figure_names,
    figure_of,
    load_figure,
)
from station.motion.propose import PROPOSED, propose_style
from station.motion.style_file import load_style, style_names
from station.music.score import Score

MAX_PIXELS = 7680
"""No side of a picture is longer: what common drivers draw into at once is twice that; our choice."""
MIN_FPS, MAX_FPS = 1.0, 1000.0
LEAD_S = 1.0
"""Motion begins so long before its first bar, so that the first preparation is there; our choice."""

Times = NDArray[np.float64]


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add this command's words."""
    parser.add_argument("score", metavar="SCORE", help="a lesson, a MIDI file or a text score")
    parser.add_argument("--out", metavar="FILE", type=Path, required=True, help=f"the file to write: {_ENDINGS}")
    styles = f"{', '.join(style_names())}, {PROPOSED} (what the score itself suggests), or a file"
    parser.add_argument("--style", metavar="NAME", default="natural", help=styles)
    add_drums_options(parser)
    body = parser.add_mutually_exclusive_group()
    body.add_argument("--figure", metavar="NAME", default="", help=f"{', '.join(figure_names())}, or a file")
    body.add_argument("--stature", type=float, metavar="M", help="the drummer's height in metres, usual proportions")
    parser.add_argument("--fps", type=float, metavar="N", default=60.0, help="poses a second of motion (%(default)g)")
    parser.add_argument("--size", metavar="WxH", type=_size, default=(1280, 720), help="of a picture (1280x720)")
    parser.add_argument("--start-bar", type=int, metavar="A", default=1, help="the first bar, from 1 (%(default)s)")
    parser.add_argument("--end-bar", type=int, metavar="B", help="the last bar (the score's)")
    parser.add_argument("--beat", type=float, metavar="T", default=1.0, help="the beat that a picture shows, from 1")


def run(arguments: argparse.Namespace) -> int:
    """Draw one instant, or write the motion of some bars."""
    out: Path = arguments.out
    ending = out.suffix.lower()
    if ending not in (".png", *_WRITERS):
        raise BadInput(out, "", f"expected a name that ends in {_ENDINGS}")
    score = led_score(arguments)
    style = propose_style(score) if arguments.style == PROPOSED else load_style(arguments.style)
    plan = planned(score, _figure(arguments), arguments)
    drummer = Drummer(score, plan.kit, plan.figure, style, plan)
    if ending == ".png":
        from station.app.pictures import draw_drummer

        draw_drummer(drummer, _moment_s(drummer.score, arguments), out, arguments.size)
    else:
        _WRITERS[ending]()(drummer, out, _times(drummer.score, arguments))
    say_beyond(drummer.assignment.warnings)
    say(f"{'picture' if ending == '.png' else 'motion '}  {out}")
    return 0


def _figure(arguments: argparse.Namespace) -> Figure:
    """The body that plays."""
    if arguments.stature is None:
        return load_figure(arguments.figure or "median")
    if not LEAST_STATURE_M <= arguments.stature <= GREATEST_STATURE_M:
        expected = f"expected {LEAST_STATURE_M:g} to {GREATEST_STATURE_M:g} metres"
        raise BadInput("--stature", f"{arguments.stature:g}", expected)
    return figure_of(arguments.stature)


def _moment_s(score: Score, arguments: argparse.Namespace) -> float:
    """The time of the beat that a picture shows."""
    start, _ = _ticks(score, arguments)
    meter = score.tempo_map.meter_at(start)
    if not 1 <= arguments.beat < meter.beats + 1:
        raise BadInput("--beat", f"{arguments.beat:g}", f"the bar has beats 1 to {meter.beats}")
    return float(score.tempo_map.seconds_at(start + round((arguments.beat - 1) * meter.beat_ticks)))


def _times(score: Score, arguments: argparse.Namespace) -> Times:
    """The times of the poses, `--fps` a second, from a little before the first bar to the end of the last."""
    fps = arguments.fps
    if not MIN_FPS <= fps <= MAX_FPS:
        raise BadInput("--fps", f"{fps:g}", f"expected {MIN_FPS:g} to {MAX_FPS:g} poses a second")
    start_s, end_s = score.tempo_map.seconds_at(_ticks(score, arguments)).tolist()
    return np.asarray(start_s - LEAD_S + np.arange(round((end_s - start_s + LEAD_S) * fps) + 1) / fps)


def _ticks(score: Score, arguments: argparse.Namespace) -> tuple[int, int]:
    """First tick of the first bar, last of the last."""
    first = arguments.start_bar
    last = score.bar_count if arguments.end_bar is None else arguments.end_bar
    if not 1 <= first <= last <= score.bar_count:
        raise BadInput("--start-bar, --end-bar", f"{first}-{last}", f"the score has bars 1 to {score.bar_count}")
    return score.tempo_map.bar_start(first - 1), score.tempo_map.bar_start(last)


# --- formats ---------------------------------------------------------------------------------------------------------

Writer = Callable[[Drummer, Path, Times], None]


def _npz() -> Writer:
    from station.motion.export_npz import write_npz

    return write_npz


def _bvh() -> Writer:
    from station.motion.export_bvh import write_bvh

    return write_bvh


def _glb() -> Writer:
    from station.motion.export_glb import write_glb

    return write_glb


_WRITERS: dict[str, Callable[[], Writer]] = {".npz": _npz, ".bvh": _bvh, ".glb": _glb}
_ENDINGS = ".png, .npz, .bvh or .glb"


def _size(text: str) -> tuple[int, int]:
    width, _, height = text.lower().partition("x")
    try:
        size = int(width), int(height)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r}: expected a size such as 1280x720") from None
    if not all(16 <= side <= MAX_PIXELS for side in size):
        raise argparse.ArgumentTypeError(f"{text!r}: expected sides of 16 to {MAX_PIXELS} pixels")
    return size
