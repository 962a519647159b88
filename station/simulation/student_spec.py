"""What a virtual student is like, as a line of text: `pro,seed=3,bias_ms=-8,fault=late_kick:20`.

Grammar: parts joined by commas, in any order. A part is a named player (at most one), `key=value` (each key once) or
`fault=NAME:SIZE` (each fault once). A key overrides the player's own value. What nobody says is 0: a bare `seed=1`
plays exactly what is written. `bias_ms` and `sd_ms` are of the asynchronies (played − written, **negative is early**).

Percentages of the interval, misses and the rest of the named players follow HUMANS ("Timing", "Velocity and ears")
where it has figures (named there `mem`, so ours to change), else they are our choice.
"""

import math
from dataclasses import dataclass, replace
from difflib import get_close_matches
from typing import Any, TypeVar

from station.core.errors import BadInput

SOURCE = "virtual student"
Said = TypeVar("Said")


@dataclass(frozen=True, slots=True)
class FaultKind:
    """A habit that can be planted: the unit of its SIZE, the largest SIZE (the smallest is above 0), what it does."""

    unit: str
    largest: float
    about: str


_LARGEST_SHIFT_MS = 150.0
_LARGEST_DB = 24.0
"""Our choice: a stroke further off, or softer than a tenth of the written velocity's level, is another stroke."""

_LARGEST_GRAB_MS = 1000.0
"""Our choice: what is grabbed so late was let ring."""

FAULTS: dict[str, FaultKind] = {
    "late_kick": FaultKind("ms", _LARGEST_SHIFT_MS, "every kick comes SIZE later"),
    "rush_fills": FaultKind("ms", _LARGEST_SHIFT_MS, "each fill runs ahead, more and more, by SIZE on average"),
    "drag_slow": FaultKind("ms", _LARGEST_SHIFT_MS, "a stroke after a long wait, or at a slow tempo, comes SIZE later"),
    "weak_left": FaultKind("dB", _LARGEST_DB, "strokes of the left hand are SIZE softer"),
    "loud_ghosts": FaultKind("dB", _LARGEST_DB, "ghost notes are SIZE louder"),
    "flat_accents": FaultKind("dB", _LARGEST_DB, "accents are SIZE softer"),
    "straight_swing": FaultKind("ratio", 2.5, "swung offbeats are played at the written long:short ratio − SIZE"),
    "uneven_doubles": FaultKind("ms", _LARGEST_SHIFT_MS, "the second stroke of a double comes SIZE early"),
    "wide_flams": FaultKind("ms", _LARGEST_SHIFT_MS, "grace strokes come SIZE earlier before their main stroke"),
    "slow_hihat_foot": FaultKind("ms", _LARGEST_SHIFT_MS, "every chick of the hi-hat foot comes SIZE later"),
    "open_hats": FaultKind("openness", 1.0, "the hi-hat is SIZE open where it is written closed"),
    "late_grabs": FaultKind("ms", _LARGEST_GRAB_MS, "cymbals ring SIZE longer than written before they are grabbed"),
    "short_buzz": FaultKind("ms", _LARGEST_SHIFT_MS, "buzz rolls are played bounce by bounce, and end SIZE early"),
}


@dataclass(frozen=True, slots=True)
class PlantedFault:
    """A planted habit: `name` of `FAULTS`, `size` in that fault's unit, > 0."""

    name: str
    size: float


@dataclass(frozen=True, slots=True)
class StudentSpec:
    """A virtual student.

    `sd_ms` is the stationary SD of the asynchronies; where it is None, it is `sd_interval_pct` percent of the usual
    interval between strokes. `miss_pct` and `extra_pct` are per written stroke, `wrong_piece_pct` per stroke of a hand
    (a foot has no other piece). A velocity's SD is `velocity_sd` steps or, where that is None, `velocity_cv_pct`
    percent of the velocity. `drift_pct`: how much the tempo sways, see `student_timing.sway_s`.
    """

    seed: int = 1
    bias_ms: float = 0.0
    sd_ms: float | None = 0.0
    drift_pct: float = 0.0
    miss_pct: float = 0.0
    extra_pct: float = 0.0
    wrong_piece_pct: float = 0.0
    velocity_sd: float | None = 0.0
    sd_interval_pct: float = 0.0
    velocity_cv_pct: float = 0.0
    player: str = ""
    faults: tuple[PlantedFault, ...] = ()

    def text(self) -> str:
        """The specification that reads back as this student: the seed, and what is not the player's own."""
        base = PLAYERS[self.player] if self.player else StudentSpec()
        parts = [self.player] if self.player else []
        said = [key for key in KEYS if key == "seed" or getattr(self, key) != getattr(base, key)]
        parts += [f"{key}={_plain(getattr(self, key))}" for key in said]
        return ",".join(parts + [f"fault={fault.name}:{_plain(fault.size)}" for fault in self.faults])


def _plain(number: float) -> str:
    """`number` in as few characters as read back alike."""
    short = f"{number:g}"
    return short if isinstance(number, float) and float(short) == number else repr(number)


PLAYERS: dict[str, StudentSpec] = {
    "beginner": StudentSpec(
        bias_ms=-15.0,
        sd_ms=None,
        miss_pct=6.0,
        extra_pct=4.0,
        wrong_piece_pct=2.0,
        velocity_sd=None,
        sd_interval_pct=8.0,
        velocity_cv_pct=25.0,
        player="beginner",
    ),
    "intermediate": StudentSpec(
        bias_ms=-8.0,
        sd_ms=None,
        miss_pct=2.0,
        extra_pct=1.5,
        wrong_piece_pct=0.5,
        velocity_sd=None,
        sd_interval_pct=4.5,
        velocity_cv_pct=13.5,
        player="intermediate",
    ),
    "pro": StudentSpec(
        bias_ms=-5.0,
        sd_ms=None,
        miss_pct=0.2,
        extra_pct=0.1,
        velocity_sd=None,
        sd_interval_pct=2.5,
        velocity_cv_pct=8.0,
        player="pro",
    ),
}


@dataclass(frozen=True, slots=True)
class Key:
    """What may stand behind `key=`: a number in [`low`, `high`] of `unit`; whole for the seed."""

    low: float
    high: float
    unit: str
    whole: bool = False


_PERCENT = Key(0, 100, "percent")
KEYS: dict[str, Key] = {
    "seed": Key(0, 2**32 - 1, "whole number", whole=True),
    "bias_ms": Key(-500, 500, "ms"),
    "sd_ms": Key(0, 200, "ms"),
    "drift_pct": Key(0, 20, "percent"),
    "miss_pct": _PERCENT,
    "extra_pct": _PERCENT,
    "wrong_piece_pct": _PERCENT,
    "velocity_sd": Key(0, 60, "velocity steps"),
}
"""Ranges are our choice, wide enough for the hostile learners of TEACHING (100 ms of latency) and every benchmark."""


def parse_spec(text: str) -> StudentSpec:
    """The student that `text` describes; raises `BadInput` that names the column, the fault and what was expected."""
    parts = _parts(text)
    named = [(at, part) for at, part in parts if "=" not in part]
    if len(named) > 1:
        raise _bad(named[1][0], f"{named[1][1]}: a second player; {named[0][1]} was named before")
    spec = _player(*named[0]) if named else StudentSpec()
    values: dict[str, Any] = {}
    faults: dict[str, PlantedFault] = {}
    for at, part in parts:
        key, equals, value = part.partition("=")
        if equals and key == "fault":
            fault = _fault(at + len("fault="), value)
            _once(at, fault.name, faults)[fault.name] = fault
        elif equals:
            _once(at, key, values)[key] = _value(at, key, value)
    spec = replace(spec, faults=tuple(faults.values()), **values)
    if spec.miss_pct + spec.wrong_piece_pct > _PERCENT.high:
        raise _bad(1, "miss_pct and wrong_piece_pct together are more than 100 percent")
    return spec


def _once(at: int, name: str, said: dict[str, Said]) -> dict[str, Said]:
    """`said`, in which `name` is not yet."""
    if name in said:
        raise _bad(at, f"{name} is said twice")
    return said


def _parts(text: str) -> list[tuple[int, str]]:
    """Every part with its column, from 1."""
    found, at = [], 1
    for raw in text.split(","):
        part = raw.strip()
        column = at + len(raw) - len(raw.lstrip())
        if not part:
            raise _bad(column, f"nothing here; expected key=value with a key of {_listed(KEYS)}, fault, or a player")
        found.append((column, part))
        at += len(raw) + 1
    return found


def _player(at: int, name: str) -> StudentSpec:
    if name not in PLAYERS:
        raise _bad(
            at, f"{name}: expected key=value or a player of {_listed(PLAYERS)}{_nearest(name, [*PLAYERS, *KEYS])}"
        )
    return PLAYERS[name]


def _value(at: int, key: str, text: str) -> float:
    if key not in KEYS:
        raise _bad(at, f"{key}: no such key; expected {_listed(KEYS)} or fault{_nearest(key, [*KEYS, 'fault'])}")
    kind = KEYS[key]
    return _number(at + len(key) + 1, text, kind, f"{key}={text}")


def _fault(at: int, text: str) -> PlantedFault:
    name, colon, size = text.partition(":")
    if name not in FAULTS:
        raise _bad(at, f"{name}: no such fault; expected {_listed(FAULTS)}{_nearest(name, list(FAULTS))}")
    kind = FAULTS[name]
    if not colon:
        raise _bad(at, f"{name}: expected {name}:SIZE with SIZE in {kind.unit}")
    number = _number(at + len(name) + 1, size, Key(0, kind.largest, kind.unit), f"{name}:{size}")
    if number == 0:
        raise _bad(at + len(name) + 1, f"{name}:{size}: expected a SIZE above 0 {kind.unit}")
    return PlantedFault(name, number)


def _number(at: int, text: str, kind: Key, part: str) -> float:
    what = f"a {kind.unit}" if kind.whole else f"{kind.unit},"
    limits = f"expected {what} from {_plain(kind.low)} to {_plain(kind.high)}"
    try:
        number = int(text) if kind.whole else float(text)
    except ValueError:
        raise _bad(at, f"{part}: {limits}") from None
    if not (math.isfinite(number) and kind.low <= number <= kind.high):
        raise _bad(at, f"{part}: {limits}")
    return number


def _bad(column: int, fault: str) -> BadInput:
    return BadInput(SOURCE, f"column {column}", fault)


def _listed(names: dict[str, FaultKind] | dict[str, StudentSpec] | dict[str, Key]) -> str:
    return ", ".join(names)


def _nearest(name: str, known: list[str]) -> str:
    near = [word for word in known if word.startswith(name)] or get_close_matches(name, known, 1)
    return f" (did you mean {near[0]}?)" if near else ""
