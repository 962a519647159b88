"""What a judged improvisation looks like: components side by side, each with points, evidence and figures."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from types import MappingProxyType

FULL_POINTS = 100.0


class Component(StrEnum):
    """What is looked at, one beside the other; none of them is creativity."""

    TIME = "time"
    DYNAMICS = "dynamics"
    VOCABULARY = "vocabulary"
    DEVELOPMENT = "development"
    KIT = "kit"
    SPACE = "space"


@dataclass(frozen=True, slots=True)
class Place:
    """Where in a turn something is: `bar` and `beat` count from 0, `beat` None for the whole bar; `words` say what."""

    bar: int
    beat: int | None
    words: str


@dataclass(frozen=True, slots=True)
class ComponentMarks:
    """One component: `points` 0–100, None where the turn cannot tell.

    `words` are short enough for the screen; `figures` by name, in the units that `docs/battle-judging.md` gives;
    `places` point at bars and beats, the most telling first.
    """

    component: Component
    points: float | None
    words: str
    figures: Mapping[str, float] = field(default_factory=lambda: MappingProxyType({}))
    places: tuple[Place, ...] = ()


@dataclass(frozen=True, slots=True)
class ImprovisationMarks:
    """All components of a turn, with the weights that they count by, and what each bar is worth for the replay.

    `bar_points` has 0–100 a bar: see `best_bar`.
    """

    components: tuple[ComponentMarks, ...]
    weights: Mapping[Component, float]
    bar_points: tuple[float, ...] = ()

    @property
    def points(self) -> float:
        """The weighted mean of the components that could be told, 0–100; 0 where none could."""
        told = [(marks.points, self.weights[marks.component]) for marks in self.components if marks.points is not None]
        whole = sum(weight for _, weight in told)
        return sum(points * weight for points, weight in told) / whole if whole else 0.0

    def of(self, component: Component) -> ComponentMarks:
        """The marks of one component."""
        return next(marks for marks in self.components if marks.component is component)
