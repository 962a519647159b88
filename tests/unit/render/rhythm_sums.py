"""Whether the values of a voice add up, for tests of the spelling."""

from collections.abc import Sequence

from station.render.notation.spelling.note_values import BeatGroup


def gaps(groups: Sequence[BeatGroup], length: int) -> list[tuple[int, int]]:
    """Where the values of a voice do not follow each other to the bar's end: from and to which tick."""
    found, at = list[tuple[int, int]](), 0.0
    for group in groups:
        for value in group.values:
            if abs(value.tick - at) > 2:
                found.append((round(at), value.tick))
            at += float(group.time_of(value))
    return found if abs(at - length) <= 2 else [*found, (round(at), length)]
