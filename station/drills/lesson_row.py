"""What a list of lessons says of each, and the file that keeps it, so that no list waits for hundreds of lessons.

A lesson's row is kept with the size and the time of its file: what was changed since is read anew. The file lies among
those that may vanish (`core.disk_cache`); its name has a digest of the folder and of what a row is made of.
"""

import json
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, fields
from hashlib import sha256
from pathlib import Path

from station.core.disk.files import write_whole
from station.core.disk_cache import cache_folder, forget_oldest
from station.core.errors import BadInput, DeviceError
from station.core.units import PPQ
from station.drills.difficulty import goal_difficulty
from station.drills.lesson import Lesson
from station.drills.level_range import LevelRange
from station.drills.mastery.mastery_json import from_json, to_json
from station.drills.reading.lesson_file import read_lesson
from station.scoring.matching.hit_windows import Level

_FORMAT = 2
"""Counts what a row means: another number, and every row is made anew."""
_ENDING = ".json"
_MOST_FILES = 8
"""So many folders of lessons (checkouts, versions) are remembered; our choice."""


@dataclass(frozen=True, slots=True)
class LessonRow:
    """One lesson in a list; `folder` is the kind: grooves, fills …, empty for one that lies in none.

    `tempo_bpm` counts quarter notes, `beat_quarters` is how many make the beat that a teacher counts; `bars` are all,
    `loop_bars` those that are practised. `level` 1–5 says how hard it is, `suggested` and `strictest` how strictly it
    may be judged. `difficulty` is measured at the tempo to reach, 0–100 (docs/difficulty.md). `prerequisites` name the
    lessons that come before. `is_song`: a band plays along, in its own time.
    """

    name: str
    title: str
    level: int
    tempo_bpm: float
    beat_quarters: float
    meter: str
    bars: int
    loop_bars: int
    passes: int
    folder: str
    suggested: Level
    strictest: Level
    difficulty: float
    author: str = ""
    about: str = ""
    tags: tuple[str, ...] = ()
    prerequisites: tuple[str, ...] = ()
    is_song: bool = False

    @property
    def beats_a_minute(self) -> float:
        """The tempo in the lesson's own beat, with as few decimals as it was written with."""
        return round(self.tempo_bpm / self.beat_quarters, 6)

    @property
    def levels(self) -> LevelRange:
        """The levels at which it may be judged."""
        return LevelRange(self.suggested, self.strictest)


def row_of(lesson: Lesson, folder: str = "") -> LessonRow:
    """The row of a lesson that lies in `folder`."""
    return LessonRow(
        name=lesson.name,
        title=lesson.title,
        level=lesson.level,
        tempo_bpm=lesson.tempo_bpm,
        beat_quarters=lesson.beat_ticks / PPQ,
        meter=lesson.meter,
        bars=lesson.score.bar_count,
        loop_bars=lesson.loop[1] - lesson.loop[0] + 1,
        passes=lesson.passes,
        folder=folder,
        suggested=lesson.levels.suggested,
        strictest=lesson.levels.strictest,
        difficulty=goal_difficulty(lesson),
        author=lesson.author,
        about=lesson.about,
        tags=lesson.tags,
        prerequisites=lesson.prerequisites,
        is_song=lesson.band is not None,
    )


def rows_below(top: Path, files: Mapping[Path, str]) -> list[LessonRow]:
    """The rows of `files` below the folder `top`, each with its kind; raises `BadInput` where one cannot be read."""
    path = _cache_path(top)
    kept = _kept(path)
    known = {file: _Kept(_stamp(file), row) if (row := _same(kept, top, file)) else None for file in files}
    made = {file: one or _Kept(_stamp(file), row_of(read_lesson(file), files[file])) for file, one in known.items()}
    if len(kept) != len(made) or None in known.values():
        _keep(path, {str(file.relative_to(top)): one for file, one in made.items()})
    return [one.row for one in made.values()]


# --- the file ---------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class _Kept:
    """A row, and the size and the time of the file that it was made of."""

    stamp: tuple[int, int]
    row: LessonRow


def _cache_path(top: Path) -> Path:
    made_of = [str(top.resolve()), str(_FORMAT), *(f"{field.name} {field.type}" for field in fields(LessonRow))]
    return cache_folder("lessons") / f"{sha256('|'.join(made_of).encode()).hexdigest()[:16]}{_ENDING}"


def _stamp(file: Path) -> tuple[int, int]:
    """Size in bytes and time of the last change in ns; of a file that is gone nothing that ever was."""
    try:
        facts = file.stat()
    except OSError:
        return -1, -1
    return facts.st_size, facts.st_mtime_ns


def _same(kept: Mapping[str, _Kept], top: Path, file: Path) -> LessonRow | None:
    """The row that is kept of a file that has not changed."""
    one = kept.get(str(file.relative_to(top)))
    return one.row if one is not None and one.stamp == _stamp(file) else None


def _kept(path: Path) -> dict[str, _Kept]:
    """What the file holds; nothing where it is missing or damaged."""
    try:
        document = json.loads(path.read_text(encoding="utf-8"))
        return {name: from_json(_Kept, raw, str(path), name) for name, raw in document.items()}
    except (OSError, ValueError, RecursionError, AttributeError, BadInput):
        return {}


def _keep(path: Path, rows: Mapping[str, _Kept]) -> None:
    """Write the file; where the disk refuses, the next list takes its time again."""
    with suppress(DeviceError):
        write_whole(path, json.dumps({name: to_json(one) for name, one in rows.items()}).encode())
        forget_oldest(path.parent, _ENDING, _MOST_FILES)
