"""`station practice [LESSON]`: a practice session in the window, in the terminal, or with a virtual student."""

from contextlib import ExitStack
from dataclasses import replace
from datetime import date
from typing import Any

from station.app.equipment.diagnostics import has_screen
from station.app.sessions.session_checks import check_settings
from station.app.settings.settings_store import SettingsStore
from station.cli.console import say
from station.cli.input.caught_up import caught_up
from station.cli.options.device_option import wanted_kits, wanted_sticks
from station.cli.options.option_fields import Command
from station.cli.options.virtual_students import whose
from station.cli.practising.practice_options import PracticeOptions
from station.cli.practising.practice_plan import AskedPractice, asked_practice, lesson_of
from station.cli.practising.practice_report import leave_report
from station.core.errors import BadInput
from station.core.settings import Settings, with_said
from station.drills.lesson import Lesson
from station.practice.history.student_history import StudentHistory
from station.practice.records.earlier_lags import fair_session
from station.practice.records.lesson_order import first_words, followed_course, shipped_title
from station.practice.records.memory import Memory, Remembered, following_lesson
from station.practice.records.recovery import offer, recovered
from station.practice.records.report.session_report import practice_document, with_truth
from station.practice.records.save_session import SessionFolder, save
from station.practice.records.student_progress import student_progress
from station.practice.records.teachers_wishes import wishes_of

STAND_IN = "intermediate,seed=1"
"""Who practises where there is neither a screen nor a kit."""


def run(options: PracticeOptions) -> int:
    """Practise."""
    store = _wanted(options)
    settings = store.now
    if options.recover is not None:
        return _recover(SessionFolder.left_over(options.recover, settings), options, settings)
    return _todays_block(options, store) if options.today else _practise(options, store)


def _todays_block(options: PracticeOptions, store: SettingsStore) -> int:
    """Practise what the day's plan has next, and say what follows."""
    from station.cli.practising.todays_block import block_options, next_block, say_block, say_what_follows

    item = next_block(store.now)
    planned: dict[str, Any] = block_options(item, lesson_of(item.lesson))
    for name in planned:
        if getattr(options, name) is not None:
            raise BadInput("--today", name, "the plan says so already; leave one of them out")
    say_block(item)
    status = _practise(replace(options, **planned), store)
    say_what_follows(store.now)
    return status


def _practise(options: PracticeOptions, store: SettingsStore) -> int:
    settings = store.now
    asked = asked_practice(options, settings)
    if options.virtual_student is not None:
        return _virtual(asked, options.virtual_student, options, settings)
    in_terminal = options.headless or options.json or options.report is not None
    if not in_terminal and has_screen():
        from station.cli.window import open_window

        return open_window(store, asked.plan, asked.adapts, asked.backing, options.watch.watch())
    if not in_terminal and not options.device and not _is_kit_there(settings.kit):
        say("no screen and no kit here: a virtual student practises instead")
        return _virtual(asked, STAND_IN, options, settings)
    _say_what_comes_first(asked.plan.lesson, settings)
    return _live(asked, options, settings)


def _say_what_comes_first(lesson: Lesson, settings: Settings) -> None:
    """Name the lessons that should come before; the window does so itself."""
    if lesson.prerequisites:
        progress = student_progress(StudentHistory.of(settings))
        for line in first_words(lesson.prerequisites, progress, shipped_title):
            say(line)


def _virtual(asked: AskedPractice, spec: str, options: PracticeOptions, settings: Settings) -> int:
    """A virtual student is new to every lesson, and forgotten, unless it practises under a name."""
    if options.sound.midi_out is not None or options.track.track is not None:
        say("a virtual student practises without sound: nothing is sent to a MIDI output, and no track plays")
    from station.practice.headless.virtual_session import practise_adaptively, practise_virtually
    from station.simulation.student_spec import parse_spec

    student, plan = parse_spec(spec), asked.plan
    settings = caught_up(whose(settings, options.student))
    remembered = _remembered(asked, settings, options.student is not None) if options.adapt else None
    with SessionFolder.make(options.report, settings, plan.lesson.name) as folder:
        if remembered is None:
            virtual = practise_virtually(plan, student, folder.capture)
        else:
            virtual = practise_adaptively(remembered.adaptation, student, folder.capture)
        document = with_truth(practice_document(virtual.result, settings), virtual, settings)
        leave_report(folder, save(folder, virtual.result, document, remembered), options, settings)
    if virtual.fault is not None:
        raise virtual.fault
    return 0


def _live(asked: AskedPractice, options: PracticeOptions, settings: Settings) -> int:
    from station.cli.practising.terminal import practise_in_terminal

    cut_off = offer(caught_up(settings))
    if cut_off is not None:
        say(cut_off)
    remembered = _remembered(asked, settings, keeps=True) if options.adapt else None
    with SessionFolder.make(options.report, settings, asked.plan.lesson.name) as folder:
        with ExitStack() as until_saved:
            played = asked.plan if remembered is None else remembered.adaptation
            outcome = practise_in_terminal(played, settings, folder.capture, until_saved, asked.backing)
            fair = fair_session(outcome.result, settings)
            following = following_lesson(settings, asked.plan.lesson, date.today()) if remembered is None else None
            saved = save(folder, fair.result, practice_document(fair.result, settings, fair.lag, following), remembered)
        may_ask = settings.ask_first and outcome.is_attended and not options.json
        leave_report(folder, saved, options, settings, may_ask)
    if outcome.fault is not None:
        raise outcome.fault
    return 0


def _remembered(asked: AskedPractice, settings: Settings, keeps: bool) -> Remembered:
    """Practice that follows the student; what could not be read is said at once."""
    lesson, bars, today = asked.plan.lesson, asked.plan.bars, date.today()
    memory = Memory(StudentHistory.of(settings), lesson.name, bars) if keeps else None
    wishes = wishes_of(settings, today)
    followed = Remembered.of(lesson, asked.options, today, memory, followed_course(settings), wishes)
    if followed.fault is not None:
        say(followed.fault)
    return followed


def _is_kit_there(wanted: str) -> bool:
    from station.devices.device_ports import devices_there, parse_devices

    return bool(devices_there(parse_devices(wanted)))


def _recover(folder: SessionFolder, options: PracticeOptions, settings: Settings) -> int:
    """Judge a session that was cut off, and leave what it would have left; what is remembered stays as it is."""
    fair = fair_session(recovered(folder.capture), settings)
    document = practice_document(fair.result, settings, fair.lag)
    leave_report(folder, save(folder, fair.result, document), options, settings)
    return 0


def _wanted(options: PracticeOptions) -> SettingsStore:
    """The settings with what the command line says instead for this once, kept where that is asked for."""
    kept = SettingsStore()
    if kept.fault is not None:
        if options.remember:
            raise kept.fault
        say(f"{kept.fault}; the defaults hold for what is wrong")
    said = {**options.sound.settings(), "kit": wanted_kits(options.device, kept.now.kit)}
    said["sticks"] = wanted_sticks(options.sticks, kept.now.sticks)
    if options.student is not None:
        said["student"] = options.student
    store = SettingsStore(said=said, source="practice")
    check_settings(store.now)
    if options.remember:
        kept.update(lambda settings: with_said(settings, said, "practice"))
        say(f"remembered in {kept.write()}")
    return store


COMMAND = Command(PracticeOptions, run)
