"""What a teacher's cues come to at a bar: the words that stand there, the view and the style."""

from collections.abc import Sequence
from dataclasses import dataclass

from station.core.named_view import NamedView
from station.drills.lesson import SAY_BARS, BarCue


@dataclass(frozen=True, slots=True)
class Direction:
    """`say` the words that stand, empty for none; `view` from where is looked and `style`, None where nobody says."""

    say: str = ""
    view: NamedView | None = None
    style: str | None = None


NO_DIRECTION = Direction()


def direction_at(cues: Sequence[BarCue], bar: int) -> Direction:
    """What holds in `bar`, from 0; `cues` are in the order of their bars.

    Words stand for `SAY_BARS`, or until others follow; a view and a style until another cue changes them.
    """
    before = [cue for cue in cues if cue.bar <= bar]
    spoken = next((cue for cue in reversed(before) if cue.say), None)
    camera = next((cue.camera for cue in reversed(before) if cue.camera), "")
    return Direction(
        say=spoken.say if spoken is not None and bar < spoken.bar + SAY_BARS else "",
        view=NamedView[camera.upper()] if camera else None,
        style=next((cue.style for cue in reversed(before) if cue.style), None),
    )
