"""What a struck thing sounds like, as a table: tones, clouds of modes and bands of noise, each dying away.

A row's `level_db` is its energy, relative to the other rows of the recipe (so a table reads like a measured spectrum);
`t60_s` the time in which it falls by 60 dB. A stroke's hardness is 0 (a breath) … 1 (velocity 127). Softer strokes are
darker: rows above `PIVOT_HZ` lose `tilt_db` an octave, times 1 − hardness, and each row gains its own `soft_db` times
1 − hardness.
"""

from dataclasses import dataclass

PIVOT_HZ = 500.0


@dataclass(frozen=True, slots=True)
class Tone:
    """One mode of a head, a hoop or a bell; it shares in the recipe's glide."""

    freq_hz: float
    level_db: float
    t60_s: float
    soft_db: float = 0.0

    @property
    def pitch_hz(self) -> float:
        """The frequency that its tilt is reckoned at."""
        return self.freq_hz


@dataclass(frozen=True, slots=True)
class Cloud:
    """`count` inharmonic modes, spread at random between two frequencies."""

    low_hz: float
    high_hz: float
    count: int
    level_db: float
    t60_s: float
    soft_db: float = 0.0
    attack_s: float = 0.0003

    @property
    def pitch_hz(self) -> float:
        """The frequency that its tilt is reckoned at."""
        return float((self.low_hz * self.high_hz) ** 0.5)


@dataclass(frozen=True, slots=True)
class Noise:
    """A band of noise that rises within `attack_s` and dies away."""

    low_hz: float
    high_hz: float
    level_db: float
    t60_s: float
    soft_db: float = 0.0
    attack_s: float = 0.0003

    @property
    def pitch_hz(self) -> float:
        """The frequency that its tilt is reckoned at."""
        return float((self.low_hz * self.high_hz) ** 0.5)


Row = Tone | Cloud | Noise


@dataclass(frozen=True, slots=True)
class Glide:
    """A head that is struck is stretched: its tones start higher by `ratio` (at hardness 1), settle within `tau_s`."""

    ratio: float = 0.0
    tau_s: float = 0.03


@dataclass(frozen=True, slots=True)
class Recipe:
    """One sound of the kit.

    `loudness_db` of the hardest stroke, its greatest RMS over 30 ms (0 is full scale); `pan` −1 left … 1 right;
    `width` 0 a point … 1 as wide as the two loudspeakers; `room_db` the ambience's energy relative to the sound's own,
    None for none; `echoes` further bounces (delay in seconds, amplitude); `layers` the highest velocity of each layer.
    """

    rows: tuple[Row, ...]
    loudness_db: float
    layers: tuple[int, ...]
    glide: Glide = Glide()
    tilt_db: float = 2.0
    pan: float = 0.0
    width: float = 0.0
    room_db: float | None = None
    echoes: tuple[tuple[float, float], ...] = ()
