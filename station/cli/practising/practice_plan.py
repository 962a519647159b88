"""The session that the command line asks for: its lesson and plan, how strictly it is judged, what plays along."""

from dataclasses import dataclass, replace

from station.cli.console import say
from station.cli.input.tapping import TAP, tapped_tempo
from station.cli.practising.practice_options import PracticeOptions
from station.core.errors import BadInput, DeviceError
from station.core.settings import Settings, setting_source
from station.core.units import PPQ
from station.drills.lesson import Lesson
from station.practice.history.student_history import StudentHistory
from station.practice.records.memory import LevelMemory
from station.practice.session.backing_track import BackingRequest, song_request
from station.practice.session.cues.click_options import parse_click
from station.practice.session.cues.quiet_bars import drawn
from station.practice.session.leading_hand import hands_of
from station.practice.session.plan import MAX_TEMPO_BPM, MIN_TEMPO_BPM, Plan, PlanOptions, plan_practice
from station.scoring.matching.hit_windows import Level


@dataclass(frozen=True, slots=True, eq=False)
class AskedPractice:
    """The `plan`, by the student's `options`; `backing` plays along, None for nothing of their own.

    `adapts`: whether the tempo follows the student in the window.
    """

    plan: Plan
    options: PlanOptions
    backing: BackingRequest | None
    adapts: bool


def asked_practice(options: PracticeOptions, settings: Settings) -> AskedPractice:
    """What to practise; raises `BadInput` for what cannot be, or not at once."""
    backing = options.track.backing(adapts=bool(options.adapt))
    if options.no_click and options.adapt:
        raise BadInput("--no-click", "--adapt", "the tempo follows you either within a pass or from pass to pass")
    _check_rise(options, backing)
    lesson = lesson_of(options.lesson)
    _refuse_for_songs(lesson, options)
    if options.fold is not None:
        from station.drills.editing.folded_lesson import folded

        lesson = folded(lesson, options.fold)
    plan_options = _plan_options(options, lesson, settings)
    plan = plan_practice(lesson, plan_options)
    sounding = backing or song_request(plan, settings.band_drums)
    if sounding is not None:
        sounding.check(plan, settings.rate_hz)
    by_default = options.tempo is None and options.rise is None and not options.no_click and sounding is None
    return AskedPractice(plan, plan_options, backing, by_default if options.adapt is None else options.adapt)


def lesson_of(name: str | None) -> Lesson:
    """The lesson of that name or file, None for the first; raises `BadInput` where there is none."""
    from station.app.music_files.find_own_lesson import find_any_lesson
    from station.drills.library import FIRST_LESSON

    return find_any_lesson(FIRST_LESSON if name is None else name)


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


def _plan_options(options: PracticeOptions, lesson: Lesson, settings: Settings) -> PlanOptions:
    tempo_bpm = tapped_tempo(lesson.beat_ticks / PPQ) if options.tempo == TAP else options.tempo
    if options.speed is not None:
        tempo_bpm = _tempo_at(options.speed, lesson)
    demonstrations = 0 if options.no_demonstration else None
    pattern = parse_click(settings.click_pattern, setting_source("click_pattern"))
    gap = options.gap or pattern.gap
    gap = gap if options.virtual_student else drawn(gap)  # a virtual student plays the same every time
    click = None if options.no_click else replace(pattern, gap=gap)
    return PlanOptions(
        tempo_bpm,
        options.loops,
        options.bars,
        demonstrations,
        click,
        settings.guide,
        hands_of(settings),
        level=_level(options, lesson, settings),
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
    memory = LevelMemory(StudentHistory.of(settings))
    try:
        if asked is not None:
            memory.keep(lesson.name, asked)
        levels, fault = memory.recall()
    except DeviceError:  # the history is away, as was said; the level that is asked for holds for now
        levels, fault = {}, None
    if fault is not None:
        say(fault)
    return lesson.levels.level(asked, levels.get(lesson.name))
