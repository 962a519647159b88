"""What stands by a score's notes, whoever shows it: the names of its sections, the beat that tempi count, its cues."""

from collections.abc import Iterable
from dataclasses import dataclass

from station.core.units import PPQ
from station.drills.lesson import BarCue, Section
from station.music.drum_part import PartSection
from station.render.snapshot import BarNumbers, TakeSpelling

Names = tuple[tuple[int, str], ...]
"""A bar, from 0, and the name of what begins with it."""


@dataclass(frozen=True, slots=True)
class ScoreWords:
    """What a lesson or a part says beside its notes: its `sections`, the beat that is counted, its teacher's `cues`.

    `spelling` is how a take is written.
    """

    sections: tuple[Section | PartSection, ...] = ()
    beat_ticks: int = PPQ
    cues: tuple[BarCue, ...] = ()
    spelling: TakeSpelling | None = None


NO_WORDS = ScoreWords()


def bar_numbers(
    sections: Iterable[Section | PartSection], first_bar: int, bar_count: int, passes: int | None = 1
) -> BarNumbers:
    """How bars are numbered where `bar_count` of them from `first_bar` on are played `passes` times, with their names.

    None: for ever. Whatever follows them is numbered on.
    """
    return BarNumbers(first_bar, bar_count, passes, section_names(sections, first_bar, bar_count))


def section_names(sections: Iterable[Section | PartSection], first_bar: int, bar_count: int) -> Names:
    """The sections that begin within `bar_count` bars from `first_bar` on, from 0, by the bar from there."""
    within = range(first_bar, first_bar + bar_count)
    return tuple((s.first_bar - first_bar, s.name) for s in sections if s.name and s.first_bar in within)
