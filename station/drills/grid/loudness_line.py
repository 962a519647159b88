"""The loudness line: marks from ppp to fff and hairpins, as factors of the written velocities.

A mark stands in the cell of its first letter and its other letters take the cells that follow; from there on it
counts, a stroke in that very cell included. `<` and `>` begin in their first cell and reach the next mark evenly in
decibels along straight ticks, as a hand does that changes by equal steps of loudness. Before any mark it is mf.
"""

from bisect import bisect_right
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from math import sqrt
from types import MappingProxyType

from station.core.toml.schema import either
from station.drills.grid.grid import Bar, Cell, Report
from station.drills.grid.tab_symbols import RESTS
from station.music.loudness_marks import FADE, GROW, USUAL, LoudnessMark

STICK_HEIGHTS_IN: Mapping[str, float] = MappingProxyType(
    {"ppp": 1, "pp": 2, "p": 3, "mp": 4.5, "mf": 6, "f": 9, "ff": 12, "fff": 15}
)
"""Inches to which the stick rises for each mark, as marching percussion counts them (docs/lesson-format.md)."""
_HAIRPINS = MappingProxyType({GROW: "grows", FADE: "fades"})


def gain_of(mark: str) -> float:
    """What `mark` multiplies velocities by: the stick's speed at the drum goes with the root of its height."""
    return sqrt(STICK_HEIGHTS_IN[mark] / STICK_HEIGHTS_IN[USUAL])


@dataclass(frozen=True, slots=True)
class _Event:
    """A mark, or the first cell of a hairpin, at a tick from the start of the grid; `char` is where it is written."""

    tick: int
    word: str
    char: int


@dataclass(frozen=True, slots=True)
class Loudness:
    """Gains at `ticks`, which rise; between two they change evenly in decibels where `ramps` says so at the first.

    `marks` is what the line says, as notation shows it.
    """

    ticks: tuple[int, ...] = (0,)
    gains: tuple[float, ...] = (1.0,)
    ramps: tuple[bool, ...] = (False,)
    marks: tuple[LoudnessMark, ...] = ()

    def gain(self, tick: int) -> float:
        """The factor at `tick`, straight, from the start of the grid."""
        i = max(bisect_right(self.ticks, tick) - 1, 0)
        if not self.ramps[i]:
            return self.gains[i]
        share = (tick - self.ticks[i]) / (self.ticks[i + 1] - self.ticks[i])
        return float(self.gains[i] ** (1 - share) * self.gains[i + 1] ** share)


def read_loudness(bars: Iterable[tuple[int, Bar]], report: Report) -> Loudness:
    """What a loudness line says, its bars each with the tick of its start; faults go to `report`."""
    ticks, gains, ramps = [0], [1.0], [False]
    marks: list[LoudnessMark] = []
    open_pin: _Event | None = None
    for event in _events(bars, report):
        if event.word in _HAIRPINS:
            if open_pin is None:
                open_pin = event
                marks.append(LoudnessMark(event.tick, event.word))
                ticks, gains, ramps = [*ticks, event.tick], [*gains, gains[-1]], [*ramps, True]
            elif open_pin.word != event.word:
                text = f"{event.word} follows {open_pin.word} without a mark between them that says how loud it gets"
                report(event.char, f"{text}; expected one before it, such as {'f' if event.word == FADE else 'p'}")
                open_pin, ramps[-1] = None, False
            continue
        gain = gain_of(event.word)
        if open_pin and (gain <= gains[-1] if open_pin.word == GROW else gain >= gains[-1]):
            louder = "louder" if open_pin.word == GROW else "softer"
            text = f"{open_pin.word} {_HAIRPINS[open_pin.word]}, but {event.word} is not {louder} than it is there"
            report(open_pin.char, f"{text}; expected a {louder} mark after it")
        open_pin = None
        marks.append(LoudnessMark(event.tick, event.word))
        ticks, gains, ramps = [*ticks, event.tick], [*gains, gain], [*ramps, False]
    if open_pin:
        example = "f" if open_pin.word == GROW else "p"
        report(open_pin.char, f"{open_pin.word} without a mark after it in this grid; expected one such as {example}")
        ramps[-1] = False
    return Loudness(tuple(ticks), tuple(gains), tuple(ramps), tuple(marks))


def _events(bars: Iterable[tuple[int, Bar]], report: Report) -> list[_Event]:
    """The marks and hairpins in their order; of hairpins that touch only the first cell."""
    found: list[_Event] = []
    for start, bar in bars:
        for run in letter_runs(bar.cells):
            if run[0].letter in RESTS:
                continue
            first, word = run[0], "".join(cell.letter for cell in run)
            if word in STICK_HEIGHTS_IN or word in _HAIRPINS:
                found.append(_Event(start + first.tick, word, first.char))
            else:
                report(first.char, f"{word!r} is no loudness; expected {either([*STICK_HEIGHTS_IN, *_HAIRPINS])} or -")
    return found


def letter_runs(cells: Sequence[Cell]) -> list[list[Cell]]:
    """The cells of one bar that belong together: the letters of each mark; each rest and hairpin cell by itself."""
    runs: list[list[Cell]] = []
    before = RESTS
    for cell in cells:
        kind = RESTS if cell.letter in RESTS else cell.letter if cell.letter in _HAIRPINS else "letter"
        if kind == "letter" and before == kind:
            runs[-1].append(cell)
        else:
            runs.append([cell])
        before = kind
    return runs
