"""Patterns that share the kit out among the limbs: one stroke at a time (linear), or a melody over what never stops."""

from collections.abc import Mapping
from random import Random

from station.drills.families.lesson_page import Page
from station.drills.families.phrases import as_fine, in_beats, phrase, pick

# --- linear -----------------------------------------------------------------------------------------------------------

_GROUPS: Mapping[int, tuple[str, ...]] = {
    3: ("RLK",),
    4: ("RLRK", "RLKK"),
    5: ("RLRLK", "RLRKK"),
    6: ("RLRRLK", "RLRLKK"),
    7: ("RLRRLKK", "RLRLRLK"),
    8: ("RLRLRLKK", "RLRRLRLK"),
}
"""Groups that end with the foot, hands alternating or with one double: by their number of strokes."""
_SIZES: Mapping[int, tuple[tuple[int, ...], ...]] = {
    1: ((4, 4),),
    2: ((4, 4, 4, 4), (8, 4, 4), (4, 4, 8), (8, 8)),
    3: ((3, 3, 4, 3, 3), (4, 3, 3, 6), (3, 3, 6, 4), (4, 6, 6)),
    4: ((5, 5, 6), (3, 5, 8), (5, 3, 5, 3), (3, 5, 3, 5), (6, 6, 4)),
    5: ((5, 7, 4), (7, 5, 4), (3, 3, 3, 7), (7, 3, 6), (5, 5, 3, 3)),
}
"""Of each level how a bar is shared out: eight eighths at level 1, sixteen sixteenths after it."""
_LINEAR = {1: (70, 104), 2: (56, 80), 3: (60, 84), 4: (76, 104), 5: (84, 112)}
_TRIES = 200


def linear(level: int, rng: Random, bars: int) -> Page:
    """One stroke at a time: right on the hat, left on the snare, foot on the kick; a hand has the backbeats."""
    cells = 2 if level == 1 else 4
    backbeats = (cells, 3 * cells)

    def bar() -> str:
        for _ in range(_TRIES):
            sizes = _SIZES[level][rng.randrange(len(_SIZES[level]))]
            limbs = "".join(pick(rng, _GROUPS[size]) for size in sizes)
            if all(limbs[i] != "K" for i in backbeats):
                return limbs
        raise AssertionError("every level has a bar whose backbeats a hand can play")

    made = phrase(bars, bar)

    def line(limb: str, soft: str, at_backbeat: str) -> list[str]:
        rows = [
            [(at_backbeat if i in backbeats else soft) if c == limb else "-" for i, c in enumerate(one)] for one in made
        ]
        return [in_beats(one, cells) for one in rows]

    def snare(one: str) -> str:
        letters = ["O" if i in backbeats else "-" if c != "L" else "g" if level > 2 else "o" for i, c in enumerate(one)]
        return in_beats(letters, cells)

    return Page(
        title="",
        level=level,
        tags=("linear", "groove", "coordination"),
        about="No two limbs together: every stroke passes the line on to the next limb. Play the groups slowly "
        "and evenly first, then lean on 2 and 4: it is a groove as soon as the backbeats stand out and "
        "everything else stays low.",
        tempo_bpm=_LINEAR[level][0],
        target_tempo_bpm=_LINEAR[level][1],
        lines={
            "hihat": line("R", "x", "-"),
            "snare": [snare(one) for one in made],
            "sticking": [in_beats([c if c in "RL" else "-" for c in one], cells) for one in made],
            "kick": line("K", "o", "-"),
        },
        landing={"crash": "X", "kick": "O"},
    )


# --- ostinato ---------------------------------------------------------------------------------------------------------

_Ostinati = tuple[tuple[str, Mapping[str, str]], ...]
_OSTINATI: Mapping[int, tuple[str, _Ostinati]] = {
    1: (
        "left_hand.snare",
        (("eighths on the hat, the kick on 1 and 3", {"right_hand.hihat": "xx xx xx xx", "kick": "o - o -"}),),
    ),
    2: (
        "kick",
        (
            ("a rock beat in eighths", {"right_hand.hihat": "xx xx xx xx", "left_hand.snare": "- O - O"}),
            ("a rock beat in quarters", {"right_hand.ride": "x x x x", "left_hand.snare": "- O - O"}),
        ),
    ),
    3: (
        "left_hand.snare",
        (
            (
                "the jazz ride, the foot on 2 and 4",
                {"right_hand.ride": "(x--) (x-x) (x--) (x-x)", "kick": "g g g g", "hihat_pedal": "- x - x"},
            ),
        ),
    ),
    4: (
        "left_hand.snare",
        (
            (
                "the feet of the samba",
                {"right_hand.ride": "x-xx x-xx x-xx x-xx", "kick": "o--o o--o o--o o--o", "hihat_pedal": "-x -x -x -x"},
            ),
            (
                "the feet of the baião",
                {"right_hand.ride": "x-xx x-xx x-xx x-xx", "kick": "o--o --o- o--o --o-", "hihat_pedal": "-x -x -x -x"},
            ),
        ),
    ),
    5: (
        "left_hand.snare",
        (
            (
                "the son clave in the left foot",
                {
                    "right_hand.ride": "x-x- xx-x -x-x x-x-",
                    "kick": "---o --o- ---o --o-",
                    "hihat_pedal": "x--x --x- --x- x---",
                },
            ),
            (
                "the feet of the samba under a bell",
                {"right_hand.ride": "b-b- bb-b -b-b b-b-", "kick": "o--o o--o o--o o--o", "hihat_pedal": "-x -x -x -x"},
            ),
        ),
    ),
}
"""Of each level the line of the melody, and the ostinati that go on under it."""
_MELODIES: Mapping[int, tuple[str, ...]] = {
    1: ("o", "o", "-"),
    2: ("o-", "-o", "oo", "--"),
    3: ("(---)", "(o--)", "(--o)", "(o-o)", "(-o-)"),
    4: ("----", "o---", "--o-", "---o", "o--o", "-o--", "-o-o"),
    5: ("o--o", "-o-o", "--oo", "-oo-", "o-o-", "---o", "-o--"),
}
"""Of each level the beats of the melody."""
_APART = {1: (60, 90), 2: (76, 112), 3: (100, 150), 4: (60, 84), 5: (60, 84)}


def ostinato(level: int, rng: Random, bars: int) -> Page:
    """A melody of one limb over what the others never stop doing."""
    melody, ostinati = _OSTINATI[level]
    words, lines = ostinati[rng.randrange(len(ostinati))]

    def bar() -> str:
        while True:
            beats = [pick(rng, _MELODIES[level]) for _ in range(4)]
            if 2 <= "".join(beats).count("o") <= 7:
                return as_fine(beats)

    return Page(
        title=words,
        level=level,
        tags=("independence", "ostinato"),
        about=f"What goes on by itself: {words}. Play it alone until you can talk over it. Then add the melody a "
        "beat at a time: where the ostinato stumbles, stop the melody and begin again with one stroke of "
        "it.",
        tempo_bpm=_APART[level][0],
        target_tempo_bpm=_APART[level][1],
        lines={melody: phrase(bars, bar), **{name: [one] * bars for name, one in lines.items()}},
        landing={"crash": "X", "kick": "O"},
    )
