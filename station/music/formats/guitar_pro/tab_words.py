"""What Guitar Pro's words and figures mean, the same in all its formats: directions, feels, tempos and meters."""

from collections.abc import Iterable, Iterator, Mapping
from types import MappingProxyType
from typing import Any

from station.core.errors import BadInput
from station.core.units import PPQ
from station.music.formats.guitar_pro.tab_song import (
    FASTEST_TAB_BPM,
    MOST_METER_BEATS,
    SLOWEST_TAB_BPM,
    TabBeat,
)
from station.music.formats.playing_order import AL_FINE, TO_THE_END, BarSigns
from station.music.swing import TRIPLETS, Swing
from station.music.tempo import METER_UNITS, MeterChange, TempoChange

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

_CODA, _DOUBLE_CODA, _SEGNO, _SEGNO_SEGNO = "coda", "doublecoda", "segno", "segnosegno"
_FROM: Mapping[str, Mapping[str, Any]] = {
    "dacapo": {"da_capo": True},
    "dasegno": {"dal_segno": _SEGNO},
    "dasegnosegno": {"dal_segno": _SEGNO_SEGNO},
}
_UNTIL = {"": TO_THE_END, "alcoda": _CODA, "aldoublecoda": _DOUBLE_CODA, "alfine": AL_FINE}
DIRECTIONS: Mapping[str, Mapping[str, Any]] = MappingProxyType(
    {
        **{name: {"coda": name} for name in (_CODA, _DOUBLE_CODA)},
        **{name: {"segno": name} for name in (_SEGNO, _SEGNO_SEGNO)},
        "fine": {"fine": True},
        **{a + b: {**jump, "until": until} for a, jump in _FROM.items() for b, until in _UNTIL.items()},
        "dacoda": {"to_coda": _CODA},
        "dadoublecoda": {"to_coda": _DOUBLE_CODA},
    }
)
"""Targets and jumps by their names in small letters without spaces -> what `BarSigns` has of them."""


def signs_of(directions: Iterable[str], **repeats: Any) -> BarSigns:  # noqa: ANN401 - the fields of `BarSigns`
    """What stands at a bar, of the names of its directions and what is known of its repeats."""
    said: dict[str, Any] = {}
    for name in directions:
        said |= DIRECTIONS.get("".join(name.split()).lower(), {})
    return BarSigns(**said, **repeats)


def bpm_to_us(bpm: float, source: str, bar: int) -> int:
    """µs a quarter note at `bpm`; raises `BadInput` at `bar` (from 0) where no music is so fast or slow."""
    if not SLOWEST_TAB_BPM <= bpm <= FASTEST_TAB_BPM:
        raise BadInput(source, f"bar {bar + 1}", f"a tempo of {bpm:g} quarter notes a minute")
    return TempoChange.from_bpm(0, bpm).us_per_quarter


def checked_meter(beats: int, unit: int, source: str, bar: int) -> MeterChange:
    """The meter; raises `BadInput` at `bar` (from 0) for what is none."""
    if not 1 <= beats <= MOST_METER_BEATS or unit not in METER_UNITS:
        raise BadInput(source, f"bar {bar + 1}", f"a meter of {beats}/{unit}")
    return MeterChange(0, beats, unit)


def within(beats: Iterable[TabBeat], meter: MeterChange) -> Iterator[TabBeat]:
    """The beats that begin within the bar: what a file has beyond its end is never heard."""
    return (beat for beat in beats if 0 <= beat.tick < meter.bar_ticks)
