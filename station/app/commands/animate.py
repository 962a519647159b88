"""`station animate SCORE --out FILE`: the drummer who plays a score, as a picture."""

import argparse
from pathlib import Path

from station.app.commands.output import say
from station.app.commands.scores import load_score
from station.core.errors import BadInput

MAX_PIXELS = 7680
"""No side of a picture is longer: what common drivers draw into at once is twice that; our choice."""


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add this command's words."""
    parser.add_argument("score", metavar="SCORE", help="a lesson or a MIDI file")
    parser.add_argument("--out", metavar="FILE.png", type=Path, required=True, help="the picture to write")
    parser.add_argument("--size", metavar="WxH", type=_size, default=(1280, 720), help="in pixels (1280x720)")
    parser.add_argument("--bar", type=int, default=1, metavar="B", help="the bar to show, from 1 (%(default)s)")
    parser.add_argument("--beat", type=float, default=1.0, metavar="T", help="the beat of it, from 1 (%(default)s)")
    parser.add_argument("--kit", default="", metavar="NAME", help="the drummer's kit: a shipped name or a file")


def run(arguments: argparse.Namespace) -> int:
    """Draw one instant."""
    from station.app.pictures import draw_score

    out: Path = arguments.out
    if out.suffix.lower() != ".png":
        raise BadInput(out, "", "expected a name that ends in .png")
    score = load_score(arguments.score)
    if not 1 <= arguments.bar <= score.bar_count:
        raise BadInput("--bar", str(arguments.bar), f"the score has bars 1 to {score.bar_count}")
    start = score.tempo_map.bar_start(arguments.bar - 1)
    meter = score.tempo_map.meter_at(start)
    if not 1 <= arguments.beat < meter.beats + 1:
        raise BadInput("--beat", f"{arguments.beat:g}", f"the bar has beats 1 to {meter.beats}")
    tick = start + round((arguments.beat - 1) * meter.beat_ticks)
    draw_score(score, float(score.tempo_map.seconds_at(tick)), out, arguments.size, arguments.kit)
    say(f"picture  {out}")
    return 0


def _size(text: str) -> tuple[int, int]:
    width, _, height = text.lower().partition("x")
    try:
        size = int(width), int(height)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r}: expected a size such as 1280x720") from None
    if not all(16 <= side <= MAX_PIXELS for side in size):
        raise argparse.ArgumentTypeError(f"{text!r}: expected sides of 16 to {MAX_PIXELS} pixels")
    return size
