"""The courses that ship, put in order: each by measured difficulty, and what no course has.

    python -m tools.course_order            # names what is out of order and what no course has
    python -m tools.course_order --write    # sorts the lessons of each course's file

Lessons that are equally hard keep their order. A lesson follows those of its course that it names as prerequisites.
"""

import re
import sys
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from station.core.files import write_whole
from station.drills.course import Course
from station.drills.difficulty import goal_difficulty
from station.drills.lesson import Lesson
from station.drills.library import lessons_dir, shipped_courses, shipped_lessons

_LESSONS = re.compile(r"(?<=^lessons = \[\n).*?(?=^\])", re.DOTALL | re.MULTILINE)


def in_order(course: Course, hardness: Callable[[str], float]) -> tuple[str, ...]:
    """The lessons of a course from easy to hard."""
    return tuple(sorted(course.lessons, key=hardness))


def left_out(courses: Sequence[Course], lessons: Mapping[str, Lesson]) -> list[str]:
    """The lessons that no course has, by name."""
    return sorted(set(lessons) - {name for course in courses for name in course.lessons})


def before_their_time(course: Course, lessons: Mapping[str, Lesson]) -> list[str]:
    """The lessons of a course that come before one of their prerequisites in it."""
    at = {name: i for i, name in enumerate(course.lessons)}
    return [name for name in course.lessons if any(at.get(p, -1) > at[name] for p in lessons[name].prerequisites)]


def with_lessons(text: str, names: Sequence[str]) -> str:
    """The text of a course's file with these lessons, one a row."""
    rows = "".join(f'  "{name}",\n' for name in names)
    return _LESSONS.sub(lambda _: rows, text, count=1)


def main(words: Sequence[str]) -> int:
    """Say, or with `--write` mend, the order; 1 where something is left to do."""
    lessons = {one.name: one for one in shipped_lessons()}
    hardness = {name: goal_difficulty(one) for name, one in lessons.items()}
    courses = shipped_courses()
    unsorted = [course for course in courses if in_order(course, hardness.__getitem__) != course.lessons]
    for course in unsorted:
        if "--write" in words:
            path = Path(lessons_dir(), "courses", f"{course.name}.course.toml")
            text = with_lessons(path.read_text(encoding="utf-8"), in_order(course, hardness.__getitem__))
            write_whole(path, text.encode())
        print(f"{course.name}: {'sorted' if '--write' in words else 'not in the order of difficulty'}")
    missing = left_out(courses, lessons)
    early = [
        f"{course.name}: {name} before its prerequisite"
        for course in courses
        for name in before_their_time(course, lessons)
    ]
    print("\n".join([*early, *(f"in no course: {name}" for name in missing)]))
    return 1 if missing or early or (unsorted and "--write" not in words) else 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
