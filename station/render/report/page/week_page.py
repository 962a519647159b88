"""What the page about a week says, to parents who may know no music; made by `station.scenes.report.week_facts`."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class WeekDay:
    """A day: its `name`, `minutes` of playing (0: less than half a minute, or nothing), and whether it `is_ahead`."""

    name: str
    minutes: int
    was_played: bool
    is_ahead: bool = False


@dataclass(frozen=True, slots=True)
class TeachersNote:
    """What a teacher wrote: who, when, and the lines."""

    teacher: str
    when: str
    lines: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class WeekPage:
    """A week of one student.

    `headline` has the days and the minutes in all, `kind` a second sentence; `days` are seven from Monday on, none
    where nothing was played. `played` is what was practised and how long, `better` what surely got better, else
    `better_words` why nothing is said; `ahead` what comes next; `streak` the weeks before; `foot` small print.
    """

    student: str
    when: str
    headline: str
    kind: str
    days: tuple[WeekDay, ...]
    played: tuple[tuple[str, str], ...]
    better: tuple[str, ...]
    better_words: str
    notes: tuple[TeachersNote, ...]
    ahead: tuple[str, ...]
    streak: str
    foot: tuple[str, ...]

    @property
    def title(self) -> str:
        """What the page is called."""
        return f"{self.student}'s week at the drums"
