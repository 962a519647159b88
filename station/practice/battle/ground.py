"""What both drummers of a battle stand on: one tempo, one meter, one feel, in bars that never stop.

Battle time is ns from the first downbeat after the count-in; turn time ns from a turn's own first downbeat. Both are
score time at the ground's tempo, so that bar `n` begins at `n * bar_ns` to within the rounding of a tick.
"""

from dataclasses import dataclass
from enum import Enum
from functools import cached_property

from station.core.errors import BadInput
from station.core.units import PPQ
from station.music.tempo import MeterChange, TempoChange, TempoMap
from station.practice.session.plan import MAX_TEMPO_BPM, MIN_TEMPO_BPM

MOST_LETTERS = 40
"""Of a style (our choice: one word, as in a message to another station)."""


class Feel(Enum):
    """How a beat is mostly divided; single beats of a phrase may be divided otherwise."""

    STRAIGHT = "straight"
    TRIPLET = "triplet"


@dataclass(frozen=True)
class Ground:
    """`tempo_bpm` counts quarter notes; bars have `beats` of 1/`unit`; `style` is a word such as "rock" or "jazz".

    Raises `BadInput` for a tempo at which nobody plays, and for a style that cannot be shown.
    """

    tempo_bpm: float = 100.0
    beats: int = 4
    unit: int = 4
    feel: Feel = Feel.STRAIGHT
    style: str = "rock"

    def __post_init__(self) -> None:
        if not MIN_TEMPO_BPM <= self.tempo_bpm <= MAX_TEMPO_BPM:  # also refuses NaN
            limits = f"expected {MIN_TEMPO_BPM:g} to {MAX_TEMPO_BPM:g} beats a minute"
            raise BadInput("tempo", f"{self.tempo_bpm:g}", limits)
        if len(self.style) > MOST_LETTERS or not self.style.isprintable():
            raise BadInput("style", self.style, f"expected a word of at most {MOST_LETTERS} letters that can be seen")

    @cached_property
    def tempo_map(self) -> TempoMap:
        """The tempo and meter, from tick 0 on."""
        return TempoMap.build([TempoChange.from_bpm(0, self.tempo_bpm)], [self.meter])

    @property
    def meter(self) -> MeterChange:
        """The meter, from tick 0 on."""
        return MeterChange(0, self.beats, self.unit)

    @property
    def bar_ticks(self) -> int:
        """Length of a bar."""
        return self.meter.bar_ticks

    @property
    def beat_ticks(self) -> int:
        """The beat that is counted: a dotted quarter in 6/8 and its like, else a quarter."""
        return self.meter.usual_beat_ticks

    @property
    def beats_a_bar(self) -> int:
        """Counted beats in a bar; a last one may be short, as in 7/8."""
        return -(-self.bar_ticks // self.beat_ticks)

    @property
    def beats_a_minute(self) -> float:
        """The tempo in the beat that is counted."""
        return self.tempo_bpm * PPQ / self.beat_ticks

    def ns_of_bars(self, bars: int) -> int:
        """How long so many bars last."""
        return int(self.tempo_map.ns_at(bars * self.bar_ticks))
