"""Where faults are planted, and what a planted fault is; the limits that all words share."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from station.bench.rigs.planted.planted_oracle import Explanations, level_precision, smallest_shift, timing_precision
from station.bench.rigs.planted.planted_player import Conditions, Sheet
from station.bench.rigs.planted.planted_shapes import level_shapes, timing_shapes
from station.bench.rigs.planted.planted_strokes import Floats, Mask, Written

MOST = 2.0
"""Where the oracle needs more than twice a teacher's size, the music does not exercise the word (our choice)."""
FEWEST = 8
"""Fewer strokes no teacher judges by (our choice)."""


@dataclass(frozen=True, eq=False)
class Planted:
    """A fault in one piece of music: its word, its size in its unit, the strokes that it concerns (n,).

    Words of a `kind` can explain each other; `plant` writes the fault onto a sheet.
    """

    word: str
    size: float
    strokes: Mask
    kind: str
    plant: Callable[[Sheet, np.random.Generator], Sheet]


@dataclass(frozen=True, eq=False)
class Stage:
    """A piece of music under conditions; faults are planted `times` as large as they must be to be found."""

    written: Written
    conditions: Conditions
    times: float = 1.0

    @cached_property
    def shapes(self) -> Mapping[str, Mapping[str, Floats]]:
        """The shapes of all words, by kind."""
        return {"time": timing_shapes(self.written), "level": level_shapes(self.written)}

    @cached_property
    def precision(self) -> Mapping[str, Floats]:
        """What the oracle knows of the noise, by kind."""
        return {"time": timing_precision(self.written, self.conditions), "level": level_precision(self.written)}

    @cached_property
    def explanations(self) -> Mapping[str, Explanations]:
        """What each word says of the strokes, by kind."""
        return {
            kind: Explanations.of(
                {name: self._judged(kind, shape) for name, shape in shapes.items()}, self.precision[kind]
            )
            for kind, shapes in self.shapes.items()
        }

    def least(self, kind: str, shape: Floats) -> float:
        """The smallest factor of a shape (n,) that the oracle finds."""
        return smallest_shift(self.precision[kind], self._judged(kind, shape))

    def _judged(self, kind: str, shape: Floats) -> Floats:
        """The shape at the strokes that the oracle looks at: for times all but graces."""
        return shape[self.written.main] if kind == "time" else shape

    def forget(self) -> None:
        """Drop what is large and has served."""
        for name in ("precision", "shapes"):
            self.__dict__.pop(name, None)


Maker = Callable[[Stage], Planted | None]
"""Makes a word's fault for a stage; None where the music does not exercise it."""
