"""What a lesson says for all its grids, and a grid for itself and those after it: tempo, meter, beat, swing, strokes.

`TIMING` is the schema of these keys; `timing_of` puts them on top of what was said before.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import Any

from station.core.expected import either_of, expected_by, expects, list_like
from station.core.toml.schema import Fields, list_of, number, optional, said, shown, whole
from station.core.toml.toml_faults import Faults, wrong
from station.core.toml.toml_places import KeyPath
from station.core.units import PPQ
from station.drills.grid.stroke_settings import StrokeSettings, Velocities
from station.drills.grid.tab_symbols import LINE_PIECES
from station.music.grace_strokes import DRAG_RANGE_MS, FLAM_RANGE_MS, MAX_VELOCITY, MIN_VELOCITY, Graces
from station.music.swing import MAX_RATIO, MIN_RATIO, Swing
from station.music.tempo import MAX_BPM, MIN_BPM, MeterChange

MAX_BEATS = 32
UNITS = (1, 2, 4, 8, 16, 32)
MAX_METERS = 64
"""Our choice: a longer turn of meters is a piece to be written in several grids."""


@dataclass(frozen=True, slots=True)
class GridTiming:
    """What one grid hands to the next: tempo, meters, beat, swing and how strokes are struck.

    `tempo_bpm` in quarter notes a minute; `tempo_to_bpm` the tempo at which this grid arrives, None where it keeps
    its own (the next grid does not inherit it); `meters` are taken in turn, bar by bar, their ticks 0; `beat_ticks`
    is the beat that `tempo_bpm` counts in the file and that `(…)` fills; `swing_path` is where the swing is
    written. Where the file's meter or beat is wrong, `is_sure` is False up to the next meter.
    """

    tempo_bpm: float
    meters: tuple[MeterChange, ...]
    beat_ticks: int
    swing: Swing = field(default_factory=Swing)
    settings: StrokeSettings = field(default_factory=StrokeSettings)
    tempo_to_bpm: float | None = None
    swing_path: KeyPath = ("swing_ratio",)
    is_sure: bool = True

    @property
    def velocities(self) -> Velocities:
        """The velocity of each dynamic."""
        return self.settings.velocities

    @property
    def graces(self) -> Graces:
        """The grace strokes."""
        return self.settings.graces


# --- the schema -------------------------------------------------------------------------------------------------------


@expects({"type": "string", "pattern": r"^ *\d+( *\+ *\d+)* */ *\d+ *$"})
def meter(value: object) -> MeterChange:
    """A meter such as "6/8", or "3+2+2/8" with its groups; its tick is 0."""
    top, slash, unit = value.partition("/") if isinstance(value, str) else ("", "", "")
    numbers = [word.strip() for word in top.split("+")]
    if not (slash and all(map(_is_short_number, [*numbers, unit.strip()]))):
        raise wrong(f'expected a meter such as "4/4", or "3+2+2/8" with its groups, found {shown(value)}')
    groups = tuple(map(int, numbers))
    if not 1 <= sum(groups) <= MAX_BEATS or 0 in groups or int(unit) not in UNITS:
        raise wrong(f"expected a meter of 1 to {MAX_BEATS} beats of 1/1 to 1/32, such as 4/4 or 6/8")
    return MeterChange(0, sum(groups), int(unit), groups if len(groups) > 1 else ())


def _is_short_number(word: str) -> bool:
    return word.isascii() and word.isdecimal() and len(word) < 4


@expects(either_of(expected_by(meter), list_like(expected_by(meter), 1)))
def meters(value: object) -> tuple[MeterChange, ...]:
    """One meter, or a list of meters that are taken in turn, bar by bar."""
    if not isinstance(value, list):
        return (meter(value),)
    if not 1 <= len(value) <= MAX_METERS:
        raise wrong(f'expected 1 to {MAX_METERS} meters such as ["4/4", "3/4"], found {len(value)}')
    return list_of(meter, 'meters such as ["4/4", "3/4"]')(value)


@expects({"type": "string", "pattern": r"^ *\d+ */ *\d+ *$"})
def note_length(value: object) -> int:
    """Ticks of a note length such as "1/4" or "3/8"."""
    top, slash, bottom = value.partition("/") if isinstance(value, str) else ("", "", "")
    if not (slash and _is_short_number(top.strip()) and _is_short_number(bottom.strip())):
        raise wrong(f'expected a note length such as "1/4", found {shown(value)}')
    if not 1 <= int(top) <= 3 or int(bottom) not in UNITS:
        raise wrong('expected a note length such as "1/4", "1/8" or "3/8" (a dotted quarter)')
    return 4 * PPQ * int(top) // int(bottom)


_VELOCITIES: Fields = {key: optional(whole(MIN_VELOCITY, MAX_VELOCITY)) for key in ("ghost", "normal", "accent")}
DYNAMICS: Fields = {**_VELOCITIES, **{key: optional(said(_VELOCITIES)) for key in LINE_PIECES}}
GRACES: Fields = {
    "flam_ms": optional(number(*FLAM_RANGE_MS)),
    "drag_ms": optional(number(*DRAG_RANGE_MS)),
    "share": optional(number(0.1, 1)),
}
"""Wider than HUMANS' 15–40 and 40–70 ms: a teacher may ask for an open flam or a slow drag (our choice)."""

TIMING: Fields = {
    "tempo_bpm": optional(number(MIN_BPM, MAX_BPM)),
    "meter": optional(meters),
    "beat": optional(note_length),
    "swing_ratio": optional(number(MIN_RATIO, MAX_RATIO)),
    "swing_unit": optional(note_length),
    "dynamics": optional(said(DYNAMICS)),
    "graces": optional(said(GRACES)),
}


# --- reading ----------------------------------------------------------------------------------------------------------


def timing_of(values: Mapping[str, Any], before: GridTiming, faults: Faults, path: KeyPath = ()) -> GridTiming:
    """What the table at `path` says, and what was said `before` where it says nothing, or nothing that can be.

    Faults count from that table.
    """
    is_wrong = any(fault.path[:1] in (("meter",), ("beat",)) for fault in faults.noted)
    beat_ticks = before.beat_ticks if values["beat"] is None else values["beat"]
    ratio, unit = values["swing_ratio"], values["swing_unit"]
    was, changes = before.velocities, values["dynamics"] or {}
    velocities = faults.attempt(lambda _: _velocities(changes, was), changes, was, "dynamics")
    settings = StrokeSettings(velocities, replace(before.graces, **(values["graces"] or {})))
    return GridTiming(
        _tempo(values, "tempo_bpm", beat_ticks, faults) or before.tempo_bpm,
        before.meters if values["meter"] is None else values["meter"],
        beat_ticks,
        Swing(before.swing.ratio if ratio is None else ratio, before.swing.unit_ticks if unit is None else unit),
        settings,
        _tempo(values, "tempo_to_bpm", beat_ticks, faults),
        before.swing_path if ratio is unit is None else (*path, "swing_ratio" if unit is None else "swing_unit"),
        not is_wrong and (before.is_sure or values["meter"] is not None),
    )


def _tempo(values: Mapping[str, Any], key: str, beat_ticks: int, faults: Faults) -> float | None:
    """Quarter notes a minute of the tempo that stands at `key` in beats; None where it stands there not, or wrong."""
    beats = values.get(key)
    if beats is None:
        return None
    asked = float(beats) * beat_ticks / PPQ
    if MIN_BPM <= asked <= MAX_BPM:
        return asked
    faults.add((key,), f"{asked:g} quarter notes a minute; expected {MIN_BPM:g} to {MAX_BPM:g}")
    return None


def _velocities(changes: Mapping[str, Any], before: Velocities) -> Velocities:
    """The usual velocities, and those of pieces that have some of their own, with these changes.

    What a piece was given of its own it keeps when the usual ones change.
    """
    usual = _rising(before.usual, changes)
    own = dict(before.of_piece)
    for key in LINE_PIECES:
        if key in changes:
            piece = LINE_PIECES[key]
            own[piece] = _rising(own.get(piece, usual), changes[key], key)
    return Velocities(usual, MappingProxyType(own))


def _rising(before: Sequence[int], changes: Mapping[str, Any], *path: str) -> tuple[int, int, int]:
    """Ghost, normal and accent velocities, as `before` but for the changes of the table at `path`."""
    ghost, normal, accent = (changes.get(key, was) for key, was in zip(_VELOCITIES, before, strict=True))
    if not ghost <= normal <= accent:
        said_first = next(key for key in changes if key in _VELOCITIES)
        text = f"ghost {ghost}, normal {normal}, accent {accent}: expected rising velocities"
        raise wrong(text, *path, said_first)
    return ghost, normal, accent
