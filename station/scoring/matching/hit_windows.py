"""Judgement windows: how far from its time a stroke still counts as what. A table of named levels.

All widths are half widths in real milliseconds, at any practice speed, and inclusive: a stroke exactly on an edge is
inside. They grade; they never pair hits with notes (`note_reach` says how far a hit may lie from its note).
"""

from dataclasses import dataclass
from enum import StrEnum
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike, NDArray


@dataclass(frozen=True, slots=True)
class Windows:
    """Half widths `edges_ms`, rising, from full marks to the last that earns anything; `source` says whose they are."""

    name: str
    edges_ms: tuple[float, ...]
    source: str

    def grade(self, asynchrony_ms: float) -> int:
        """0 for the innermost window, 1 for the next …, `len(edges_ms)` outside all; the sign does not matter."""
        distance = abs(asynchrony_ms)
        return sum(distance > edge for edge in self.edges_ms)

    @property
    def on_time_ms(self) -> float:
        """How far from its time a stroke still is on time, for whoever shows it: the innermost edge."""
        return self.edges_ms[0]

    def lean(self, asynchrony_ms: float) -> int:
        """−1 early, 0 inside the innermost window, 1 late."""
        return 0 if self.grade(asynchrony_ms) == 0 else (-1 if asynchrony_ms < 0 else 1)

    def credit(self, asynchrony_ms: ArrayLike) -> NDArray[np.float64]:
        """Share of full marks, 1 … 0, the shape of `asynchrony_ms`.

        1 within the first edge, falling by equal steps from edge to edge along straight lines, 0 outside the last.
        With a single edge: 1 inside, 0 outside.
        """
        distance = np.abs(np.asarray(asynchrony_ms, np.float64))
        if len(self.edges_ms) == 1:
            return np.asarray(distance <= self.edges_ms[0], np.float64)
        return np.asarray(np.interp(distance, self.edges_ms, np.linspace(1.0, 0.0, len(self.edges_ms))))


_OURS = "our choice around HUMANS: full marks within 10 ms, mild to 25, clear fault beyond 40"

_TABLE = (
    Windows("beginner", (30.0, 60.0, 120.0), _OURS),
    Windows("elementary", (20.0, 45.0, 90.0), _OURS),
    Windows("intermediate", (15.0, 35.0, 70.0), _OURS),
    Windows("advanced", (10.0, 25.0, 50.0), _OURS),
    Windows("studio", (5.0, 15.0, 30.0), _OURS),
    Windows("yarg", (70.0,), "YARG's default"),
    Windows("yarg_narrow", (25.0,), "YARG's narrowest preset"),
    Windows("drum_game", (35.0, 76.0, 135.0), "Drum Game"),
    Windows("drum_game_lax", (50.0, 100.0, 150.0), "Drum Game, lax"),
    Windows("drum_game_strict", (20.0, 60.0, 100.0), "Drum Game, strict"),
    Windows("dtxmania", (34.0, 67.0, 84.0, 117.0), "DTXMania"),
)

LEVELS = MappingProxyType({windows.name: windows for windows in _TABLE})
"""All levels by name: ours from the widest to the narrowest, then other programs'."""

DEFAULT_LEVEL = LEVELS["intermediate"]


class Level(StrEnum):
    """How strictly a student is judged in a lesson: our own windows, from the widest to the narrowest."""

    BEGINNER = "beginner"
    ELEMENTARY = "elementary"
    INTERMEDIATE = "intermediate"
    ADVANCED = "advanced"
    STUDIO = "studio"

    @property
    def windows(self) -> Windows:
        """Its windows."""
        return LEVELS[self.value]

    @property
    def on_time_ms(self) -> float:
        """Half the width of what is on time."""
        return self.windows.on_time_ms

    @property
    def words(self) -> str:
        """It with what is on time: "beginner, ±30 ms"."""
        return f"{self.value}, ±{self.on_time_ms:g} ms"

    @property
    def rank(self) -> int:
        """0 for the widest, more the narrower it is."""
        return list(Level).index(self)


OUR_LEVELS = MappingProxyType({level.value: level for level in Level})
"""Our own levels by name, the widest first."""
