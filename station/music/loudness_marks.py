"""Loudness as a part has it on paper: marks from ppp to fff, and hairpins from one to the next.

They say how loud a passage is, for whoever reads; how hard each stroke is struck its velocity says.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

GROW, FADE = "<", ">"
USUAL = "mf"
"""How loud a part is that says nothing: the velocities as they are written (docs/lesson-format.md)."""


@dataclass(frozen=True, slots=True)
class LoudnessMark:
    """From `tick` on: `sign` a word from ppp to fff, or `GROW` or `FADE`, which end where the next mark stands."""

    tick: int
    sign: str

    @property
    def is_hairpin(self) -> bool:
        """Whether the loudness changes from here on."""
        return self.sign in (GROW, FADE)

    def moved(self, ticks: int) -> "LoudnessMark":
        """The same mark `ticks` later."""
        return replace(self, tick=self.tick + ticks)


def marks_within(marks: Sequence[LoudnessMark], start: int, end: int) -> tuple[LoudnessMark, ...]:
    """The marks of [start, end) ticks from `start` on, and at 0 what stands there from before."""
    inside = [mark.moved(-start) for mark in marks if start <= mark.tick < end]
    standing = [mark for mark in marks if mark.tick < start][-1:]
    if standing and not any(mark.tick == 0 for mark in inside):
        inside.insert(0, replace(standing[0], tick=0))
    return tuple(inside)


def joined_marks(parts: Iterable[tuple[int, Sequence[LoudnessMark]]]) -> tuple[LoudnessMark, ...]:
    """The marks of parts that follow each other, each with the tick where it begins.

    Each part begins as loud as usual, and a word that says what holds anyway is left out.
    """
    found: list[LoudnessMark] = []
    for start, marks in parts:
        says_start = any(mark.tick == 0 and not mark.is_hairpin for mark in marks)
        found += [] if says_start else [LoudnessMark(start, USUAL)]
        found += [mark.moved(start) for mark in marks]
    return _needed(found)


def _needed(marks: Iterable[LoudnessMark]) -> tuple[LoudnessMark, ...]:
    """The marks without words that repeat what holds; none where all is as loud as usual."""
    kept: list[LoudnessMark] = []
    for mark in marks:
        if not kept or mark.sign != kept[-1].sign:
            kept.append(mark)
    return () if [mark.sign for mark in kept] == [USUAL] else tuple(kept)
