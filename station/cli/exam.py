"""`station exam [LESSON]`: one take of a lesson or of unseen reading, marked by a rubric that is shown before."""

import time
from contextlib import ExitStack
from dataclasses import dataclass, replace
from pathlib import Path

from station.app.sessions.session_checks import check_settings
from station.app.settings.settings_store import SettingsStore
from station.cli.console import print_json, say, write
from station.cli.input.caught_up import caught_up
from station.cli.input.enter_keys import NextEnter, enter_keys
from station.cli.options.device_option import devices_option, wanted_kits
from station.cli.options.option_fields import Command, choice, flag, number, option, optional_argument, whole_number
from station.cli.options.virtual_students import whose
from station.core.disk.files import write_whole
from station.core.errors import BadInput, StationError
from station.core.settings import Settings
from station.drills.exam.exam_piece import PREVIEW_S, ExamPiece, Unseen, prepared_piece, reading_piece
from station.practice.exam.exam_record import exam_document, marks_text, rubric_text
from station.practice.exam.exam_sitting import Sitting, drawn_seed
from station.practice.exam.exam_take import exam_plan
from station.practice.history.session_files import TEXT_NAME
from station.practice.records.report.session_report import practice_document, with_truth
from station.practice.records.save_session import save
from station.practice.session.session import SessionResult
from station.scoring.matching.hit_windows import OUR_LEVELS, Level
from station.scoring.report.assessment_document import Json

SHEET_NAME = "reading.pdf"
_COUNTED_S = (60, 30, 10)
"""What is said of the time that is left (our choice)."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ExamOptions:
    """What is played, how it is judged, and what is left of it."""

    lesson: str | None = optional_argument("LESSON", "a lesson that was prepared; left out, unseen reading")
    reading: int | None = option("L", "how hard the unseen piece is, 1 to 5 (1)", whole_number, None)
    seed: int | None = option(
        "N", "which unseen piece; the same number is the same piece (a new one)", whole_number, None
    )
    preview: float | None = option(
        "SECONDS", f"how long it may be looked at ({PREVIEW_S:g}; 0 of a lesson)", number, None
    )
    tempo: float | None = option("BPM", "quarter notes a minute (the goal of the lesson)", number, None)
    level: Level | None = choice(OUR_LEVELS, "how strictly is judged (as the piece suggests)", None)
    device: tuple[str, ...] = devices_option()
    virtual_student: str | None = option("SPEC", "who plays instead of a person, such as pro,seed=3", str, None)
    student: str | None = option("NAME", "whose exam it is", str, None)
    report: Path | None = option("DIR", "where to leave the exam", Path, None)
    rubric: bool = flag("print what is asked, and play nothing")
    json: bool = flag("print the exam as one JSON document")


def run(options: ExamOptions) -> int:
    """Hold the exam."""
    settings, piece = _wanted(options), _piece(options)
    exam_plan(piece, settings)  # what cannot be played is not asked
    if options.rubric:
        _print(exam_document(piece, None, seen_before=False), rubric_text(piece), options.json)
        return 0
    if options.virtual_student is not None:
        settings = whose(settings, options.student)
    caught_up(settings)
    say(rubric_text(piece))
    fault = _hold(Sitting.begin(piece, settings, options.report), options, settings)
    if fault is not None:
        raise fault
    return 0


def _hold(sitting: Sitting, options: ExamOptions, settings: Settings) -> StationError | None:
    """Let it be played, and keep and print the marks; returns what went wrong on the way."""
    with ExitStack() as until_saved:
        result, document, fault = _played(sitting, options, settings, until_saved)
        saved = save(sitting.folder, result, document)
        sitting.keep(marks := sitting.marks(result))
    _print(sitting.document(marks), marks_text(marks, sitting.seen_before), options.json)
    if saved.unkept is not None:
        say(saved.unkept)
    say(f"report   {sitting.folder.path / TEXT_NAME}")
    return saved.fault or fault


def _played(
    sitting: Sitting, options: ExamOptions, settings: Settings, until_saved: ExitStack
) -> tuple[SessionResult, dict[str, Json], StationError | None]:
    """The take, its report, and what went wrong; a virtual student reads at once."""
    piece, plan, folder = sitting.piece, sitting.plan, sitting.folder
    if options.virtual_student is not None:
        from station.practice.headless.virtual_session import practise_virtually
        from station.simulation.student_spec import parse_spec

        virtual = practise_virtually(plan, parse_spec(options.virtual_student), folder.capture)
        document = with_truth(practice_document(virtual.result, settings), virtual, settings)
        return virtual.result, document, virtual.fault
    from station.cli.practising.terminal import practise_in_terminal

    if piece.preview_s:
        _show_notes(piece, folder.path)
        look(piece.preview_s, enter_keys())
    outcome = practise_in_terminal(plan, settings, folder.capture, until_saved, is_exam=True)
    return outcome.result, practice_document(outcome.result, settings), outcome.fault


def _show_notes(piece: ExamPiece, folder: Path) -> None:
    """The notes as text, and as a sheet in the exam's folder."""
    from station.scenes.sheets import lesson_labels, pdf_of

    lesson = piece.lesson
    bars = 0, lesson.score.bar_count - 1
    path = folder / SHEET_NAME
    write_whole(path, pdf_of(lesson.score, bars, replace(lesson_labels(lesson, bars), about=""), "a4"))
    grids = lesson.text[lesson.text.index("[grid]" if "\n[grid]" in lesson.text else "[[grid]]") :]
    say(f"{grids}\nsheet    {path}")


def look(preview_s: float, next_enter: NextEnter) -> None:
    """Wait until the time to look is over, or Enter says that it was enough; say now and then what is left."""
    left_s = preview_s
    say(f"{left_s:g} seconds to look; Enter begins sooner")
    for until_s in (*(mark for mark in _COUNTED_S if mark < preview_s), 0):
        try:
            if next_enter(left_s - until_s) is not None:
                return
        except EOFError:  # nobody can press it: the time goes on
            time.sleep(left_s - until_s)
        left_s = until_s
        if left_s:
            say(f"{left_s} seconds")


def _print(document: dict[str, Json], text: str, as_json: bool) -> None:
    if as_json:
        print_json(document)
    else:
        write(text, end="")


def _piece(options: ExamOptions) -> ExamPiece:
    """What is asked for; raises `BadInput`."""
    if options.lesson is None:
        seed = drawn_seed() if options.seed is None else options.seed
        preview_s = PREVIEW_S if options.preview is None else options.preview
        piece = reading_piece(Unseen(1 if options.reading is None else options.reading, seed), options.level, preview_s)
        return piece if options.tempo is None else replace(piece, tempo_bpm=options.tempo)
    for name, said in (("--seed", options.seed), ("--reading", options.reading)):
        if said is not None:
            raise BadInput(name, "", "a prepared lesson has none; leave LESSON out for unseen reading")
    from station.app.music_files.find_own_lesson import find_any_lesson

    lesson = find_any_lesson(options.lesson)
    return prepared_piece(lesson, options.tempo, options.level, options.preview or 0.0)


def _wanted(options: ExamOptions) -> Settings:
    """The settings with what the command line says instead."""
    said: dict[str, object] = {"kit": wanted_kits(options.device, SettingsStore().now.kit)}
    if options.student is not None:
        said["student"] = options.student
    store = SettingsStore(said=said, source="exam")
    check_settings(store.now)
    return store.now


COMMAND = Command(ExamOptions, run)
