"""The options of `station animate`, and which of them say something of what is made."""

from dataclasses import dataclass, replace
from pathlib import Path

from station.cli.drummer_options import DrumsOptions
from station.cli.options.option_fields import (
    argument,
    choice,
    flag,
    group,
    number,
    option,
    required,
    said,
    unread,
    whole_number,
)
from station.core.errors import BadInput
from station.core.named_view import NamedView
from station.motion.kinematics.figure import DEFAULT_FIGURE, figure_names
from station.motion.style.proposal import PROPOSED
from station.motion.style.style_file import style_names

MAX_PIXELS = 7680
"""No side of a picture is longer: what common drivers draw into at once is twice that; our choice."""
LEVELS = {"low": 0, "middle": 1, "high": 2}
"""The rows of `station.render.quality.QUALITIES`."""
ENDINGS = ".mp4, .gif, .png, .npz, .bvh or .glb"
_LOOP_SIZE, _LOOP_FPS = (640, 360), 20.0
"""What a GIF can bear: a two-bar groove is about 2 MB (our choice)."""
_DRAWN = ("a picture", "numbered pictures", "a video", "a GIF")
_MEANT_FOR = {
    **dict.fromkeys(("beat", "time"), ("a picture",)),
    **dict.fromkeys(("size", "quality", "view", "mirror", "no_score"), _DRAWN),
    "fps": ("numbered pictures", "a video", "a GIF", "motion"),
    "seconds": ("numbered pictures", "a video", "motion"),
    "click": ("a video",),
}
"""Which options say something of what."""


def picture_size(text: str) -> tuple[int, int]:
    """Width and height of a picture, from words such as 1280x720."""
    width, _, height = text.lower().partition("x")
    try:
        size = int(width), int(height)
    except ValueError:
        raise unread("a size such as 1280x720", text) from None
    if not all(16 <= side <= MAX_PIXELS for side in size):
        raise unread(f"sides of 16 to {MAX_PIXELS} pixels", text)
    return size


@dataclass(frozen=True, slots=True, kw_only=True)
class PictureOptions:
    """How it looks."""

    size: tuple[int, int] = option("WxH", "in pixels (1280x720)", picture_size, (1280, 720))
    quality: int = choice(LEVELS, "how fine (middle)", LEVELS["middle"])
    view: NamedView = choice(
        {view.name.lower(): view for view in NamedView}, "from where (shoulder)", NamedView.SHOULDER
    )
    mirror: bool = flag("left and right swapped, to learn face to face")
    no_score: bool = flag("no score below; title and beat stay")
    click: bool = flag("a video with a click under the drums")
    beat: float = option("T", "the beat that a picture shows (1)", number, 1.0, rivals="moment")
    time: float | None = option("S", "the second of the score that a picture shows", number, None, rivals="moment")


@dataclass(frozen=True, slots=True, kw_only=True)
class AnimateOptions:
    """What is made, of which score, and who plays it."""

    score: str = argument("SCORE", "a lesson, a MIDI file, a text score or a take (.capture)", str)
    out: Path = required(
        "FILE", f"the file to write: {ENDINGS}; %05d.png in a name numbers the pictures of all bars", Path
    )
    style: str = option(
        "NAME", f"{', '.join(style_names())}, {PROPOSED} (what the score itself suggests), or a file", str, "natural"
    )
    drums: DrumsOptions = group(DrumsOptions)
    drummer: str = option(
        "NAME",
        f"{', '.join(figure_names())}, or a file (the style's own, else {DEFAULT_FIGURE})",
        str,
        "",
        rivals="body",
    )
    stature: float | None = option(
        "M", "the drummer's height in metres, usual proportions", number, None, rivals="body"
    )
    fps: float = option("N", "pictures or poses a second (60)", number, 60.0)
    start_bar: int = option("A", "the first bar, from 1 (1)", whole_number, 1)
    end_bar: int | None = option("B", "the last bar (the score's)", whole_number, None)
    seconds: float | None = option("S", "no more than so many seconds", number, None)
    picture: PictureOptions = group(PictureOptions, "video and pictures")
    said: frozenset[str] = said()


def check_meant(options: AnimateOptions, made: str) -> None:
    """Raise `BadInput` for what was said and says nothing of what is made."""
    for name, kinds in _MEANT_FOR.items():
        if name in options.said and made not in kinds:
            option = f"--{name.replace('_', '-')}"
            raise BadInput(option, "", f"{options.out.name} makes {made}; this is for {', '.join(kinds)}")


def usual_of_loops(options: AnimateOptions) -> AnimateOptions:
    """The options with what a GIF can bear where nothing was said."""
    size = options.picture.size if "size" in options.said else _LOOP_SIZE
    fps = options.fps if "fps" in options.said else _LOOP_FPS
    return replace(options, fps=fps, picture=replace(options.picture, size=size))
