"""A drum chart as the games have it: notes in lanes, at the ticks of the file.

Conventions: ticks are the file's, `resolution` of them a quarter note. The first tick of a span belongs to it, its end
does not.
"""

from bisect import bisect_right
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from enum import IntEnum

from station.core.errors import BadInput
from station.core.pieces import Dynamic, Limb, Piece

MOST_QUARTERS = 20_000
"""Where the last note may stand (our choice: five hours at 66)."""
MOST_CHART_NOTES = 40_000
"""Our choice: an hour of 11 a second; 30 µs each to read."""
MOST_SECTIONS = 2_000
"""Our choice: a name every five seconds of three hours."""
MOST_CHANGES = MOST_QUARTERS
"""Of tempo, and of meter: one on every quarter note of the longest chart (our choice; real charts have a thousand)."""
MOST_RESOLUTION = 1_000_000
"""Ticks a quarter note (our choice: games use 192 or 480)."""


class Lane(IntEnum):
    """A lane of the highway by its number in `.chart`; ORANGE_GREEN is green of four lanes and orange of five."""

    KICK = 0
    RED = 1
    YELLOW = 2
    BLUE = 3
    ORANGE_GREEN = 4
    FIFTH = 5


class Difficulty(IntEnum):
    """The four charts of one part, the fullest last, by their number in `mix` events."""

    EASY = 0
    MEDIUM = 1
    HARD = 2
    EXPERT = 3


@dataclass(frozen=True, slots=True)
class Span:
    """From `start` to before `end`; one of no length holds its first tick."""

    start: int
    end: int

    def holds(self, tick: int) -> bool:
        """Whether `tick` is in it."""
        return self.start <= tick < max(self.end, self.start + 1)


@dataclass(frozen=True, slots=True)
class ChartNote:
    """One note; `length` above 0 is a roll of five-lane charts; `is_second_kick` asks for the other pedal."""

    tick: int
    lane: Lane
    is_cymbal: bool = False
    dynamic: Dynamic = Dynamic.NORMAL
    is_flam: bool = False
    is_second_kick: bool = False
    length: int = 0


@dataclass(frozen=True, slots=True)
class Motion:
    """What the game's drummer does at a tick: which piece with which hand, as somebody watched or worked it out."""

    tick: int
    piece: Piece
    limb: Limb


@dataclass(frozen=True, slots=True)
class Grab:
    """A cymbal is grabbed at `tick`; where it is struck there too, after `length`."""

    tick: int
    piece: Piece
    length: int


@dataclass(frozen=True, slots=True)
class DrumChart:
    """One difficulty of a drum part.

    `tempos` are (tick, µs a quarter), `meters` (tick, beats, unit), `sections` (tick, name). `has_five_lanes` tells
    which kit the lanes stand for. `flips` are where red and yellow change places (disco flip), `rolls` where one lane
    is rolled, `double_rolls` where two are in turn. `end` is where the song ends, 0 where the file does not say.
    """

    resolution: int
    notes: tuple[ChartNote, ...]
    tempos: tuple[tuple[int, int], ...] = ()
    meters: tuple[tuple[int, int, int], ...] = ()
    sections: tuple[tuple[int, str], ...] = ()
    has_five_lanes: bool = False
    flips: tuple[Span, ...] = ()
    rolls: tuple[Span, ...] = ()
    motions: tuple[Motion, ...] = ()
    open_hats: tuple[Span, ...] = ()
    grabs: tuple[Grab, ...] = ()
    title: str = ""
    author: str = ""
    about: str = ""
    end: int = 0
    lost: tuple[str, ...] = ()
    double_rolls: tuple[Span, ...] = ()


def check_size(chart: DrumChart, source: str) -> None:
    """Raises `BadInput` where a chart is longer or has more notes than music."""
    if not 1 <= chart.resolution <= MOST_RESOLUTION:
        raise BadInput(source, "", f"{chart.resolution} ticks a quarter note; expected 1 to {MOST_RESOLUTION}")
    if len(chart.notes) > MOST_CHART_NOTES:
        raise BadInput(source, "", f"{len(chart.notes)} drum notes; expected at most {MOST_CHART_NOTES}")
    for name, changes in (("tempo", chart.tempos), ("meter", chart.meters)):
        if len(changes) > MOST_CHANGES:
            raise BadInput(source, "", f"{len(changes)} changes of {name}; expected at most {MOST_CHANGES}")
    if len(chart.sections) > MOST_SECTIONS:
        raise BadInput(source, "", f"{len(chart.sections)} sections; expected at most {MOST_SECTIONS}")
    if chart.notes and max(n.tick for n in chart.notes) > MOST_QUARTERS * chart.resolution:
        raise BadInput(source, "", f"its last note is more than {MOST_QUARTERS} quarter notes from the beginning")


def spans_between(switches: list[tuple[int, bool]], end: int) -> tuple[Span, ...]:
    """Where something is on, of (tick, is it on from here); it stays on to `end`."""
    found: list[Span] = []
    since: int | None = None
    for tick, is_on in sorted(switches):
        if is_on and since is None:
            since = tick
        elif not is_on and since is not None:
            found.append(Span(since, tick))
            since = None
    return (*found, Span(since, max(end, since) + 1)) if since is not None else tuple(found)


def merged(spans: Iterable[Span]) -> tuple[Span, ...]:
    """The same places as spans in order that neither touch nor overlap."""
    found: list[Span] = []
    for span in sorted(spans, key=lambda s: (s.start, s.end)):
        if found and span.start < found[-1].end:
            found[-1] = Span(found[-1].start, max(found[-1].end, span.end))
        else:
            found.append(span)
    return tuple(found)


def held_by(tick: int, spans: Sequence[Span]) -> bool:
    """Whether one of `spans`, `merged`, holds `tick`."""
    at = bisect_right(spans, tick, key=lambda span: span.start)
    return at > 0 and spans[at - 1].holds(tick)
