"""What cannot be told, said as such: one entry a matter, with how many strokes it concerns and why."""

from dataclasses import dataclass

import numpy as np

from station.scoring.analysis.technique.swallowed_notes import SwallowedNotes
from station.scoring.analysis.technique.technique import Technique


@dataclass(frozen=True, slots=True)
class CannotTell:
    """`count` strokes, rolls … of which `what` cannot be told, and why; `judged`: else it would have been scored."""

    what: str
    count: int
    why: str
    judged: bool = True


def cannot_tell(craft: Technique, untold: np.ndarray[tuple[int, ...], np.dtype[np.uint8]]) -> tuple[CannotTell, ...]:
    """All that the kit or the data leave open; `untold` (n,) of the notes."""
    said = [
        CannotTell(what, int((untold == kind).sum()), why)
        for kind, what, why in (
            (SwallowedNotes.THRESHOLD, "whether ghost notes were played", "they are written below the pad's threshold"),
            (SwallowedNotes.MASK, "whether second strokes were played", "the pad hears none so soon after the first"),
        )
    ]
    if craft.buzz_rolls is not None and not craft.buzz_rolls.tells_bounces:
        said.append(CannotTell("how buzz rolls went on", craft.buzz_rolls.heard, "the kit sent one hit for each"))
    for found in craft.ornaments.values():
        if found.hand_order is None:
            said.append(CannotTell("which hand led", found.heard, "nothing says which stick struck", False))
            break
    if craft.hats is not None:
        unsaid = craft.hats.matched - craft.hats.judged
        said.append(CannotTell("how open the hi-hat was", unsaid, "the kit does not say it finely enough"))
    if craft.chokes is not None:
        unsaid = craft.chokes.matched - craft.chokes.judged
        said.append(CannotTell("whether cymbals were grabbed", unsaid, "the kit sent no choke at all"))
    if craft.keeper.cannot_tell is not None:
        said.append(CannotTell("clock from hand", craft.keeper.strokes, craft.keeper.cannot_tell.value, False))
    return tuple(one for one in said if one.count)
