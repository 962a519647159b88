"""`station practice [LESSON]`: a practice session in the window, in the terminal, or with a virtual student."""

from contextlib import ExitStack
from dataclasses import dataclass, replace
from datetime import date
from pathlib import Path
from typing import Any, Literal

from station.app.equipment.diagnostics import has_screen
from station.app.sessions.session_checks import check_settings
from station.app.settings.settings_store import SettingsStore
from station.cli.console import print_json, say, write
from station.cli.input.read_scores import bars_of_gap
from station.cli.input.self_estimate_question import ask_first
from station.cli.input.tapping import TAP, tapped_tempo
from station.cli.options.device_option import devices_option, sticks_option, wanted_kits, wanted_sticks
from station.cli.options.option_fields import (
    Command,
    choice,
    flag,
    group,
    number,
    option,
    optional_argument,
    switch,
    unread,
    whole_number,
)
from station.cli.options.sound_options import SoundOptions, TrackOptions
from station.cli.options.watch_options import WatchOptions
from station.core.errors import BadInput, StationError
from station.core.pieces import Piece
from station.core.settings import Settings, setting_source, with_said
from station.core.units import PPQ
from station.drills.grid.tab_symbols import LINE_PIECES
from station.drills.lesson import Lesson
from station.practice.headless.guarded_output import GuardedOutput
from station.practice.records.lesson_order import first_words, followed_course, shipped_title
from station.practice.records.memory import LevelMemory, Memory, Remembered
from station.practice.records.recovery import offer, recovered
from station.practice.records.save_session import SessionFolder, SessionRecord, save
from station.practice.records.session_files import TEXT_NAME
from station.practice.records.session_report import practice_document, report_text, with_truth
from station.practice.records.student_progress import student_progress
from station.practice.records.teachers_wishes import wishes_of
from station.practice.session.backing_track import BackingRequest, song_request
from station.practice.session.cues.click_options import parse_click
from station.practice.session.cues.quiet_bars import QuietBars, drawn
from station.practice.session.leading_hand import hands_of
from station.practice.session.plan import MAX_TEMPO_BPM, MIN_TEMPO_BPM, Plan, PlanOptions, plan_practice
from station.practice.session.rising_tempo import EXPECTED as EXPECTED_RISE
from station.practice.session.rising_tempo import Rise, rise_of
from station.scoring.matching.hit_windows import OUR_LEVELS, Level
from station.scoring.report.assessment_document import Json

STAND_IN = "intermediate,seed=1"
"""Who practises where there is neither a screen nor a kit."""


def _tempo(text: str) -> float | Literal["tap"]:
    if text == TAP:
        return TAP
    try:
        return float(text)
    except ValueError:
        raise unread(f"a number, or {TAP} to tap it", text) from None


def _percent(text: str) -> float:
    return number(text.removesuffix("%").strip())


def _bars(text: str) -> tuple[int, int]:
    first, dash, last = text.partition("-")
    try:
        return int(first), int(last if dash else first)
    except ValueError:
        raise unread("two bars such as 1-4", text) from None


def _pieces(text: str) -> frozenset[Piece]:
    words = [part.strip() for part in text.split(",")]
    if not all(part in LINE_PIECES for part in words):
        raise unread("pieces such as kick,snare,hihat", text)
    return frozenset(LINE_PIECES[part] for part in words)


def _rise(text: str) -> Rise:
    try:
        return rise_of(text)
    except BadInput:
        raise unread(EXPECTED_RISE, text) from None


@dataclass(frozen=True, slots=True, kw_only=True)
class PracticeOptions:
    """What is practised, by whom, and what is left of it; None leaves the choice to the lesson or the settings."""

    lesson: str | None = optional_argument("LESSON", "a lesson's name or file (the first lesson)")
    tempo: float | Literal["tap"] | None = option(
        "BPM",
        "quarter notes a minute, in any meter, or tap to tap it on the Enter key (the lesson's)",
        _tempo,
        None,
    )
    speed: float | None = option("PERCENT", "of the lesson's own tempo, such as 60%", _percent, None)
    adapt: bool | None = switch(
        "let tempo, bars and feedback follow the student from pass to pass (on in the window, unless --tempo)"
    )
    rise: Rise | None = option(
        "BPM/BARS[:TOP]",
        "so many bpm more every so many bars such as 5/8, up to the lesson's target or TOP",
        _rise,
        None,
    )
    loops: int | None = option("N", "how often the loop is played (the lesson's)", whole_number, None)
    bars: tuple[int, int] | None = option("A-B", "bars to practise, from 1 (the lesson's loop)", _bars, None)
    gap: QuietBars | None = option(
        "ON/OFF|random[:SHARE]",
        "bars with a click and bars without, in turn such as 4/1, or at random such as random:30%",
        bars_of_gap,
        None,
        rivals="click",
    )
    fold: frozenset[Piece] | None = option(
        "PIECES", "on a smaller kit: these pieces alone, such as kick,snare,hihat (the lesson's)", _pieces, None
    )
    no_click: bool = flag("no click after the count-in: the score follows you, and waits", rivals="click")
    today: bool = flag("the next block of today's plan (station today)")
    device: tuple[str, ...] = devices_option()
    sticks: tuple[str, ...] = sticks_option()
    virtual_student: str | None = option("SPEC", "who plays instead of a person, such as pro,seed=3", str, None)
    headless: bool = flag("no window; a virtual student plays faster than real time")
    no_demonstration: bool = flag("count in and play at once")
    report: Path | None = option("DIR", "where to leave the session; practises in the terminal", Path, None)
    no_pictures: bool = flag("leave a report, but no pictures")
    recover: Path | None = option("DIR", "judge and keep a session that was cut off", Path, None)
    student: str | None = option("NAME", "whose session it is", str, None)
    level: Level | None = choice(
        OUR_LEVELS, "how strictly is judged from now on (as the student chose, or came to; else the lesson's)", None
    )
    json: bool = flag("print the report as one JSON document; in the terminal")
    sound: SoundOptions = group(SoundOptions, "sound")
    track: TrackOptions = group(TrackOptions, "a track to play along to")
    remember: bool = flag("keep what was said of student, kit and sound for the next time")
    watch: WatchOptions = group(WatchOptions)


def run(options: PracticeOptions) -> int:
    """Practise."""
    store = _wanted(options)
    settings = store.now
    if options.recover is not None:
        return _recover(SessionFolder.left_over(options.recover), options, settings)
    return _todays_block(options, store) if options.today else _practise(options, store)


def _todays_block(options: PracticeOptions, store: SettingsStore) -> int:
    """Practise what the day's plan has next, and say what follows."""
    from station.cli.practising.todays_block import block_options, next_block, say_block, say_what_follows

    item = next_block(store.now)
    planned: dict[str, Any] = block_options(item, _lesson(item.lesson))
    for name in planned:
        if getattr(options, name) is not None:
            raise BadInput("--today", name, "the plan says so already; leave one of them out")
    say_block(item)
    status = _practise(replace(options, **planned), store)
    say_what_follows(store.now)
    return status


def _practise(options: PracticeOptions, store: SettingsStore) -> int:
    settings = store.now
    backing = options.track.backing(adapts=bool(options.adapt))
    if options.no_click and options.adapt:
        raise BadInput("--no-click", "--adapt", "the tempo follows you either within a pass or from pass to pass")
    _check_rise(options, backing)
    lesson = _lesson(options.lesson)
    _refuse_for_songs(lesson, options)
    if options.fold is not None:
        from station.drills.editing.folded_lesson import folded

        lesson = folded(lesson, options.fold)
    plan_options = replace(_plan_options(options, lesson, settings), level=_level(options, lesson, settings))
    plan = plan_practice(lesson, plan_options)
    sounding = backing or song_request(plan, settings.band_drums)
    if sounding is not None:
        sounding.check(plan, settings.rate_hz)
    if options.virtual_student is not None:
        return _virtual(plan, plan_options, options.virtual_student, options, settings)
    in_terminal = options.headless or options.json or options.report is not None
    if not in_terminal and has_screen():
        from station.cli.window import open_window

        by_default = options.tempo is None and options.rise is None and not options.no_click and sounding is None
        adapt = by_default if options.adapt is None else options.adapt
        return open_window(store, plan, adapt, backing, options.watch.watch())
    if not in_terminal and not options.device and not _is_kit_there(settings.kit):
        say("no screen and no kit here: a virtual student practises instead")
        return _virtual(plan, plan_options, STAND_IN, options, settings)
    _say_what_comes_first(lesson, settings)
    return _live(plan, plan_options, options, settings, backing)


def _refuse_for_songs(lesson: Lesson, options: PracticeOptions) -> None:
    """Raise `BadInput` for what a song has of its own, or cannot do."""
    if options.speed is not None and options.tempo is not None:
        raise BadInput("--speed", "--tempo", "both say how fast")
    if lesson.band is not None and options.adapt:
        raise BadInput("--adapt", lesson.name, "the track of a song has one tempo; without --adapt the tempo stays")
    if lesson.band is not None and options.fold is not None:
        raise BadInput("--fold", lesson.name, "a song's drum part is played as it is")
    if lesson.band is not None and options.track.track is not None:
        raise BadInput("--track", lesson.name, "this is a song, and brings its own sound")


def _check_rise(options: PracticeOptions, backing: BackingRequest | None) -> None:
    """Raise `BadInput` where something else has a say in the tempo."""
    if options.rise is not None and options.adapt:
        raise BadInput("--rise", "--adapt", "the tempo follows either the plan or you")
    if options.rise is not None and backing is not None:
        raise BadInput("--rise", "--track", "a track has one tempo; without --track it may rise")


def _say_what_comes_first(lesson: Lesson, settings: Settings) -> None:
    """Name the lessons that should come before; the window does so itself."""
    if lesson.prerequisites:
        progress = student_progress(settings.sessions_dir, settings.student)
        for line in first_words(lesson.prerequisites, progress, shipped_title):
            say(line)


# --- ways to practise ------------------------------------------------------------------------------------------------


def _virtual(plan: Plan, plan_options: PlanOptions, spec: str, options: PracticeOptions, settings: Settings) -> int:
    """A virtual student is new to every lesson, and forgotten, unless it practises under a name."""
    if options.sound.midi_out is not None or options.track.track is not None:
        say("a virtual student practises without sound: nothing is sent to a MIDI output, and no track plays")
    from station.practice.headless.virtual_session import practise_adaptively, practise_virtually
    from station.simulation.student_spec import parse_spec

    student = parse_spec(spec)
    remembered = _remembered(plan, plan_options, settings, options.student is not None) if options.adapt else None
    with SessionFolder.make(options.report, settings, plan.lesson.name) as folder:
        if remembered is None:
            virtual = practise_virtually(plan, student, folder.capture)
        else:
            virtual = practise_adaptively(remembered.adaptation, student, folder.capture)
        document = with_truth(practice_document(virtual.result, settings), virtual, settings)
        _leave(folder, save(folder, virtual.result, document, remembered), options, settings)
    if virtual.fault is not None:
        raise virtual.fault
    return 0


def _live(
    plan: Plan, plan_options: PlanOptions, options: PracticeOptions, settings: Settings, backing: BackingRequest | None
) -> int:
    from station.cli.practising.terminal import practise_in_terminal

    cut_off = offer(settings)
    if cut_off is not None:
        say(cut_off)
    remembered = _remembered(plan, plan_options, settings, keeps=True) if options.adapt else None
    with SessionFolder.make(options.report, settings, plan.lesson.name) as folder:
        with ExitStack() as until_saved:
            asked = plan if remembered is None else remembered.adaptation
            outcome = practise_in_terminal(asked, settings, folder.capture, until_saved, backing)
            saved = save(folder, outcome.result, practice_document(outcome.result, settings), remembered)
        may_ask = settings.ask_first and outcome.is_attended and not options.json
        _leave(folder, saved, options, settings, may_ask)
    if outcome.fault is not None:
        raise outcome.fault
    return 0


def _remembered(plan: Plan, plan_options: PlanOptions, settings: Settings, keeps: bool) -> Remembered:
    """Practice that follows the student; what could not be read is said at once."""
    memory = Memory.of(settings.sessions_dir, settings.student, plan.lesson.name, plan.bars) if keeps else None
    today = date.today()
    followed = Remembered.of(
        plan.lesson, plan_options, today, memory, followed_course(settings), wishes_of(settings, today)
    )
    if followed.fault is not None:
        say(followed.fault)
    return followed


def _is_kit_there(wanted: str) -> bool:
    from station.devices.device_ports import devices_there, parse_devices

    return bool(devices_there(parse_devices(wanted)))


def _recover(folder: SessionFolder, options: PracticeOptions, settings: Settings) -> int:
    """Judge a session that was cut off, and leave what it would have left; what is remembered stays as it is."""
    result = recovered(folder.capture)
    _leave(folder, save(folder, result, practice_document(result, settings)), options, settings)
    return 0


def _leave(
    folder: SessionFolder,
    saved: SessionRecord,
    options: PracticeOptions,
    settings: Settings,
    may_ask: bool = False,
) -> None:
    """Print the report of what was kept, and draw it; what the disk refused is said after the report was printed.

    `may_ask`: a person played, who may be asked for an opinion before the report is there.
    """
    telling = GuardedOutput()
    if may_ask:
        telling.attempt(ask_first, saved.document)
    telling.attempt(_print_report, saved.document, as_json=options.json)
    if saved.fault is not None:
        raise saved.fault
    paths = [folder.path / TEXT_NAME]
    if not options.no_pictures:
        paths += _draw(folder, saved, settings, telling)
    if telling.failure is None:
        say("\n" + "\n".join(f"{'picture' if path.suffix == '.png' else 'report':9}{path}" for path in paths))
    if isinstance(telling.failure, BrokenPipeError):  # whoever read has gone, and wants no word of it
        raise telling.failure
    unsaid = telling.fault(f"the session is kept in {folder.path}, but not all could be printed")
    if unsaid is not None:
        raise unsaid


def _print_report(document: dict[str, Json], as_json: bool) -> None:
    if as_json:
        print_json(document)
        return
    write(report_text(document), end="", flush=True)
    if "pairs_csv" in document:
        write(f"\n{document['pairs_csv']}", end="", flush=True)


def _draw(folder: SessionFolder, saved: SessionRecord, settings: Settings, telling: GuardedOutput) -> list[Path]:
    from station.scenes.pictures import draw_record

    try:
        return list(draw_record(saved, folder.path, settings))
    except StationError as error:
        telling.attempt(say, f"no picture: {error}")
        return []


# --- what was asked --------------------------------------------------------------------------------------------------


def _lesson(name: str | None) -> Lesson:
    from station.app.music_files.find_own_lesson import find_any_lesson
    from station.drills.library import FIRST_LESSON

    return find_any_lesson(FIRST_LESSON if name is None else name)


def _plan_options(options: PracticeOptions, lesson: Lesson, settings: Settings) -> PlanOptions:
    tempo_bpm = tapped_tempo(lesson.beat_ticks / PPQ) if options.tempo == TAP else options.tempo
    if options.speed is not None:
        tempo_bpm = _tempo_at(options.speed, lesson)
    demonstrations = 0 if options.no_demonstration else None
    pattern = parse_click(settings.click_pattern, setting_source("click_pattern"))
    gap = options.gap or pattern.gap
    gap = gap if options.virtual_student else drawn(gap)  # a virtual student plays the same every time
    click = None if options.no_click else replace(pattern, gap=gap)
    hands = hands_of(settings)
    return PlanOptions(
        tempo_bpm,
        options.loops,
        options.bars,
        demonstrations,
        click,
        settings.guide,
        hands,
        stands=settings.stands,
        rise=options.rise,
    )


def _tempo_at(speed_pct: float, lesson: Lesson) -> float:
    """Quarter notes a minute at so many percent of the lesson's own tempo; raises `BadInput`."""
    tempo_bpm = lesson.tempo_bpm * speed_pct / 100.0
    if not MIN_TEMPO_BPM <= tempo_bpm <= MAX_TEMPO_BPM:  # also refuses NaN
        is_so_many = f"is {tempo_bpm:.3g} of its {lesson.tempo_bpm:g} beats a minute"
        limits = f"expected {MIN_TEMPO_BPM:g} to {MAX_TEMPO_BPM:g}, such as --speed 60%"
        raise BadInput("--speed", f"{speed_pct:g}%", f"{is_so_many}; {limits}")
    return tempo_bpm


def _level(options: PracticeOptions, lesson: Lesson, settings: Settings) -> Level:
    """The level that holds; one that is asked for is kept, but not for a virtual student without a name."""
    asked = options.level
    if asked is not None and asked not in lesson.levels.choices:
        raise BadInput("--level", asked, f"{lesson.name} is judged as {lesson.levels.strictest} at the strictest")
    if options.virtual_student is not None and options.student is None:
        return lesson.levels.level(asked)
    memory = LevelMemory.of(settings.sessions_dir, settings.student)
    if asked is not None:
        memory.keep(lesson.name, asked)
    levels, fault = memory.recall()
    if fault is not None:
        say(fault)
    return lesson.levels.level(asked, levels.get(lesson.name))


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
