"""The rudiments as they are published beside the lessons that ship: writes docs/rudiments.md.

    python -m tools.rudiment_table

Ours is read from the lessons' scores: hands, accents, grace strokes, the time from stroke to stroke, the tempo.
"""

from collections.abc import Sequence
from fractions import Fraction
from itertools import groupby
from pathlib import Path

import numpy as np

from station.core.pieces import Dynamic, Limb
from station.core.units import PPQ
from station.drills.lesson import Lesson
from station.drills.library import find_lesson, lessons_dir
from station.drills.rudiments import RUDIMENTS, SOURCES, ChartStroke, Rudiment
from station.music.score import Note

PAGE = Path(__file__).parent.parent / "docs" / "rudiments.md"
HANDS = {Limb.RIGHT_HAND: "R", Limb.LEFT_HAND: "L"}
_NOTE_VALUES = {
    Fraction(4, value) * factor: f"{value}{mark}"
    for value in (1, 2, 4, 8, 16, 32)
    for mark, factor in (("", Fraction(1)), ("t", Fraction(2, 3)), (".", Fraction(3, 2)))
}
_HEAD = """# The forty rudiments: published and ours

Made by `python -m tools.rudiment_table` from the table of rudiments and the lessons themselves; do not edit.

Strokes are one round led by the right hand: small letters are grace strokes, `>` follows an accent. A rhythm gives
each main stroke's time until the next: `16` a sixteenth, `8t` an eighth of a triplet, `8.` dotted, `6x16` six of them.
Ours may stand in other note values; their relation is the published one. Where a roll ends with a rest, ours may be
longer. A drag's grace strokes are as the hand plays them, in milliseconds; the double of 35 and of 30 is measured.

## Sources
"""
_RULES = """
P gives every sticking, the accents of all but 4, 16–19, 21, 22, 24 and 26, and the rhythm of 2, 3, 7, 8, 23, 25, 28–30
and 32–40. What it does not give is from the other sources of the row. Accents and rhythms of P go back
to B's worksheet of August 2026: there the two are one source, and only the stickings were checked twice.

## Strokes and rhythm

| | rudiment | published | its rhythm | ours | its rhythm | sources |
|---|---|---|---|---|---|---|
"""
_TEMPI = """
## Tempi

Beats a minute of the lesson's beat, and strokes a second where they are densest, grace strokes apart. The goal of a
level lies under the tempo of the next. Rolls stand at 7, 10 and 13 strokes a second, the multiple bounce roll at 6 to
9 strokes of the hands, whose bounces are not judged.

| | rudiment | slow | medium | fast |
|---|---|---|---|---|
"""
_FOLDERS = (
    ("rolls", "Rolls", "Open rolls, press rolls, and the ways between them."),
    ("orchestrated", "On the kit", "Rudiments with their strokes on drums and cymbals; the hands are the rudiment's."),
)


def main_strokes(lesson: Lesson) -> list[Note]:
    """The hands' strokes without grace strokes, in the order in which they sound."""
    return sorted((n for n in lesson.score if n.limb in HANDS and not n.lead_ms), key=lambda n: n.tick)


def first_round(lesson: Lesson, strokes: int) -> list[ChartStroke]:
    """The first `strokes` main strokes of a lesson as the chart would say them."""
    notes = main_strokes(lesson)
    graces = [n.tick for n in lesson.score if n.lead_ms > 0]
    ends = [n.tick for n in notes[1:]] + [lesson.score.end_tick]
    return [
        ChartStroke(HANDS[n.limb], graces.count(n.tick), n.dynamic is Dynamic.ACCENT, Fraction(end - n.tick, PPQ))
        for n, end in zip(notes[:strokes], ends, strict=False)
    ]


def strokes_a_second(lesson: Lesson) -> float:
    """Of the hands where they are densest, at the lesson's own tempo."""
    onset_ns = lesson.score.tempo_map.ns_at(np.array([n.tick for n in main_strokes(lesson)]))
    return 1e9 / float(np.diff(onset_ns).min())


def _spelt(strokes: Sequence[ChartStroke]) -> str:
    other = {"R": "l", "L": "r"}
    return " ".join(other[s.hand] * s.graces + s.hand + ">" * s.accented for s in strokes)


def _rhythm(strokes: Sequence[ChartStroke]) -> str:
    counted = [(value, len(list(run))) for value, run in groupby(s.quarters for s in strokes)]
    return " ".join((f"{n}x" if n > 1 else "") + _NOTE_VALUES.get(v, f"{v} quarters") for v, n in counted)


def _row(rudiment: Rudiment) -> str:
    ours = first_round(find_lesson(rudiment.name), len(rudiment.chart))
    said = f"{', '.join(rudiment.sources)}{'. ' if rudiment.note else ''}{rudiment.note}"
    cells = (_spelt(rudiment.chart), _rhythm(rudiment.chart), _spelt(ours), _rhythm(ours))
    return f"| {rudiment.number} | {rudiment.title} | {' | '.join(f'`{c}`' for c in cells)} | {said} |"


def _tempi(rudiment: Rudiment) -> str:
    lessons = [find_lesson(name) for name in rudiment.lessons]
    cells = [f"{lesson.beats_a_minute:g}: {strokes_a_second(lesson):.1f}/s" for lesson in lessons]
    return f"| {rudiment.number} | {rudiment.title} | {' | '.join(cells)} |"


def _more(folder: str, title: str, about: str) -> str:
    """The table of the lessons in one folder, from easy to hard."""
    lessons = sorted(
        (find_lesson(p.stem) for p in (lessons_dir() / folder).glob("*.toml")), key=lambda x: (x.level, x.name)
    )
    rows = (
        f"| `{x.name}` | {x.title} | {x.level} | {x.beats_a_minute:g} | {strokes_a_second(x):.1f}/s |\n"
        for x in lessons
    )
    return f"\n## {title}\n{about}\n\n| lesson | | level | bpm | densest |\n|---|---|---|---|---|\n{''.join(rows)}"


def page() -> str:
    """The whole page."""
    sources = "".join(f"* **{letter}** {text}\n" for letter, text in SOURCES.items())
    rows = "".join(f"{_row(r)}\n" for r in RUDIMENTS)
    return (
        _HEAD
        + sources
        + _RULES
        + rows
        + _TEMPI
        + "".join(f"{_tempi(r)}\n" for r in RUDIMENTS)
        + "".join(_more(*folder) for folder in _FOLDERS)
    )


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
