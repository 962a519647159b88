"""How hard every lesson of every course is: writes docs/difficulty.md.

python -m tools.difficulty_table
"""

from collections.abc import Mapping, Sequence
from pathlib import Path

from scipy.stats import spearmanr

from station.core.disk.files import write_whole
from station.drills.course import Course
from station.drills.difficulty import PARTS, Difficulty, difficulty, standings
from station.drills.lesson import LEVELS, Lesson
from station.drills.library import lesson_rows, shipped_courses, shipped_lessons
from tools.course_order import Standings

PAGE = Path(__file__).parent.parent / "docs" / "difficulty.md"
TEACHERS_ORDER: tuple[str, ...] = (
    "rock-1",
    "rock-2",
    "rock-3",
    "disco-1",
    "shuffle-1",
    "jazz-ride-1",
    "hip-hop-1",
    "jazz-comping-1",
    "bossa-1",
    "funk-1",
    "paradiddle-groove-1",
    "funk-2",
    "linear-funk-1",
    "samba-1",
    "half-time-shuffle-1",
    "quintuplet-1",
)
"""Grooves from easy to hard, as we hold that any teacher would give them; written down before the first measurement."""

_HEAD = """# How hard a lesson is

Made by `python -m tools.difficulty_table`; do not edit.

`station/drills/difficulty.py` measures the loop of a lesson, as it is played round and round, and makes one number of
it, 0 to 100. It is for order: a course goes from low to high, but a lesson comes after those that it names as
prerequisites (`python -m tools.course_order` sorts). "Stands at" is where that puts it. The number is that at the
tempo to reach; `station lesson list --json` has it as `difficulty`.

## What is measured

Each figure counts from where it costs nothing up to where it counts in full, and adds that share of its weight.

| part | weight | from | in full at | what it is |
|---|---:|---:|---:|---|
"""
_WHY = """
Speed is held against people: one hand reaches 5–7 strokes a second in general, a champion 10; a foot 5–6 heel up.
Diddles' second strokes and grace strokes count half. Bits are Shannon's: independence is what is left to know of
whether a limb strikes when the other limbs and the place in the beat are known, a quarter of it on the beat, 0.6 on
the "and" and on triplets, all of it elsewhere. Syncopation is Longuet-Higgins' and Lee's (1984) at the level of the
beat. Ornaments follow the order in which teachers bring them: the technical exercises of an examination board have
single and double strokes and paradiddles in the first grade (70 bpm), flams, drags and triplets in the third (75 bpm;
multiplymusic.co.uk, "Technical exercises"); a fife-and-drum instructor's way returns to the long roll at the start of
every lesson (fifedrum.org, "Lessons").

## What it was held against

The weights are our choice. They were set on the first 86 lessons, in four rounds, with two orders before us: the level
1–5 that each lesson was given by hand, and sixteen grooves in the order that we hold any teacher would give them, which
had been written down before anything was measured. A fifth round, with 160 lessons more, made accents a line of their
own. What was written since then, and most of the levels below, the weights have not seen.

| order | lessons | rank correlation |
|---|---:|---:|
"""
_LIMITS = """
Levels are weak evidence: they are few, and those of rudiments and of grooves were not given on one scale. What the
number does not know: that a left foot is not used to leading, that quintuplets are strange at any tempo, how a groove
must feel, how long a page is to remember. A lesson that is easy to play and hard to play well has a low number.

"""


def page() -> str:
    """The whole page."""
    lessons = {one.name: one for one in shipped_lessons()}
    at_goal = {name: difficulty(one, one.target_tempo_bpm) for name, one in lessons.items()}
    parts = [f"| {name} | {p.weight:g} | {p.free:g} | {p.full:g} {p.unit} | {p.says} |" for name, p in PARTS.items()]
    rows = [*parts, _WHY.rstrip("\n"), *_orders(lessons, at_goal), _LIMITS.rstrip("\n")]
    stands = standings(
        {name: one.prerequisites for name, one in lessons.items()},
        {name: round(found.total, 1) for name, found in at_goal.items()},
    )
    tables = [_course(course, lessons, at_goal, stands) for course in shipped_courses()]
    return _HEAD + "\n".join(rows) + "\n\n" + "\n".join(tables)


def _orders(lessons: Mapping[str, Lesson], at_goal: Mapping[str, Difficulty]) -> list[str]:
    def row(what: str, order: Sequence[float], names: Sequence[str]) -> str:
        measured = [at_goal[name].total for name in names]
        return f"| {what} | {len(names)} | {spearmanr(order, measured).statistic:.2f} |"

    def levels(what: str, names: Sequence[str]) -> str:
        return row(what, [lessons[name].level for name in names], names)

    kinds = {kind: [r.name for r in lesson_rows() if r.folder == kind] for kind in ("grooves", "fills", "rudiments")}
    return [
        row("sixteen grooves, as a teacher would order them", range(len(TEACHERS_ORDER)), TEACHERS_ORDER),
        levels("levels given by hand, all", list(lessons)),
        *(levels(f"those of {kind}", names) for kind, names in kinds.items()),
    ]


def _course(course: Course, lessons: Mapping[str, Lesson], at_goal: Mapping[str, Difficulty], stands: Standings) -> str:
    head = [
        f"## {course.title}\n",
        f"| lesson | level | tempo → goal | at its tempo | at its goal | stands at | {' | '.join(PARTS)} |",
        f"|---|---|---|---:|---:|---:|{'---:|' * len(PARTS)}",
    ]
    names = [name for name in course.lessons if name in lessons]
    return "\n".join([*head, *(_row(lessons[name], at_goal[name], stands[name][0]) for name in names)]) + "\n"


def _row(lesson: Lesson, goal: Difficulty, stands: float) -> str:
    points = " | ".join(f"{points:.0f}" for points in goal.points.values())
    tempo = f"{lesson.tempo_bpm:g} → {lesson.target_tempo_bpm:g}"
    totals = f"{difficulty(lesson).total:.1f} | {goal.total:.1f} | {stands:.1f}"
    return f"| {lesson.name} | {LEVELS[lesson.level]} | {tempo} | {totals} | {points} |"


if __name__ == "__main__":
    write_whole(PAGE, page().encode())
