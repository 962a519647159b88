"""Who demonstrates: a body and a manner, as the user has chosen them."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import TypeVar

from station.core.errors import BadInput
from station.core.settings import Settings
from station.drills.lesson import BarCue
from station.motion.kinematics.figure import DEFAULT_FIGURE, Figure, figure_of, load_figure
from station.motion.style.automation_lanes import in_turn
from station.motion.style.style import ANYBODY, Style
from station.motion.style.style_file import load_style

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Demonstrator:
    """A body, and how it moves; the lanes of `style` count the lesson's bars."""

    figure: Figure = field(default_factory=figure_of)
    style: Style = field(default_factory=Style)


def as_taught(style: Style, cues: Sequence[BarCue]) -> Style:
    """`style` where the cues of a lesson say nothing, theirs from their bars on; its lanes count the lesson's bars.

    Raises `BadInput` for a style that there is not.
    """
    return in_turn(style, [(cue.bar + 1.0, load_style(cue.style)) for cue in cues if cue.style])


def demonstrator_of(settings: Settings, notify: Callable[[str], None]) -> Demonstrator:
    """The one of the settings; `notify` hears what cannot be loaded, in whose place the natural one is."""
    natural = Demonstrator()
    style = _or(natural.style, lambda: load_style(settings.style), notify)
    return Demonstrator(_or(natural.figure, lambda: figure_for(style, settings.figure), notify), style)


def figure_for(style: Style, wanted: str) -> Figure:
    """The drummer that is `wanted`, by name or file; if none, the style's own. Raises `BadInput`."""
    own = DEFAULT_FIGURE if style.drummer == ANYBODY else style.drummer
    return load_figure(wanted or own)


def _or(default: T, load: Callable[[], T], notify: Callable[[str], None]) -> T:
    try:
        return load()
    except BadInput as fault:
        notify(str(fault))
        return default
