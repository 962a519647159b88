"""What each bar of a phrase is for: a statement, an answer, a build, the way home, and where there is air."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from types import MappingProxyType

from numpy.random import Generator

from station.practice.battle.improvising.motif import Turning
from station.practice.battle.opponents.opponent import Manner


class Part(Enum):
    """What a bar of a phrase does."""

    STATEMENT = "statement"
    AGAIN = "statement again"
    ANSWER = "answer"
    BUILD = "build"
    RETURN = "return"


_FORMS: Mapping[int, tuple[tuple[Part, ...], ...]] = MappingProxyType(
    {
        1: ((Part.RETURN,),),
        2: ((Part.STATEMENT, Part.RETURN), (Part.ANSWER, Part.RETURN)),
        4: (
            (Part.STATEMENT, Part.ANSWER, Part.AGAIN, Part.RETURN),
            (Part.ANSWER, Part.STATEMENT, Part.BUILD, Part.RETURN),
            (Part.ANSWER, Part.AGAIN, Part.BUILD, Part.RETURN),
            (Part.STATEMENT, Part.AGAIN, Part.ANSWER, Part.RETURN),
        ),
    }
)
"""Forms of one, two and four bars: what is said comes back once, as in the phrases of trading drummers. Longer phrases
are fours whose last bar before the end builds instead of going home."""
_TURNINGS: tuple[tuple[Turning, float], ...] = (
    (Turning.LITERAL, 0.34),
    (Turning.DISPLACED, 0.16),
    (Turning.ORCHESTRATED, 0.24),
    (Turning.AUGMENTED, 0.1),
    (Turning.THINNED, 0.16),
)
"""How an answer takes up what it answers: most often so that it is known again (our choice)."""
_LOUDER: Mapping[Part, float] = MappingProxyType({Part.BUILD: 1.06, Part.RETURN: 1.1})
"""By how much parts are louder than the others (our choice: a decibel or two, 40·log10)."""
_DENSER: Mapping[Part, float] = MappingProxyType({Part.BUILD: 1.2, Part.RETURN: 1.15})


@dataclass(frozen=True, slots=True)
class PlannedBar:
    """A bar's `part`; `turning` is how it takes up a motif, None where it does not; `air`: its end is left to ring."""

    part: Part
    turning: Turning | None
    air: bool

    @property
    def loudness(self) -> float:
        """By what its velocities are multiplied."""
        return _LOUDER.get(self.part, 1.0)

    @property
    def density(self) -> float:
        """By what its strokes are multiplied."""
        return _DENSER.get(self.part, 1.0)


def phrase_plan(manner: Manner, bars: int, rng: Generator) -> tuple[PlannedBar, ...]:
    """What each of `bars` bars does for somebody of that manner."""
    return tuple(_planned(part, manner, rng) for part in _form(bars, rng))


def _form(bars: int, rng: Generator) -> list[Part]:
    found: list[Part] = []
    while len(found) < bars:
        length = max(n for n in _FORMS if n <= bars - len(found))
        forms = _FORMS[length]
        form = list(forms[int(rng.integers(len(forms)))])
        found += form if len(found) + length == bars else [*form[:-1], Part.BUILD]
    return found


def _planned(part: Part, manner: Manner, rng: Generator) -> PlannedBar:
    answers = part is Part.ANSWER or (part is not Part.RETURN and rng.random() < manner.takes_up)
    takes_up = answers and rng.random() < max(manner.takes_up, 0.25)
    weights = [weight for _, weight in _TURNINGS]
    turning = _TURNINGS[int(rng.choice(len(_TURNINGS), p=weights))][0] if takes_up else None
    return PlannedBar(part, turning, part is not Part.RETURN and bool(rng.random() < manner.air))
