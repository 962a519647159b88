"""What the families share: phrases that repeat and answer, and beats written as cells."""

from collections.abc import Callable, Sequence
from itertools import pairwise
from random import Random
from typing import TypeVar

_FORM = "ABACABAD"
"""A statement, an answer, the statement again, another answer: the plainest phrase there is."""
_Bar = TypeVar("_Bar")


def phrase(bars: int, make: Callable[[], _Bar]) -> list[_Bar]:
    """So many bars in a form that repeats and answers; `make` makes a bar wherever the form has a new one.

    New bars differ from those before them where `make` can help it: it is asked a few times.
    """
    made: dict[str, _Bar] = {}
    for letter in _form(bars):
        if letter not in made:
            tries = [make() for _ in range(8)]
            made[letter] = next((one for one in tries if one not in made.values()), tries[0])
    return [made[letter] for letter in _form(bars)]


def _form(bars: int) -> str:
    return (_FORM * (bars // len(_FORM) + 1))[:bars]


def in_beats(cells: Sequence[str], cells_a_beat: int) -> str:
    """Letters as a bar of beats: `["o", "-", "o", "o"]`, two a beat, is `"o- oo"`; threes and fives in parentheses."""
    beats = ["".join(cells[i : i + cells_a_beat]) for i in range(0, len(cells), cells_a_beat)]
    plain = cells_a_beat in (1, 2, 4, 8)
    return " ".join(beat if plain else f"({beat})" for beat in beats)


def as_fine(beats: Sequence[str]) -> str:
    """Beats as one bar, each of as many cells as the finest of them; what stands in parentheses stays."""
    finest = max((len(beat) for beat in beats if not beat.startswith("(")), default=1)
    return " ".join(beat if beat.startswith("(") else _spread(beat, finest) for beat in beats)


def _spread(beat: str, cells: int) -> str:
    return "".join(letter + "-" * (cells // len(beat) - 1) for letter in beat)


def mirrored(sticking: str) -> str:
    """The same hands exchanged."""
    return sticking.translate(str.maketrans("RL", "LR"))


def longest_run(sticking: str) -> int:
    """The most strokes in a row of one hand, as the sticking goes round."""
    best = run = 1
    twice = sticking * 2
    for before, after in pairwise(twice):
        run = run + 1 if before == after else 1
        best = max(best, run)
    return min(best, len(sticking))


def pick(rng: Random, choices: Sequence[str]) -> str:
    """One of some words."""
    return choices[rng.randrange(len(choices))]
