"""Sticking permutations, paradiddles with their inversions, and grids of accents: what hands do on one drum."""

from collections.abc import Mapping, Sequence
from itertools import pairwise
from random import Random

from station.drills.families.lesson_page import Page
from station.drills.families.phrases import in_beats, longest_run, mirrored, phrase, pick

# --- permutations -----------------------------------------------------------------------------------------------------

_PERMUTED: Mapping[int, tuple[int, int, int, int, int]] = {
    1: (2, 4, 2, 70, 110),
    2: (4, 4, 2, 55, 80),
    3: (4, 8, 2, 65, 90),
    4: (4, 8, 3, 76, 104),
    5: (6, 12, 3, 60, 80),
}
"""Of each level: cells a beat, strokes until the hands are exchanged, the longest run of a hand, tempo and goal."""


def permutations(level: int, rng: Random, bars: int) -> Page:
    """Bars of even strokes in a sticking that is answered by its mirror, so that no hand leads for ever."""
    cells, strokes, most, tempo, goal = _PERMUTED[level]

    def bar() -> str:
        half = next(s for s in iter(lambda: _sticking(rng, strokes), "") if 2 <= longest_run(s + mirrored(s)) <= most)
        return ((half + mirrored(half)) * 4)[: 4 * cells]

    stickings = phrase(bars, bar)
    return Page(
        title="",
        level=level,
        tags=("hands", "sticking", "permutations"),
        about=f"Even strokes, uneven hands: read the sticking and let nobody hear it. Each pattern of {strokes} "
        "is answered with the hands exchanged. Say R and L aloud first, play it slowly, and keep both "
        "sticks at one height.",
        tempo_bpm=tempo,
        target_tempo_bpm=goal,
        lines={
            "snare": [in_beats("o" * len(one), cells) for one in stickings],
            "sticking": [in_beats(one, cells) for one in stickings],
        },
    )


def _sticking(rng: Random, strokes: int) -> str:
    """Any hands that begin with the right and are not all alike."""
    return "R" + "".join(pick(rng, "RL") for _ in range(strokes - 1))


# --- paradiddles ------------------------------------------------------------------------------------------------------

_TURNS = ("RLRRLRLL", "RLLRLRRL", "RRLRLLRL", "RLRLLRLR")
"""The paradiddle, and what it becomes where it begins with its second, third or fourth stroke, right hand first."""
_PARADIDDLES: Mapping[int, tuple[int, tuple[str, ...], int, int]] = {
    1: (1, ("O---",), 60, 90),
    2: (2, ("O---", "O-O-"), 60, 84),
    3: (3, ("O---", "-O--", "--O-", "O--O"), 68, 98),
    4: (4, ("O--O", "-OO-", "O-O-", "--OO", "-O-O"), 76, 108),
    5: (3, ("O--O", "-OO-", "--OO", "O---"), 80, 112),
}
"""Of each level: how many of `_TURNS`, the accents of four strokes, tempo and goal."""


def paradiddles(level: int, rng: Random, bars: int) -> Page:
    """Paradiddles and their inversions in sixteenths, with accents that move; at level 5 accents go to the toms."""
    turns, accents, tempo, goal = _PARADIDDLES[level]

    def bar() -> tuple[str, str]:
        while True:
            hands = pick(rng, _TURNS[:turns])
            first, second = pick(rng, accents), pick(rng, accents)
            loud = first + (first if level < 3 else second)
            if level < 5 or _stays_on_its_drum(hands, loud):
                return hands * 2, loud * 2

    made = phrase(bars, bar)
    snare = [in_beats(["O" if a == "O" else "o" for a in accent], 4) for _, accent in made]
    lines = {"snare": snare, "sticking": [in_beats(hands, 4) for hands, _ in made]}
    if level == 5:
        taps = [in_beats(["-" if a == "O" else "g" for a in accent], 4) for _, accent in made]
        toms = {"tom_1": _accents_of("L", made), "snare": taps, "floor_tom": _accents_of("R", made)}
        lines = {**toms, "sticking": lines["sticking"], "kick": ["o o o o"] * bars}
    where = "The accents go to the toms and the taps stay ghosts" if level == 5 else "Accents high, taps low"
    return Page(
        title="",
        level=level,
        tags=("hands", "paradiddle", "accents"),
        about=f"Paradiddles that begin at another of their strokes, and accents that wander. {where}: the double "
        "after an accent is what gives it room. Where it gets loud in the middle, slow down.",
        tempo_bpm=tempo,
        target_tempo_bpm=goal,
        lines=lines,
    )


def _stays_on_its_drum(hands: str, accents: str) -> bool:
    """Whether no hand has a tap beside an accent: on the kit that is a way of 60 cm in a sixteenth."""
    strokes = list(zip(hands, accents, strict=True))
    around = pairwise([*strokes, strokes[0]])
    return all(hand != other or loud == louder for (hand, loud), (other, louder) in around)


def _accents_of(hand: str, made: Sequence[tuple[str, str]]) -> list[str]:
    """The accents of one hand as bars of their own."""
    return [in_beats(["O" if (h, a) == (hand, "O") else "-" for h, a in zip(*one, strict=True)], 4) for one in made]


# --- accents ----------------------------------------------------------------------------------------------------------

_ACCENTS = {1: (2, 1, 80, 120), 2: (4, 1, 60, 90), 3: (3, 1, 70, 100), 4: (4, 2, 76, 104), 5: (4, 2, 88, 116)}
"""Of each level: cells a beat, accents a beat, tempo and goal."""


def accents(level: int, rng: Random, bars: int) -> Page:
    """Alternating strokes with accents that stand on one place of the beat for two beats, then on another."""
    cells, loud, tempo, goal = _ACCENTS[level]

    def beat() -> str:
        at = rng.sample(range(cells), loud)
        return "".join("O" if i in at else "g" if level == 5 else "o" for i in range(cells))

    def bar() -> str:
        first, second = beat(), beat()
        return first * 2 + second * 2 if level < 5 else first + second + first + beat()

    made = phrase(bars, bar)
    return Page(
        title="",
        level=level,
        tags=("hands", "accents"),
        about="Hands alternate, the accent walks through the beat. An accent is a high stick and a tap a low "
        "one: prepare the next accent with an upstroke, and keep the taps soft however loud the accent "
        "before them was.",
        tempo_bpm=tempo,
        target_tempo_bpm=goal,
        lines={
            "snare": [in_beats(one, cells) for one in made],
            "sticking": [in_beats(("RL" * len(one))[: len(one)], cells) for one in made],
            "hihat_pedal": ["x x x x"] * bars,
        },
    )
