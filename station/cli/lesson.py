"""`station lesson`: list, show, check, write, import and export lessons."""

from dataclasses import dataclass
from pathlib import Path

from station.cli.console import print_json, say, write
from station.cli.input.read_captures import is_capture
from station.cli.input.read_scores import existing, is_midi, load_score
from station.cli.options.option_fields import Command, NoOptions, Verbs, argument, arguments, flag, required
from station.core.errors import BadInput
from station.core.files import write_whole

SCHEMA = "drum-station/lessons/1"


@dataclass(frozen=True, slots=True, kw_only=True)
class LessonsOptions:
    """How the lessons are listed."""

    json: bool = flag("print one JSON document")


@dataclass(frozen=True, slots=True, kw_only=True)
class LessonOptions:
    """Which lesson is meant."""

    lesson: str = argument("LESSON", "a lesson's name or file", str)


@dataclass(frozen=True, slots=True, kw_only=True)
class PathsOptions:
    """Which files are checked."""

    paths: tuple[str, ...] = arguments("PATH", "lessons, courses, kits, styles, settings …, or folders")


@dataclass(frozen=True, slots=True, kw_only=True)
class ImportOptions:
    """Of what a lesson is made, and where it is written."""

    source: str = argument("SOURCE", "a MIDI file, or a take", str)
    out: Path = required("FILE", "the file to write", Path)
    overwrite: bool = flag("write FILE even if there is one already")


@dataclass(frozen=True, slots=True, kw_only=True)
class ExportOptions(LessonOptions):
    """Where a lesson is written."""

    out: Path = required("FILE", "the file to write", Path)


def _list(options: LessonsOptions) -> int:
    from station.drills.lesson import LEVELS
    from station.drills.library import lesson_rows, shipped_courses

    rows = lesson_rows()
    if options.json:
        lessons = [
            {
                "name": row.name,
                "title": row.title,
                "kind": row.folder,
                "level": row.level,
                "beats_a_minute": row.beats_a_minute,
                "meter": row.meter,
                "bars": row.bars,
            }
            for row in rows
        ]
        courses = [
            {"name": one.name, "title": one.title, "level": one.level, "lessons": list(one.lessons)}
            for one in shipped_courses()
        ]
        print_json({"schema": SCHEMA, "lessons": lessons, "courses": courses})
        return 0
    folder = None
    for row in rows:
        if row.folder != folder:
            write(f"{'' if folder is None else chr(10)}{row.folder}")
            folder = row.folder
        bars = f"{row.bars:2} bar{' ' if row.bars == 1 else 's'}"
        facts = f"{row.meter}  {row.beats_a_minute:5g} bpm  {bars}  {LEVELS[row.level]:12}"
        write(f"  {row.name:26}{facts}  {row.title}")
    write("\ncourses")
    for course in shipped_courses():
        write(f"  {course.title}: {', '.join(course.lessons)}")
    return 0


def _show(options: LessonOptions) -> int:
    from station.drills.lesson_text import show
    from station.drills.library import find_lesson

    write(show(find_lesson(options.lesson).text), end="")
    return 0


def _check(options: PathsOptions) -> int:
    """Faults go to standard output, a line each; the summary and the exit status say whether there were any."""
    from station.app.toml_files import check_files

    faults, count = check_files(options.paths)
    for fault in faults:
        write(str(fault))
    say(f"{_counted(count, 'file')}: {_counted(len(faults), 'fault') if faults else 'no fault'}")
    return 2 if faults else 0


def _counted(count: int, noun: str) -> str:
    return f"{count} {noun}{'' if count == 1 else 's'}"


def _new(_: NoOptions) -> int:
    from station.drills.authoring import NEW_LESSON

    write(NEW_LESSON, end="")
    return 0


def _schema(_: NoOptions) -> int:
    from station.drills.lesson_schema import lesson_schema

    print_json(lesson_schema())
    return 0


def _import(options: ImportOptions) -> int:
    from station.drills.lesson_writer import write_lesson
    from station.drills.quantise import lesson_of, quantise_score

    if not is_midi(options.source) and not is_capture(options.source):
        raise BadInput(options.source, "", "expected a MIDI file (.mid) or a take (.capture)")
    out = options.out
    if out.suffix != ".toml":
        raise BadInput(out, "", "expected a name that ends in .toml")
    if out.exists() and not options.overwrite:
        raise BadInput(out, "", "is there already: choose another name, or say --overwrite")
    source = existing(options.source)
    score = load_score(str(source))
    if not len(score):
        raise BadInput(source, "", "there is no drum note in it")
    fitted = quantise_score(score)
    lesson = lesson_of(fitted.score, out.stem, score.title or source.stem, fitted.velocities)
    write_whole(out, write_lesson(lesson).encode())
    if fitted.moved or fitted.left_out:
        moved = f"{_counted(fitted.moved, 'stroke')} moved onto the grid, by at most {fitted.furthest_ms:.0f} ms"
        say(f"{moved}; {fitted.left_out} left out that two hands and two feet cannot play")
    say(f"lesson   {out}")
    return 0


def _export(options: ExportOptions) -> int:
    from station.drills.library import find_lesson
    from station.music.formats.smf.standard_midi import write_score

    if not is_midi(str(options.out)):
        raise BadInput(options.out, "", "expected a name that ends in .mid")
    write_score(find_lesson(options.lesson).score, options.out)
    say(f"MIDI     {options.out}")
    return 0


COMMAND = Verbs(
    (
        ("list", "the lessons and courses that are shipped", Command(LessonsOptions, _list)),
        (
            "show",
            "a lesson as it was written, its lines aligned below the count",
            Command(LessonOptions, _show),
        ),
        (
            "check",
            "every fault of lessons, courses and other TOML files, with line and column",
            Command(PathsOptions, _check),
        ),
        ("new", "print a lesson to start from", Command(NoOptions, _new)),
        ("schema", "print the JSON Schema of lessons, for editors", Command(NoOptions, _schema)),
        ("import", "write a lesson from a MIDI file or a take", Command(ImportOptions, _import)),
        ("export", "write a lesson as a MIDI file", Command(ExportOptions, _export)),
    )
)
