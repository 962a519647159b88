"""A drum part as a file has it: its score, and the words beside the notes.

Formats read it and write it; `drills` makes a lesson of it and one of a lesson.
"""

from dataclasses import dataclass, field

from station.music.score import Score
from station.music.swing import Swing


@dataclass(frozen=True, slots=True)
class PartSection:
    """A part with a name, such as "verse": bars `first_bar` to `last_bar`, from 0, inclusive, as they are played."""

    name: str
    first_bar: int
    last_bar: int


@dataclass(frozen=True, slots=True, eq=False)
class DrumPart:
    """One drummer's part.

    `score` has all repeats written out, its title, and of every stroke as much as the file says: dynamic and velocity,
    ornament with its grace strokes (`grace_strokes`), limb, openness. `said_beat_ticks` is the beat that the file
    says is counted, None where it says none. `swing` is how the whole part swings: its notes lie where they sound, and
    those that notation writes straight have their `swing_ticks`. `sections` cover no bar twice. `is_played`: its times
    are as somebody played them, and on no grid. `is_meter_said`: the file says its meter; else its 4/4 is only what is
    usual. `lost` says, a line each, what the file has and this value has not.
    """

    score: Score
    author: str = ""
    about: str = ""
    said_beat_ticks: int | None = None
    swing: Swing = field(default_factory=Swing)
    sections: tuple[PartSection, ...] = ()
    is_played: bool = False
    is_meter_said: bool = True
    lost: tuple[str, ...] = ()

    @property
    def beat_ticks(self) -> int:
        """The beat that is counted: what the file says, else what is usual in the first meter."""
        usual = self.score.tempo_map.meter_at(0).usual_beat_ticks
        return usual if self.said_beat_ticks is None else self.said_beat_ticks
