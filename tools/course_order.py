"""The courses that ship, put in order: each by measured difficulty, in parts, and what no course has.

    python -m tools.course_order            # names what is out of order and what no course has
    python -m tools.course_order --write    # sorts the lessons of each course's file into parts

A lesson comes after what it names as prerequisites (`difficulty.standings`).
"""

import re
import sys
from collections.abc import Mapping, Sequence
from itertools import groupby
from pathlib import Path

from station.core.disk.files import write_whole
from station.drills.course import Course
from station.drills.difficulty import goal_difficulty, standings
from station.drills.library import lesson_prerequisites, lessons_dir, shipped_courses, shipped_lessons

PARTS_FROM = {"To begin with": 0.0, "The next step": 12.0, "Halfway": 18.0, "Further on": 24.0, "The hardest": 30.0}
"""Where the parts of a course begin: about halfway between what the lessons of neighbouring levels have in the middle,
10, 17, 22, 27 and 29 (our choice)."""
_LESSONS = re.compile(r"^(lessons = \[|\[\[part\]\]).*", re.DOTALL | re.MULTILINE)

Standings = Mapping[str, tuple[float, int]]


def in_order(course: Course, standing: Standings) -> list[str]:
    """The lessons of a course from easy to hard; equals keep their order."""
    return sorted(course.lessons, key=lambda name: standing[name])


def parts(names: Sequence[str], standing: Standings) -> list[tuple[str, list[str]]]:
    """Lessons that are in order, under the titles of `PARTS_FROM`."""

    def title(name: str) -> str:
        return [title for title, start in PARTS_FROM.items() if standing[name][0] >= start][-1]

    return [(one, list(group)) for one, group in groupby(names, title)]


def with_parts(text: str, course_parts: Sequence[tuple[str, Sequence[str]]]) -> str:
    """The text of a course's file with these parts in place of its lessons."""
    tables = [f'[[part]]\ntitle = "{title}"\nlessons = [\n{_rows(names)}]\n' for title, names in course_parts]
    return _LESSONS.sub("", text).rstrip() + "\n\n" + "\n".join(tables)


def _rows(names: Sequence[str]) -> str:
    return "".join(f'  "{name}",\n' for name in names)


def left_out(courses: Sequence[Course], names: Sequence[str]) -> list[str]:
    """The lessons that no course has, by name."""
    return sorted(set(names) - {name for course in courses for name in course.lessons})


def main(words: Sequence[str]) -> int:
    """Say, or with `--write` mend, the order; 1 where something is left to do."""
    standing = standings(lesson_prerequisites(), {one.name: goal_difficulty(one) for one in shipped_lessons()})
    courses = shipped_courses()
    wrong = [course for course in courses if in_order(course, standing) != list(course.lessons)]
    write = "--write" in words
    for course in courses if write else ():
        path = Path(lessons_dir(), "courses", f"{course.name}.course.toml")
        text = with_parts(path.read_text(encoding="utf-8"), parts(in_order(course, standing), standing))
        write_whole(path, text.encode())
    missing = left_out(courses, list(standing))
    for course in wrong:
        print(f"{course.name}: {'sorted' if write else 'out of order'}")  # noqa: T201 - what it is run for
    for name in missing:
        print(f"in no course: {name}")  # noqa: T201
    return 1 if missing or (wrong and not write) else 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
