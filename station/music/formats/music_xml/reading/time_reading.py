"""The time signature of a MusicXML bar as a meter."""

import re
from math import lcm
from xml.etree.ElementTree import Element

from station.core.errors import BadInput
from station.music.tempo import MeterChange

MOST_BEATS, MOST_UNIT = 128, 128
"""Of a bar that is read (our choice: far beyond what is printed)."""
_UNITS = {str(2**k) for k in range(MOST_UNIT.bit_length())}


def meter_of(time: Element, source: str, place: str) -> MeterChange:
    """The meter of a `<time>`, at tick 0; raises `BadInput` where it is none.

    Groups (3+2 over 8) and several signatures in a row (3/8 + 2/4) are the groups of one bar in the finer unit.
    """
    beats = [(element.text or "").replace(" ", "") for element in time.findall("beats")]
    units = [(element.text or "").strip() for element in time.findall("beat-type")]
    are_sound = all(re.fullmatch(r"\d{1,3}(\+\d{1,3}){0,31}", text) for text in beats)
    if not beats or len(beats) != len(units) or not are_sound or not all(unit in _UNITS for unit in units):
        found = f"{'+'.join(beats)[:20]}/{'+'.join(units)[:20]}"
        raise BadInput(source, place, f"{found} is no time signature")
    unit = lcm(*map(int, units))
    groups = [
        int(count) * (unit // int(of)) for text, of in zip(beats, units, strict=True) for count in text.split("+")
    ]
    if not all(groups) or sum(groups) > MOST_BEATS:
        raise BadInput(source, place, f"a bar of {sum(groups)} beats")
    return MeterChange(0, sum(groups), unit, tuple(groups) if len(groups) > 1 else ())
