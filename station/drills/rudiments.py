"""The forty international drum rudiments of the Percussive Arts Society, as a table in the grid's own letters.

Numbers, names, order and stickings are those of the PAS International Drum Rudiments (1984). A row's `strokes` and
`sticking` make one or two bars that loop; where a rudiment does not change hands by itself, the second bar is led by
the left. Rolls are written as diddles (`t`), grace strokes by their letters (`f`, `d`). Tempi are our choice: where a
student should begin.
"""

from dataclasses import dataclass
from functools import cache

from station.core.counts import is_count
from station.core.did_you_mean import nearest
from station.core.errors import BadInput
from station.drills.lesson import Lesson
from station.drills.lesson_file import parse_lesson

ROLLS, DIDDLES, FLAMS, DRAGS = "rolls", "diddles", "flams", "drags"
SIX_EIGHT, THREE_FOUR = "6/8", "3/4"


@dataclass(frozen=True, slots=True)
class Rudiment:
    """One row; `strokes` and `sticking` are lines of the grid, `tempo_bpm` counts `beat`."""

    number: int
    title: str
    family: str
    level: int
    tempo_bpm: int
    strokes: str
    sticking: str
    meter: str = "4/4"

    @property
    def name(self) -> str:
        """Its name as a lesson: `flam-tap`."""
        return _name_of(self.title)

    @property
    def beat(self) -> str:
        """The note that the tempo counts."""
        return "3/8" if self.meter == SIX_EIGHT else "1/4"


RUDIMENTS: tuple[Rudiment, ...] = (
    Rudiment(1, "Single Stroke Roll", ROLLS, 1, 70, "oooo oooo oooo oooo", "RLRL RLRL RLRL RLRL"),
    Rudiment(2, "Single Stroke Four", ROLLS, 2, 70, "(ooo) o (ooo) o | %", "(RLR) L (RLR) L | (LRL) R (LRL) R"),
    Rudiment(3, "Single Stroke Seven", ROLLS, 2, 60, "(oooooo) o (oooooo) o", "(RLRLRL) R (LRLRLR) L"),
    Rudiment(4, "Multiple Bounce Roll", ROLLS, 3, 70, "bb bb bb bb", "RL RL RL RL"),
    Rudiment(5, "Triple Stroke Roll", ROLLS, 3, 80, "ooo ooo ooo ooo", "RRR LLL RRR LLL"),
    Rudiment(6, "Double Stroke Open Roll", ROLLS, 2, 70, "tt tt tt tt", "RL RL RL RL"),
    Rudiment(7, "Five Stroke Roll", ROLLS, 2, 60, "ttO- ttO- ttO- ttO-", "RLR- LRL- RLR- LRL-"),
    Rudiment(
        8, "Six Stroke Roll", ROLLS, 3, 60, "OttO OttO OttO OttO | %", "RLRL RLRL RLRL RLRL | LRLR LRLR LRLR LRLR"
    ),
    Rudiment(9, "Seven Stroke Roll", ROLLS, 3, 60, "(ttt) O (ttt) O | %", "(RLR) L (RLR) L | (LRL) R (LRL) R"),
    Rudiment(10, "Nine Stroke Roll", ROLLS, 2, 60, "tttt O--- tttt O---", "RLRL R--- LRLR L---"),
    Rudiment(
        11, "Ten Stroke Roll", ROLLS, 3, 60, "tttt OO-- tttt OO-- | %", "RLRL RL-- RLRL RL-- | LRLR LR-- LRLR LR--"
    ),
    Rudiment(
        12, "Eleven Stroke Roll", ROLLS, 3, 60, "---t tttt O--- ---- | %", "---R LRLR L--- ---- | ---L RLRL R--- ----"
    ),
    Rudiment(
        13, "Thirteen Stroke Roll", ROLLS, 3, 60, "--tt tttt O--- ---- | %", "--RL RLRL R--- ---- | --LR LRLR L--- ----"
    ),
    Rudiment(
        14, "Fifteen Stroke Roll", ROLLS, 3, 60, "-ttt tttt O--- ---- | %", "-RLR LRLR L--- ---- | -LRL RLRL R--- ----"
    ),
    Rudiment(
        15,
        "Seventeen Stroke Roll",
        ROLLS,
        3,
        60,
        "tttt tttt O--- ---- | %",
        "RLRL RLRL R--- ---- | LRLR LRLR L--- ----",
    ),
    Rudiment(16, "Single Paradiddle", DIDDLES, 1, 70, "Oooo Oooo Oooo Oooo", "RLRR LRLL RLRR LRLL"),
    Rudiment(17, "Double Paradiddle", DIDDLES, 2, 60, "Oooooo Oooooo", "RLRLRR LRLRLL", SIX_EIGHT),
    Rudiment(18, "Triple Paradiddle", DIDDLES, 2, 70, "Oooo oooo Oooo oooo", "RLRL RLRR LRLR LRLL"),
    Rudiment(19, "Paradiddle-diddle", DIDDLES, 2, 60, "Oooooo Oooooo | %", "RLRRLL RLRRLL | LRLLRR LRLLRR", SIX_EIGHT),
    Rudiment(20, "Flam", FLAMS, 2, 80, "f f f f", "R L R L"),
    Rudiment(21, "Flam Accent", FLAMS, 3, 70, "Foo Foo Foo Foo", "RLR LRL RLR LRL"),
    Rudiment(22, "Flam Tap", FLAMS, 3, 60, "fofo fofo fofo fofo", "RRLL RRLL RRLL RRLL"),
    Rudiment(23, "Flamacue", FLAMS, 4, 70, "fOoo f--- fOoo f---", "RLRL R--- LRLR L---"),
    Rudiment(24, "Flam Paradiddle", FLAMS, 3, 60, "fooo fooo fooo fooo", "RLRR LRLL RLRR LRLL"),
    Rudiment(25, "Single Flammed Mill", FLAMS, 4, 60, "Fooo Fooo Fooo Fooo", "RRLR LLRL RRLR LLRL"),
    Rudiment(26, "Flam Paradiddle-diddle", FLAMS, 4, 50, "fooooo fooooo", "RLRRLL LRLLRR", SIX_EIGHT),
    Rudiment(27, "Pataflafla", FLAMS, 5, 50, "FooF FooF FooF FooF", "RLRL RLRL RLRL RLRL"),
    Rudiment(28, "Swiss Army Triplet", FLAMS, 3, 70, "foo foo foo foo | %", "RRL RRL RRL RRL | LLR LLR LLR LLR"),
    Rudiment(29, "Inverted Flam Tap", FLAMS, 4, 50, "fofo fofo fofo fofo", "RLLR RLLR RLLR RLLR"),
    Rudiment(30, "Flam Drag", FLAMS, 4, 60, "fto fto fto fto", "RLR LRL RLR LRL"),
    Rudiment(31, "Drag", DRAGS, 3, 70, "d d d d", "R L R L"),
    Rudiment(32, "Single Drag Tap", DRAGS, 3, 70, "dO dO dO dO", "RL LR RL LR"),
    Rudiment(33, "Double Drag Tap", DRAGS, 4, 50, "ddO ddO", "RRL LLR", SIX_EIGHT),
    Rudiment(34, "Lesson 25", DRAGS, 4, 60, "doO- doO- doO- doO- | %", "RLR- RLR- RLR- RLR- | LRL- LRL- LRL- LRL-"),
    Rudiment(35, "Single Dragadiddle", DRAGS, 4, 50, "Tooo Tooo Tooo Tooo", "RLRR LRLL RLRR LRLL"),
    Rudiment(36, "Drag Paradiddle #1", DRAGS, 4, 45, "O-dooo O-dooo", "R-RLRR L-LRLL", SIX_EIGHT),
    Rudiment(37, "Drag Paradiddle #2", DRAGS, 4, 60, "O-d- dooo O-d- dooo", "R-R- RLRR L-L- LRLL"),
    Rudiment(38, "Single Ratamacue", DRAGS, 4, 60, "(doo) O (doo) O", "(RLR) L (LRL) R"),
    Rudiment(39, "Double Ratamacue", DRAGS, 4, 60, "d (doo) O | %", "R (RLR) L | L (LRL) R", THREE_FOUR),
    Rudiment(40, "Triple Ratamacue", DRAGS, 5, 60, "d d (doo) O | %", "R R (RLR) L | L L (LRL) R"),
)


def _name_of(title: str) -> str:
    """A title as a lesson's name."""
    return title.strip().lower().replace(" ", "-").replace("#", "")


@cache
def _by_name() -> dict[str, Rudiment]:
    return {r.name: r for r in RUDIMENTS}


def find_rudiment(name_or_number: str) -> Rudiment:
    """The rudiment of that name (`flam-tap`) or PAS number; raises `BadInput` with the nearest name."""
    if is_count(name_or_number) and 1 <= int(name_or_number) <= len(RUDIMENTS):
        return RUDIMENTS[int(name_or_number) - 1]
    name = _name_of(name_or_number)
    if name not in _by_name():
        raise BadInput(name_or_number, "", f"no such rudiment{nearest(name, _by_name())}")
    return _by_name()[name]


def rudiment_lesson(rudiment: Rudiment, tempo_bpm: float | None = None) -> Lesson:
    """A lesson of one rudiment on the snare at `tempo_bpm` of its beat (its own tempo by default).

    Raises `BadInput` at a tempo that no hands can play.
    """
    text = f"""
title = "{rudiment.title}"
level = {rudiment.level}
tags = ["rudiment", "{rudiment.family}"]
tempo_bpm = {rudiment.tempo_bpm if tempo_bpm is None else tempo_bpm}
meter = "{rudiment.meter}"
beat = "{rudiment.beat}"
[grid]
snare    = "{rudiment.strokes}"
sticking = "{rudiment.sticking}"
"""
    reading = parse_lesson(text, rudiment.title, rudiment.name)
    if reading.lesson is None:
        raise BadInput(rudiment.title, f"{tempo_bpm} bpm", reading.faults[0].text)
    return reading.lesson
