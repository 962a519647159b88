"""What Guitar Pro's words and figures mean, the same in all its formats: directions, feels, tempos and meters."""

from collections.abc import Iterable, Iterator, Mapping
from types import MappingProxyType

from station.core.errors import BadInput
from station.core.units import PPQ
from station.music.formats.guitar_pro.tab_song import (
    FASTEST_TAB_BPM,
    METER_UNITS,
    MOST_METER_BEATS,
    SLOWEST_TAB_BPM,
    Jump,
    Sign,
    TabBeat,
)
from station.music.swing import TRIPLETS, Swing
from station.music.tempo import MeterChange

_US_PER_MINUTE = 60_000_000
_DOTTED = 3.0
_8TH, _16TH = PPQ // 2, PPQ // 4

STRAIGHT_FEEL = Swing()
FEEL_OF: Mapping[str, Swing] = MappingProxyType(
    {
        "triplet8th": Swing(TRIPLETS, _8TH),
        "triplet16th": Swing(TRIPLETS, _16TH),
        "dotted8th": Swing(_DOTTED, _8TH),
        "dotted16th": Swing(_DOTTED, _16TH),
        "scottish8th": Swing(1 / _DOTTED, _8TH),
        "scottish16th": Swing(1 / _DOTTED, _16TH),
    }
)
"""Guitar Pro's feels by their names in small letters: long-short, and the Scottish snap, short-long."""

SIGN_OF: Mapping[str, Sign] = MappingProxyType(
    {
        "coda": Sign.CODA,
        "doublecoda": Sign.DOUBLE_CODA,
        "segno": Sign.SEGNO,
        "segnosegno": Sign.SEGNO_SEGNO,
        "fine": Sign.FINE,
    }
)
_FROM = {"dacapo": None, "dasegno": Sign.SEGNO, "dasegnosegno": Sign.SEGNO_SEGNO}
_UNTIL = {"": None, "alcoda": Sign.CODA, "aldoublecoda": Sign.DOUBLE_CODA, "alfine": Sign.FINE}
JUMP_OF: Mapping[str, Jump] = MappingProxyType(
    {
        **{start + end: Jump(target, until) for start, target in _FROM.items() for end, until in _UNTIL.items()},
        "dacoda": Jump(Sign.CODA, is_to_coda=True),
        "dadoublecoda": Jump(Sign.DOUBLE_CODA, is_to_coda=True),
    }
)
"""Directions by their names in small letters without spaces; `.gp` has the same names."""


def bpm_to_us(bpm: float, source: str, bar: int) -> int:
    """µs a quarter note at `bpm`; raises `BadInput` at `bar` (from 0) where no music is so fast or slow."""
    if not SLOWEST_TAB_BPM <= bpm <= FASTEST_TAB_BPM:
        raise BadInput(source, f"bar {bar + 1}", f"a tempo of {bpm:g} quarter notes a minute")
    return round(_US_PER_MINUTE / bpm)


def checked_meter(beats: int, unit: int, source: str, bar: int) -> MeterChange:
    """The meter; raises `BadInput` at `bar` (from 0) for what is none."""
    if not 1 <= beats <= MOST_METER_BEATS or unit not in METER_UNITS:
        raise BadInput(source, f"bar {bar + 1}", f"a meter of {beats}/{unit}")
    return MeterChange(0, beats, unit)


def within(beats: Iterable[TabBeat], meter: MeterChange) -> Iterator[TabBeat]:
    """The beats that begin within the bar: what a file has beyond its end is never heard."""
    return (beat for beat in beats if 0 <= beat.tick < meter.bar_ticks)
