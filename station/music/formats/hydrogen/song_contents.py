"""What a song or a pattern of Hydrogen's holds, as plain values in Hydrogen's own ticks.

A quarter note has 48 ticks. A song plays its columns one after the other: in each sound all patterns of the column,
from its start, as long as the longest lasts. A note lies at `position`, and sounds `lead_lag` × 5 ticks later; swing
delays what lies on the second and fourth sixteenth of a beat by up to half a sixteenth.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

from station.core.units import PPQ

TICKS_PER_QUARTER = 48
WHOLE_NOTE = 4 * TICKS_PER_QUARTER
"""The size of a 4/4 bar, and of a column without patterns."""
SCORE_TICKS = PPQ // TICKS_PER_QUARTER
"""Score ticks in one of Hydrogen's."""
LEAD_LAG_TICKS = 5
"""What a lead or lag of 1 is (AudioEngine::getLeadLagInTicks)."""
SIXTEENTH = TICKS_PER_QUARTER // 4
SWING_TICKS = SIXTEENTH // 2
"""By how much a swing factor of 1 delays (Note::swing: MAX_NOTES / 32)."""
FULL_VELOCITY = 127
DEFAULT_BPM, LEAST_BPM, MOST_BPM = 120.0, 10.0, 400.0
ENTIRE_SAMPLE = -1
"""The length of a note that rings."""


@dataclass(frozen=True, slots=True)
class PatternNote:
    """A note of the instrument with the id `instrument`, or of the `kind` (newer patterns); velocity 0–1.

    `is_stop` marks a note that silences its instrument; `length` in ticks, or `ENTIRE_SAMPLE`.
    """

    position: int
    instrument: int
    velocity: float = 0.8
    lead_lag: float = 0.0
    probability: float = 1.0
    kind: str = ""
    length: int = ENTIRE_SAMPLE
    is_stop: bool = False


@dataclass(frozen=True, slots=True)
class Pattern:
    """So many ticks of notes; `denominator` is the unit of its meter."""

    name: str
    size: int
    denominator: int
    notes: tuple[PatternNote, ...]


@dataclass(frozen=True, slots=True)
class Instrument:
    """An instrument of a song's kit; `kind` is its type in newer kits, `midi_note` None where the file has none."""

    id: int
    name: str
    kind: str = ""
    midi_note: int | None = None
    is_silent: bool = False


@dataclass(frozen=True, slots=True)
class HydrogenSong:
    """A song; a pattern alone is one of a single column.

    `columns` name the patterns of each; `virtual` are patterns that sound with another. `tempos` and `tags` are what
    begins with a column. `automation` has points (column, factor) of the velocities.
    """

    name: str = ""
    author: str = ""
    about: str = ""
    bpm: float = DEFAULT_BPM
    swing_factor: float = 0.0
    instruments: tuple[Instrument, ...] = ()
    patterns: tuple[Pattern, ...] = ()
    columns: tuple[tuple[str, ...], ...] = ()
    virtual: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    tempos: tuple[tuple[int, float], ...] = ()
    tags: tuple[tuple[int, str], ...] = ()
    automation: tuple[tuple[float, float], ...] = ()
    lost: tuple[str, ...] = ()
