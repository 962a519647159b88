"""The rubric of an exam: criteria, what each is worth, and what earns full marks. It is shown before anybody plays.

Every criterion is a share, 0–1, of what could be earned, over all written notes: a missed note earns nothing in any of
them, so that leaving out a note that one can play never pays. Loudness counts where the music asks for it and the kit
tells it; elsewhere the others share its marks. Marks add up to 100.
"""

from dataclasses import dataclass
from enum import StrEnum

from station.scoring.matching.hit_windows import Level


class Criterion(StrEnum):
    """What is marked."""

    NOTES = "notes"
    TIME = "time"
    FLOW = "flow"
    LOUDNESS = "loudness"


@dataclass(frozen=True, slots=True)
class RubricLine:
    """A criterion: its `title`, what it is worth of 100, and in words what full marks ask for."""

    criterion: Criterion
    title: str
    worth: float
    words: str

    @property
    def worth_words(self) -> str:
        """The worth to a tenth, where it is no whole number."""
        return f"{round(self.worth, 1):g}"


@dataclass(frozen=True, slots=True)
class Rubric:
    """The lines by which a take at `level` is marked; their worth adds up to 100."""

    level: Level
    lines: tuple[RubricLine, ...]


@dataclass(frozen=True, slots=True)
class Mark:
    """What a line of the rubric came to: `share` 0–1 of its worth, and in words what was measured."""

    line: RubricLine
    share: float
    words: str

    @property
    def points(self) -> float:
        """Of 100."""
        return self.share * self.line.worth

    @property
    def points_words(self) -> str:
        """The points of those that could be earned, both to a tenth: full marks are seen to be full."""
        return f"{self.points:.1f} of {self.line.worth_words}"


@dataclass(frozen=True, slots=True)
class Marks:
    """The marks of a take, a line of the rubric each."""

    lines: tuple[Mark, ...]

    @property
    def total(self) -> float:
        """Of 100."""
        return sum(mark.points for mark in self.lines)

    @property
    def band(self) -> "Band":
        """The band that the total reaches, by whole marks as they are shown."""
        return next(band for band in BANDS if int(self.total) >= band.least)


@dataclass(frozen=True, slots=True)
class Band:
    """What a total from `least` on is called."""

    name: str
    least: int


BANDS = (Band("distinction", 90), Band("merit", 75), Band("pass", 60), Band("not yet", 0))
"""Our choice, near what examination boards print: 60 to pass, about three quarters for merit, 87–90 for distinction."""

_WORTH = {Criterion.NOTES: 40.0, Criterion.TIME: 30.0, Criterion.FLOW: 15.0, Criterion.LOUDNESS: 15.0}
"""Our choice: what is played first, then when; reading is to go on whatever happens, and loudness shapes it."""
KEPT_SHARE = 0.5
"""A bar is kept if so much of it was played: who drops out and comes back in on the next one loses one bar (our
choice)."""


def rubric_of(level: Level, asks_loudness: bool) -> Rubric:
    """The rubric at `level`; without loudness where the music or the kit has none."""
    inner, outer = level.windows.edges_ms[0], level.windows.edges_ms[-1]
    words = {
        Criterion.NOTES: ("Notes", "every written note on its piece, nothing besides"),
        Criterion.TIME: (
            "Time",
            f"every note within {inner:g} ms of where you place that piece; no marks from {outer:g} ms off",
        ),
        Criterion.FLOW: ("Flow", "every bar is played on: a slip costs its notes, stopping costs the bar"),
        Criterion.LOUDNESS: ("Loudness", "accents, normal strokes and ghosts as far apart as they are written"),
    }
    kept = [one for one in Criterion if asks_loudness or one is not Criterion.LOUDNESS]
    whole = sum(_WORTH[one] for one in kept)
    lines = (RubricLine(one, words[one][0], 100.0 * _WORTH[one] / whole, words[one][1]) for one in kept)
    return Rubric(level, tuple(lines))
