"""`station practice [LESSON]`: a practice session in the window, in the terminal, or with a virtual student."""

import argparse
from dataclasses import replace
from datetime import date
from pathlib import Path

from station.app.diagnostics import has_screen
from station.app.session_checks import check_settings
from station.app.settings_store import SettingsStore
from station.cli.asking import ask_first
from station.cli.console import print_json, say
from station.cli.device_option import KIT_HELP, wanted_kits
from station.cli.read_scores import bars_of_gap
from station.cli.sound_options import add_sound_options, backing_of, said_of
from station.cli.tapping import TAP, tapped_tempo
from station.core.errors import BadInput, StationError
from station.core.settings import Settings, setting_source, with_said
from station.core.units import PPQ
from station.drills.lesson import Lesson
from station.practice.records.mastery_report import with_mastery
from station.practice.records.memory import Memory, Remembered
from station.practice.records.session_files import TEXT_NAME
from station.practice.records.session_report import practice_document, report_text, with_truth
from station.practice.session.backing_track import BackingRequest
from station.practice.session.click_options import parse_click
from station.practice.session.leading_hand import hands_of
from station.practice.session.plan import Plan, PlanOptions, plan_practice
from station.practice.session.session import SessionResult
from station.scenes.keep_session import SessionFolder, rescued
from station.scoring.report.assessment_document import Json

STAND_IN = "intermediate,seed=1"
"""Who practises where there is neither a screen nor a kit."""


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add this command's words."""
    parser.add_argument("lesson", metavar="LESSON", nargs="?", help="a lesson's name or file (the first lesson)")
    parser.add_argument(
        "--tempo",
        type=_tempo,
        metavar="BPM",
        help="quarter notes a minute, in any meter, or tap to tap it on the Enter key (the lesson's)",
    )
    parser.add_argument(
        "--adapt",
        action=argparse.BooleanOptionalAction,
        help="let tempo, bars and feedback follow the student from pass to pass (on in the window, unless --tempo)",
    )
    parser.add_argument("--loops", type=int, metavar="N", help="how often the loop is played (the lesson's)")
    parser.add_argument("--bars", type=_bars, metavar="A-B", help="bars to practise, from 1 (the lesson's loop)")
    click = parser.add_mutually_exclusive_group()
    click.add_argument("--gap", type=bars_of_gap, metavar="ON/OFF", help="bars with a click and bars without, in turn")
    click.add_argument(
        "--no-click", action="store_true", help="no click after the count-in: the score follows you, and waits"
    )
    parser.add_argument("--kit", metavar="PORT", action="append", help=KIT_HELP)
    parser.add_argument("--virtual-student", metavar="SPEC", help="who plays instead of a person, such as pro,seed=3")
    parser.add_argument(
        "--headless", action="store_true", help="no window; a virtual student plays faster than real time"
    )
    parser.add_argument("--no-demonstration", action="store_true", help="count in and play at once")
    parser.add_argument(
        "--report", type=Path, metavar="DIR", help="where to leave the session; practises in the terminal"
    )
    parser.add_argument("--no-pictures", action="store_true", help="leave a report, but no pictures")
    parser.add_argument("--student", metavar="NAME", help="whose session it is")
    parser.add_argument("--json", action="store_true", help="print the report as one JSON document; in the terminal")
    add_sound_options(parser)


def run(arguments: argparse.Namespace) -> int:
    """Practise."""
    store = _wanted(arguments)
    settings = store.now
    backing = backing_of(arguments)
    if arguments.no_click and arguments.adapt:
        raise BadInput("--no-click", "--adapt", "the tempo follows you either within a pass or from pass to pass")
    lesson = _lesson(arguments.lesson)
    if arguments.tempo == TAP:
        arguments.tempo = tapped_tempo(lesson.beat_ticks / PPQ)
    wishes = _wishes(arguments, settings)
    plan = plan_practice(lesson, wishes)
    if backing is not None:
        backing.check(plan, settings.rate_hz)
    if arguments.virtual_student is not None:
        return _virtual(plan, wishes, arguments.virtual_student, arguments, settings)
    in_terminal = arguments.headless or arguments.json or arguments.report is not None
    if not in_terminal and has_screen():
        from station.cli.window import open_window

        by_default = arguments.tempo is None and not arguments.no_click and backing is None
        adapt = by_default if arguments.adapt is None else arguments.adapt
        return open_window(store, plan, adapt, backing)
    if not in_terminal and arguments.kit is None and not _is_kit_there(settings.kit):
        say("no screen and no kit here: a virtual student practises instead")
        return _virtual(plan, wishes, STAND_IN, arguments, settings)
    return _live(plan, wishes, arguments, settings, backing)


# --- ways to practise ------------------------------------------------------------------------------------------------


def _virtual(plan: Plan, wishes: PlanOptions, spec: str, arguments: argparse.Namespace, settings: Settings) -> int:
    """A virtual student is new to every lesson, and forgotten, unless it practises under a name."""
    if arguments.midi_out is not None or arguments.track is not None:
        say("a virtual student practises without sound: nothing is sent to a MIDI output, and no track plays")
    from station.practice.headless.virtual_session import practise_adaptively, practise_virtually
    from station.simulation.student_spec import parse_spec

    student = parse_spec(spec)
    remembered = _remembered(plan, wishes, settings, arguments.student is not None) if arguments.adapt else None
    with SessionFolder(arguments.report, settings, plan.lesson.name) as folder:
        if remembered is None:
            virtual = practise_virtually(plan, student, folder.capture)
        else:
            virtual = practise_adaptively(remembered.adaptation, student, folder.capture)
        document = with_truth(practice_document(virtual.result, settings), virtual, settings)
        _leave(folder, virtual.result, document, arguments, remembered)
    if virtual.fault is not None:
        raise virtual.fault
    return 0


def _live(
    plan: Plan, wishes: PlanOptions, arguments: argparse.Namespace, settings: Settings, backing: BackingRequest | None
) -> int:
    from station.cli.terminal import practise_in_terminal

    remembered = _remembered(plan, wishes, settings, keeps=True) if arguments.adapt else None
    with SessionFolder(arguments.report, settings, plan.lesson.name) as folder:
        outcome = practise_in_terminal(
            plan if remembered is None else remembered.adaptation, settings, folder.capture, backing
        )
        may_ask = settings.ask_first and not arguments.json
        _leave(folder, outcome.result, practice_document(outcome.result, settings), arguments, remembered, may_ask)
    if outcome.fault is not None:
        raise outcome.fault
    return 0


def _remembered(plan: Plan, wishes: PlanOptions, settings: Settings, keeps: bool) -> Remembered:
    """Practice that follows the student; what could not be read is said at once."""
    memory = Memory.of(settings.sessions_dir, settings.student, plan.lesson.name, plan.bars) if keeps else None
    remembered = Remembered.of(plan.lesson, wishes, date.today(), memory)
    if remembered.fault is not None:
        say(remembered.fault)
    return remembered


def _is_kit_there(wanted: str) -> bool:
    from station.devices.device_ports import devices_there, parse_kits

    return bool(devices_there(parse_kits(wanted)))


def _leave(
    folder: SessionFolder,
    result: SessionResult,
    document: dict[str, Json],
    arguments: argparse.Namespace,
    remembered: Remembered | None,
    may_ask: bool = False,
) -> None:
    """Write everything, then print the report; what the disk refused is said after the report was printed.

    `may_ask`: a person played, who may be asked for an opinion before the report is there.
    """
    fault = None
    if remembered is not None:
        document = with_mastery(document, remembered.adaptation, remembered.next_turn())
    try:
        folder.write(result, document)
        if remembered is not None:
            remembered.keep()
    except StationError as error:
        fault = rescued(error, result, document)
    if may_ask:
        ask_first(document)
    if arguments.json:
        print_json(document)
    else:
        print(report_text(document), end="", flush=True)
        if "pairs_csv" in document:
            print(f"\n{document['pairs_csv']}", end="", flush=True)
    if fault is not None:
        raise fault
    say(f"\nreport   {folder.path / TEXT_NAME}")
    if arguments.no_pictures:
        return
    try:
        for picture in folder.draw(result, document):
            say(f"picture  {picture}")
    except StationError as error:
        say(f"no picture: {error}")


# --- what was asked --------------------------------------------------------------------------------------------------


def _lesson(name: str | None) -> Lesson:
    from station.drills.library import FIRST_LESSON, find_lesson

    return find_lesson(FIRST_LESSON if name is None else name)


def _wishes(arguments: argparse.Namespace, settings: Settings) -> PlanOptions:
    demonstrations = 0 if arguments.no_demonstration else None
    pattern = parse_click(settings.click_pattern, setting_source("click_pattern"))
    click = None if arguments.no_click else replace(pattern, gap=arguments.gap)
    hands = hands_of(settings)
    return PlanOptions(arguments.tempo, arguments.loops, arguments.bars, demonstrations, click, settings.guide, hands)


def _wanted(arguments: argparse.Namespace) -> SettingsStore:
    """The settings with what the command line says instead for this once, kept where that is asked for."""
    kept = SettingsStore()
    if kept.fault is not None:
        if arguments.remember:
            raise kept.fault
        say(f"{kept.fault}; the default settings hold")
    said = {**said_of(arguments), "kit": wanted_kits(arguments.kit, kept.now.kit)}
    if arguments.student is not None:
        said["student"] = arguments.student
    store = SettingsStore(said=said, source="practice")
    check_settings(store.now)
    if arguments.remember:
        kept.update(lambda settings: with_said(settings, said, "practice"))
        say(f"remembered in {kept.write()}")
    return store


def _tempo(text: str) -> float | str:
    if text == TAP:
        return text
    try:
        return float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"expected a number, found {text!r} (or {TAP}, to tap it)") from None


def _bars(text: str) -> tuple[int, int]:
    first, dash, last = text.partition("-")
    try:
        return int(first), int(last if dash else first)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r}: expected two bars such as 1-4") from None
