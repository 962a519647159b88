"""`station lesson`: list, show, check, write, import and export lessons."""

from dataclasses import dataclass
from pathlib import Path

from station.app.music_files.named_parts import load_part
from station.cli import lesson_list
from station.cli.console import print_json, say, write
from station.cli.options.option_fields import (
    Command,
    NoOptions,
    Verbs,
    argument,
    arguments,
    flag,
    option,
    optional_argument,
    required,
    said,
    whole_number,
)
from station.core.counts import counted
from station.core.disk.files import write_whole
from station.core.errors import BadInput
from station.music.formats.format_table import writer_for


@dataclass(frozen=True, slots=True, kw_only=True)
class LessonOptions:
    """Which lesson is meant."""

    lesson: str = argument("LESSON", "a lesson's name or file", str)


@dataclass(frozen=True, slots=True, kw_only=True)
class PathsOptions:
    """Which files are checked."""

    paths: tuple[str, ...] = arguments("PATH", "lessons, courses, kits, styles, settings …, or folders")


@dataclass(frozen=True, slots=True, kw_only=True)
class NewOptions:
    """What the new lesson is made of, and where it is written."""

    family: str | None = optional_argument("FAMILY", "a family of drills; left out, a lesson to start from")
    level: int = option("L", "how hard, 1 to 5 (2)", whole_number, 2)
    seed: int = option("N", "which of the family; the same number gives the same lesson (1)", whole_number, 1)
    bars: int = option("B", "how many bars (4)", whole_number, 4)
    out: Path | None = option("FILE", "the file to write; left out, it is printed", Path, None)
    overwrite: bool = flag("write FILE even if there is one already")
    said: frozenset[str] = said()


@dataclass(frozen=True, slots=True, kw_only=True)
class ImportOptions:
    """Of what a lesson is made, and where it is written."""

    source: str = argument("SOURCE", "a music file, a take, a song's folder, or a GrooveScribe link", str)
    out: Path = required("FILE", "the file to write", Path)
    overwrite: bool = flag("write FILE even if there is one already")


@dataclass(frozen=True, slots=True, kw_only=True)
class ExportOptions:
    """What is written, and where."""

    score: str = argument("SCORE", "a lesson, a music file or a take (.capture)", str)
    out: Path = required("FILE", "the file to write; its ending says the format", Path)
    overwrite: bool = flag("write FILE even if there is one already")


def _show(options: LessonOptions) -> int:
    from station.app.music_files.find_own_lesson import find_any_lesson
    from station.drills.writing.lesson_text import show

    write(show(find_any_lesson(options.lesson).text), end="")
    return 0


def _check(options: PathsOptions) -> int:
    """Faults go to standard output, a line each; the summary and the exit status say whether there were any."""
    from station.app.toml_files import check_files

    faults, count = check_files(options.paths)
    for fault in faults:
        write(str(fault))
    say(f"{counted(count, 'file')}: {counted(len(faults), 'fault') if faults else 'no fault'}")
    return 2 if faults else 0


def _new(options: NewOptions) -> int:
    text = _new_text(options)
    if options.out is None:
        write(text, end="")
        return 0
    _check_lesson_name(options.out, options.overwrite)
    write_whole(options.out, text.encode())
    say(f"lesson   {options.out}")
    return 0


def _schema(_: NoOptions) -> int:
    from station.drills.writing.lesson_schema import lesson_schema

    print_json(lesson_schema())
    return 0


def _new_text(options: NewOptions) -> str:
    """The lesson of the family that is asked for, or the one to start from, which comes in one shape alone."""
    from station.drills.families.family_table import FAMILIES, lesson_text
    from station.drills.writing.authoring import NEW_LESSON

    if options.family is not None:
        return lesson_text(options.family, options.level, options.seed, options.bars)
    if shapes := sorted(options.said & {"level", "seed", "bars"}):
        raise BadInput(f"--{shapes[0]}", "", f"of which family? There are {', '.join(FAMILIES)}")
    return NEW_LESSON


def _check_lesson_name(out: Path, overwrite: bool) -> None:
    """Raises `BadInput` for a name that is no lesson's, and for a file that is there already."""
    if out.suffix != ".toml":
        raise BadInput(out, "", "expected a name that ends in .toml")
    _check_free(out, overwrite)


def _check_free(out: Path, overwrite: bool) -> None:
    """Raises `BadInput` for a file that is there already."""
    if out.exists() and not overwrite:
        raise BadInput(out, "", "is there already: choose another name, or say --overwrite")


def _import(options: ImportOptions) -> int:
    from station.app.music_files.lesson_import import import_lesson

    _check_lesson_name(options.out, options.overwrite)
    made = import_lesson(options.source, options.out.stem)
    write_whole(options.out, made.text.encode())
    for remark in made.remarks:
        say(remark)
    for line in made.lost:
        say(f"lost     {line}")
    say(f"lesson   {options.out}")
    return 0


def _export(options: ExportOptions) -> int:
    from station.app.music_files.part_export import write_part

    known = writer_for(options.out)
    _check_free(options.out, options.overwrite)
    for line in write_part(load_part(options.score), options.out):
        say(f"lost     {line}")
    say(f"{known.name:8} {options.out}")
    return 0


COMMAND = Verbs(
    (
        ("list", "the lessons and courses, and how far you are with them", lesson_list.COMMAND),
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
        ("new", "a lesson to start from, or a drill of a family", Command(NewOptions, _new)),
        ("schema", "print the JSON Schema of lessons, for editors", Command(NoOptions, _schema)),
        ("import", "write a lesson from a music file or a take", Command(ImportOptions, _import)),
        ("export", "write a lesson, a take or another music file as a music file", Command(ExportOptions, _export)),
    )
)
