"""Where sections with a name begin within some bars: what folds go by, on a sheet and on the screen."""

from collections.abc import Iterable

from station.drills.lesson import Section
from station.music.drum_part import PartSection

Names = tuple[tuple[int, str], ...]
"""A bar, from 0, and the name of what begins with it."""


def section_names(sections: Iterable[Section | PartSection], first_bar: int, bar_count: int) -> Names:
    """The sections that begin within `bar_count` bars from `first_bar` on, from 0, by the bar from there."""
    within = range(first_bar, first_bar + bar_count)
    return tuple((s.first_bar - first_bar, s.name) for s in sections if s.name and s.first_bar in within)
