"""Rhythms to read: alone on the snare, as a syncopated line over the feet, and against another number."""

from collections.abc import Mapping
from math import gcd
from random import Random

from station.drills.families.lesson_page import Page
from station.drills.families.phrases import as_fine, in_beats, phrase, pick

# --- reading ----------------------------------------------------------------------------------------------------------

_BEATS: Mapping[int, tuple[str, ...]] = {
    1: ("o", "o", "-"),
    2: ("o-", "oo", "oo", "--"),
    3: ("o-", "oo", "-o", "(ooo)", "--"),
    4: ("oo", "oooo", "o-oo", "ooo-", "-o", "(ooo)", "o--o"),
    5: ("oooo", "o-oo", "oo-o", "-ooo", "-o-o", "o--o", "-oo-", "(ooo)", "(-oo)", "(o-o)"),
}
"""Of each level the beats that its rhythms are made of: each grows out of the one below it."""
_READING = {1: (70, 100), 2: (72, 104), 3: (72, 100), 4: (66, 92), 5: (66, 92)}
_HANDS = {1: "R", 2: "RL", 3: "RLR", 4: "RLRL"}
"""Natural sticking: the right hand where the beat and its half are, the left between them; triplets alternate."""


def reading(level: int, rng: Random, bars: int) -> Page:
    """A rhythm on the snare, the foot on the quarters; a bar begins on 1 and is not without strokes."""
    choices = _BEATS[level]
    starts = [beat for beat in choices if beat.strip("(")[0] == "o"]

    def bar() -> tuple[str, ...]:
        beats = [pick(rng, starts), *(pick(rng, choices) for _ in range(3))]
        return tuple(_without_second_rest(beats, starts[0]))

    made = phrase(bars, bar)
    return Page(
        title="",
        level=level,
        tags=("reading", "rhythm", "snare"),
        about="Read it before you hear it: cover the drummer, count aloud and clap it once, then play. Eyes go "
        "a beat ahead of the hands. After a mistake do not go back: be right on the next 1.",
        tempo_bpm=_READING[level][0],
        target_tempo_bpm=_READING[level][1],
        lines={
            "snare": [as_fine(one) for one in made],
            "sticking": [as_fine([*map(_natural, one)]) for one in made],
            "hihat_pedal": ["x x x x"] * bars,
        },
        extra=("demonstrations = 0",),
    )


def _without_second_rest(beats: list[str], stroke: str) -> list[str]:
    """The beats, but no silent one after another: nobody learns to read from empty bars."""
    result: list[str] = []
    for beat in beats:
        silent = not beat.strip("-") and bool(result) and not result[-1].strip("-")
        result.append(stroke if silent else beat)
    return result


def _natural(beat: str) -> str:
    bare = beat.strip("()")
    hands = "".join(h if c == "o" else "-" for h, c in zip(_HANDS[len(bare)], bare, strict=True))
    return f"({hands})" if beat.startswith("(") else hands


# --- syncopation ------------------------------------------------------------------------------------------------------

_HALVES: Mapping[int, tuple[str, ...]] = {
    1: ("o-o-", "ooo-", "o-oo", "o---"),
    2: ("ooo-", "o-oo", "-oo-", "oo-o", "oooo"),
    3: ("-oo-", "-o-o", "oo-o", "o--o", "-ooo"),
    4: ("o--o--o-", "o-oo--o-", "--o-o-oo", "-oo-o-o-", "o--oo-o-"),
    5: ("o--o--o-", "-o-oo--o", "-oo--o-o", "o-o--o-o", "--oo-oo-", "-o--o--o"),
}
"""Two beats of the upper line: eighths up to level 3, sixteenths from 4 on."""
_SYNCOPATION = {1: (80, 120), 2: (84, 126), 3: (88, 132), 4: (66, 92), 5: (72, 100)}


def syncopation(level: int, rng: Random, bars: int) -> Page:
    """A line of the right hand on the snare, more and more off the beat, over feet that walk."""
    cells = 2 if level < 4 else 4

    def bar() -> str:
        return pick(rng, _HALVES[level]) + pick(rng, _HALVES[level])

    made = phrase(bars, bar)
    first = made[0] if made[0][0] == "o" else "o" + made[0][1:]
    made = [first if one == made[0] else one for one in made]
    return Page(
        title="",
        level=level,
        tags=("reading", "syncopation", "independence"),
        about="The feet walk, the line dances: sing the line while the feet play alone, then add the hands. "
        "Where a stroke comes before the beat, feel the foot answer it; never let the foot move over to "
        "meet the hand.",
        tempo_bpm=_SYNCOPATION[level][0],
        target_tempo_bpm=_SYNCOPATION[level][1],
        lines={
            "snare": [in_beats(one, cells) for one in made],
            "kick": ["o o o o"] * bars,
            "hihat_pedal": ["- x - x"] * bars,
        },
    )


# --- polyrhythms ------------------------------------------------------------------------------------------------------

_RATIOS: Mapping[int, tuple[tuple[int, int], ...]] = {
    1: ((3, 2),),
    2: ((3, 2), (2, 3)),
    3: ((4, 3), (3, 4)),
    4: ((5, 4), (5, 2), (5, 3)),
    5: ((7, 4), (7, 3), (7, 2), (5, 4)),
}
"""Of each level how many strokes are played in the time of how many beats."""
_VOICES: Mapping[int, tuple[tuple[str, str], ...]] = {
    1: (("left_hand.snare", "right_hand.floor_tom"), ("right_hand.floor_tom", "left_hand.snare")),
    2: (("right_hand.ride", "left_hand.snare"), ("left_hand.snare", "kick")),
    3: (("right_hand.ride", "kick"), ("left_hand.snare", "kick"), ("kick", "right_hand.ride")),
    4: (("right_hand.ride", "kick"), ("left_hand.snare", "kick")),
    5: (("right_hand.ride", "kick"), ("left_hand.snare", "kick")),
}
"""Of each level which line plays against which; the second has the beat."""
_AGAINST = {1: (60, 84), 2: (66, 92), 3: (72, 100), 4: (60, 84), 5: (56, 76)}


def polyrhythms(level: int, rng: Random, bars: int) -> Page:
    """So many strokes in the time of so many beats; beats alone in the first bar where there is more than one."""
    over, beats = _RATIOS[level][rng.randrange(len(_RATIOS[level]))]
    upper, lower = _VOICES[level][rng.randrange(len(_VOICES[level]))]
    keeps = "hihat_pedal" if level >= 3 and rng.random() < 0.5 else ""
    beat = " ".join([_letter(lower)] * beats)
    against = evenly(over, beats, _letter(upper))
    lines = {
        upper: [against] * bars if bars == 1 else [" ".join("-" * beats), *[against] * (bars - 1)],
        lower: [beat] * bars,
        **({keeps: [" ".join("x" * beats)] * bars} if keeps else {}),
    }
    return Page(
        title=f"{over} against {beats}",
        level=level,
        tags=("polyrhythm", "independence"),
        about=f"{over} strokes in the time of {beats}. Learn the sum of both first, as one rhythm, slowly and "
        "with a sentence that fits it; then listen to one of the two alone, then to the other, while both "
        "go on.",
        tempo_bpm=_AGAINST[level][0],
        target_tempo_bpm=_AGAINST[level][1],
        lines=lines,
        meter=f"{beats}/4",
    )


def evenly(over: int, beats: int, letter: str) -> str:
    """`over` strokes at even distances in `beats` beats; raises `ValueError` where the two share a divisor."""
    if gcd(over, beats) != 1:
        raise ValueError(f"{over} against {beats} is a simpler rhythm")
    return in_beats([letter if cell % beats == 0 else "-" for cell in range(over * beats)], over)


def _letter(line: str) -> str:
    return "x" if line.endswith("ride") else "o"
