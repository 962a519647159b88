"""`station lesson`: list, show, check, write, import and export lessons."""

import argparse
import sys
from pathlib import Path

from station.cli.console import print_json, say
from station.cli.read_scores import existing, is_capture, is_midi, load_score
from station.core.errors import BadInput
from station.core.files import write_whole

SCHEMA = "drum-station/lessons/1"


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add this command's words."""
    verbs = parser.add_subparsers(dest="verb", required=True, metavar="VERB")
    listing = verbs.add_parser("list", help="the lessons and courses that are shipped")
    listing.add_argument("--json", action="store_true", help="print one JSON document")
    show = verbs.add_parser("show", help="a lesson, written out")
    show.add_argument("lesson", metavar="LESSON", help="a lesson's name or file")
    check = verbs.add_parser("check", help="every fault of lessons, courses and other TOML files, with line and column")
    check.add_argument(
        "paths",
        metavar="PATH",
        nargs="+",
        help="lessons, courses, kits, styles, settings …, or folders",
    )
    verbs.add_parser("new", help="print a lesson to start from")
    importing = verbs.add_parser("import", help="write a lesson from a MIDI file or a take")
    importing.add_argument("source", metavar="SOURCE", help="a MIDI file, or a take")
    exporting = verbs.add_parser("export", help="write a lesson as a MIDI file")
    exporting.add_argument("lesson", metavar="LESSON", help="a lesson's name or file")
    for verb in (importing, exporting):
        verb.add_argument("--out", metavar="FILE", type=Path, required=True, help="the file to write")
    importing.add_argument("--overwrite", action="store_true", help="write FILE even if there is one already")


def run(arguments: argparse.Namespace) -> int:
    """Do what the verb says."""
    verbs = {"list": _list, "show": _show, "check": _check, "new": _new, "import": _import, "export": _export}
    return verbs[arguments.verb](arguments)


def _list(arguments: argparse.Namespace) -> int:
    from station.drills.lesson import LEVELS
    from station.drills.library import lesson_rows, shipped_courses

    rows = lesson_rows()
    if arguments.json:
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
            print(f"{'' if folder is None else chr(10)}{row.folder}")
            folder = row.folder
        bars = f"{row.bars:2} bar{' ' if row.bars == 1 else 's'}"
        facts = f"{row.meter}  {row.beats_a_minute:5g} bpm  {bars}  {LEVELS[row.level]:12}"
        print(f"  {row.name:26}{facts}  {row.title}")
    print("\ncourses")
    for course in shipped_courses():
        print(f"  {course.title}: {', '.join(course.lessons)}")
    return 0


def _show(arguments: argparse.Namespace) -> int:
    from station.drills.lesson_writer import write_lesson
    from station.drills.library import find_lesson

    sys.stdout.write(write_lesson(find_lesson(arguments.lesson)))
    return 0


def _check(arguments: argparse.Namespace) -> int:
    """Faults go to standard output, a line each; the summary and the exit status say whether there were any."""
    from station.app.toml_files import check_files

    faults, count = check_files(arguments.paths)
    for fault in faults:
        print(fault)
    say(f"{_counted(count, 'file')}: {_counted(len(faults), 'fault') if faults else 'no fault'}")
    return 2 if faults else 0


def _counted(count: int, noun: str) -> str:
    return f"{count} {noun}{'' if count == 1 else 's'}"


def _new(_: argparse.Namespace) -> int:
    from station.drills.authoring import NEW_LESSON

    sys.stdout.write(NEW_LESSON)
    return 0


def _import(arguments: argparse.Namespace) -> int:
    from station.drills.lesson_writer import write_lesson
    from station.drills.quantise import fit_score, lesson_of

    if not is_midi(arguments.source) and not is_capture(arguments.source):
        raise BadInput(arguments.source, "", "expected a MIDI file (.mid) or a take (.capture)")
    out: Path = arguments.out
    if out.suffix != ".toml":
        raise BadInput(out, "", "expected a name that ends in .toml")
    if out.exists() and not arguments.overwrite:
        raise BadInput(out, "", "is there already: choose another name, or say --overwrite")
    source = existing(arguments.source)
    score = load_score(str(source))
    if not len(score):
        raise BadInput(source, "", "there is no drum note in it")
    fitted = fit_score(score)
    lesson = lesson_of(fitted.score, out.stem, score.title or source.stem, fitted.velocities)
    write_whole(out, write_lesson(lesson).encode())
    if fitted.moved or fitted.left_out:
        moved = f"{_counted(fitted.moved, 'stroke')} moved onto the grid, by at most {fitted.furthest_ms:.0f} ms"
        say(f"{moved}; {fitted.left_out} left out that two hands and two feet cannot play")
    say(f"lesson   {out}")
    return 0


def _export(arguments: argparse.Namespace) -> int:
    from station.drills.library import find_lesson
    from station.music.formats.smf.standard_midi import write_score

    if not is_midi(str(arguments.out)):
        raise BadInput(arguments.out, "", "expected a name that ends in .mid")
    write_score(find_lesson(arguments.lesson).score, arguments.out)
    say(f"MIDI     {arguments.out}")
    return 0
