"""A practice session laid out in time before it starts: count-in, demonstration, count-in, passes without a gap.

Pure: a lesson and the student's options in; the score that will be judged, the cues that the engine will play and the
segments of the timeline out. Times are nanoseconds from the transport's zero unless a name says otherwise.
"""

from collections.abc import Iterable
from dataclasses import dataclass, field
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from station.core.errors import BadInput
from station.core.units import NS_PER_S, PPQ
from station.drills.lesson import Lesson
from station.motion.kit.kit import Kit
from station.motion.sticking.hand_notes import Hands
from station.music.score import NOTE_DTYPE, Score
from station.practice.session.cues.click_pattern import (
    PLAIN,
    SILENT,
    ClickPattern,
    click_cues,
    count_in,
    counting,
    silences,
)
from station.practice.session.cues.stroke_cues import demonstration_cues, in_order, moved_by
from station.practice.session.leading_hand import drummers_kit, led_to_landing
from station.practice.session.rising_tempo import Rise, TempoStep, risen, steps_of
from station.scoring.matching.hit_windows import Level

MIN_TEMPO_BPM, MAX_TEMPO_BPM = 20.0, 400.0
"""The range of GrooveScribe (PEERS); beyond it neither a click nor a drummer makes sense."""
MAX_LOOPS = 1000
"""Our choice: eight hours of a two-bar loop."""


class Phase(IntEnum):
    """What is going on in a session."""

    COUNT_IN = 0
    DEMONSTRATION = 1
    PASS = 2
    OVER = 3


@dataclass(frozen=True, slots=True)
class Segment:
    """A part of the timeline: the `index`-th (from 0) demonstration or pass, or the count-in before it."""

    phase: Phase
    index: int
    start_ns: int
    end_ns: int


@dataclass(frozen=True, slots=True)
class PassSeries:
    """Which of the `passes` that follow a student a session is, `index` from 0; the first began at `began_bpm`."""

    index: int
    passes: int
    began_bpm: float


@dataclass(frozen=True, slots=True)
class PlanOptions:
    """What a student asks of a lesson; None leaves the choice to the lesson. `bars` (first, last) counts from 1.

    `click` is for the demonstrations and passes; the count-in clicks, or counts, every beat. With None the passes have
    no click, and the score follows the student, but in a song: a band waits for nobody. With `guide` the demonstration
    plays along in the passes. `hands` says whose hand leads, None as the lesson's kit is built. `level` is how strictly
    is judged, None as the lesson suggests; `stands` which kit stands before the demonstrator, empty for the lesson's.
    `rise` lets the tempo of the passes rise.
    """

    tempo_bpm: float | None = None
    loops: int | None = None
    bars: tuple[int, int] | None = None
    demonstrations: int | None = None
    click: ClickPattern | None = PLAIN
    guide: bool = False
    hands: Hands | None = None
    level: Level | None = None
    stands: str = ""
    rise: Rise | None = None


@dataclass(frozen=True, slots=True)
class Rounds:
    """Passes that differ: the lesson's bar (from 0) of each of `bars`, the bars in which passes start, the `loop`.

    Their landings are among `bars`, as `Plan.bar_names` has them.

    `silences` say from and until which ns the click was silent.
    """

    bars: tuple[int, ...]
    starts: tuple[int, ...]
    loop: tuple[int, int]
    silences: tuple[tuple[int, int], ...]


@dataclass(frozen=True, eq=False)
class Plan:
    """A session laid out.

    `kit` is the drummer's, `section` one pass at the practice tempo, `landing` (m,) of `NOTE_DTYPE` what is struck
    where the last one ends, its limbs written, `score` all passes in a row and the landing (what is judged),
    `first_bar` the lesson's bar (from 0) where the section begins, `passes_start_ns` where tick 0 of `score` lies on
    the transport, `end_ns` where the last pass ends, `cues` (n,) of `CUE_DTYPE` everything that sounds, `click` the
    pattern under the passes, None where the score follows the student, `level` how strictly is judged.
    `rounds` is there where passes differ in bars or tempo: then `section` is all of them in a row. Where the tempo
    rises as `rise` says `steps` are the tempi of `score`, and `tempo_bpm` the first; the `section` stays at that.
    """

    lesson: Lesson
    kit: Kit
    tempo_bpm: float
    section: Score
    score: Score
    first_bar: int
    passes: int
    segments: tuple[Segment, ...]
    passes_start_ns: int
    end_ns: int
    cues: NDArray[np.void]
    click: ClickPattern | None
    level: Level
    rounds: Rounds | None = None
    landing: NDArray[np.void] = field(default_factory=lambda: np.zeros(0, NOTE_DTYPE))
    steps: tuple[TempoStep, ...] = ()
    rise: Rise | None = None

    def in_a_row(self, times: int) -> Score:
        """The section `times` times in a row, and the landing."""
        return self.section.repeated(times).landing_on(self.landing)

    @property
    def bar_names(self) -> tuple[int, ...]:
        """The lesson's bar (from 0) of each bar of `score`; a landing stands in the one after the bars practised."""
        if self.rounds is not None:
            return self.rounds.bars
        after = self.first_bar + self.section.bar_count
        return tuple(range(self.first_bar, after)) * self.passes + ((after,) if len(self.landing) else ())

    @property
    def practised_bars(self) -> tuple[int, ...]:
        """The same, a landing with the bar that leads to it: what counts for a bar, and what is to be practised."""
        return tuple(min(bar, self.bars[1]) for bar in self.bar_names)

    def music_of(self, segment: Segment) -> tuple[Score, int]:
        """The score in which a segment lies, and when its tick 0 is on the transport: the passes are one in a row."""
        if segment.phase is Phase.PASS:
            return self.score, self.passes_start_ns
        return self.section, segment.start_ns

    @property
    def pass_starts(self) -> tuple[int, ...]:
        """The bars of `score`, from 0, in which passes start."""
        if self.rounds is not None:
            return self.rounds.starts
        return tuple(range(0, self.passes * self.section.bar_count, self.section.bar_count))

    @property
    def beats_a_minute(self) -> float:
        """The practice tempo in the lesson's own beat."""
        return self.tempo_bpm * PPQ / self.lesson.beat_ticks

    @property
    def bars(self) -> tuple[int, int]:
        """The lesson's first and last bar, from 0, that are practised."""
        if self.rounds is not None:
            return self.rounds.loop
        return self.first_bar, self.first_bar + self.section.bar_count - 1

    @property
    def silences(self) -> tuple[tuple[int, int], ...]:
        """From when until when in ns of the score the click is silent, in order."""
        if self.rounds is not None:
            return self.rounds.silences
        return silences(self.score.tempo_map, self.score.end_tick, None if self.click is None else self.click.gap)

    def segment_at(self, at_ns: int) -> Segment:
        """The segment that holds transport time `at_ns`: the first before zero, `Phase.OVER` after the end."""
        for segment in self.segments:
            if at_ns < segment.end_ns:
                return segment
        return Segment(Phase.OVER, 0, self.end_ns, self.end_ns)

    @property
    def demonstrations_end_ns(self) -> int:
        """Where the last demonstration ends and the passes' count-in begins; 0 without a demonstration."""
        return max((s.end_ns for s in self.segments if s.phase is Phase.DEMONSTRATION), default=0)


def plan_practice(lesson: Lesson, options: PlanOptions) -> Plan:
    """Lay out a session; raises `BadInput` for a tempo, a number of loops or bars that cannot be."""
    tempo_bpm = _checked_tempo(options.tempo_bpm, lesson)
    first, last = _checked_bars(options.bars, lesson)
    passes = _checked_loops(options.loops, lesson.passes_of((first, last)))
    kit = drummers_kit(lesson, options.hands, options.stands)
    section = lesson.score.bars(first, last).at_speed(tempo_bpm / lesson.tempo_bpm)
    section, landing = led_to_landing(section, lesson.landing_after(last), kit, options.hands)
    demonstrations = lesson.demonstrations if options.demonstrations is None else options.demonstrations

    line = _Timeline(lesson, section, landing, options, passes)
    line.add(Phase.DEMONSTRATION, demonstrations)
    passes_start_ns = line.add(Phase.PASS, passes)
    return Plan(
        lesson=lesson,
        kit=kit,
        tempo_bpm=tempo_bpm,
        section=section,
        score=line.passes(passes),
        first_bar=first,
        passes=passes,
        segments=tuple(line.segments),
        passes_start_ns=passes_start_ns,
        end_ns=line.end_ns,
        cues=in_order(line.cues),
        click=SILENT if options.click is None and lesson.band is not None else options.click,
        level=lesson.levels.level(options.level),
        landing=landing,
        steps=line.steps,
        rise=options.rise,
    )


class _Timeline:
    """A session's `segments` and `cues` so far, until `end_ns`; each phase is counted in. `steps` as the plan has."""

    def __init__(
        self, lesson: Lesson, section: Score, landing: NDArray[np.void], options: PlanOptions, passes: int
    ) -> None:
        self.segments: list[Segment] = []
        self.cues: list[NDArray[np.void]] = []
        self.end_ns = 0
        self._section, self._landing = section, landing
        self.steps = _steps(options, lesson, section, passes)
        self._options, self._click = options, options.click or PLAIN
        self._count_in = _count_in(section, lesson.count_in_bars)

    def add(self, phase: Phase, times: int) -> int:
        """The section `times` times in a row and the landing behind a count-in, nothing where it is none.

        The last time lasts as long as the landing's bar. Returns when it begins.
        """
        if times == 0:
            return self.end_ns
        self._count()
        start_ns, whole = self.end_ns, self._in_a_row(phase, times)
        starts_ns = whole.tempo_map.ns_at(np.arange(times) * self._section.end_tick).tolist()
        ends_ns = [*starts_ns[1:], whole.length_ns]
        if phase is Phase.DEMONSTRATION:
            once, last = self._section, self._section.landing_on(self._landing)
            for at_ns, score in zip(starts_ns, [once] * (times - 1) + [last], strict=True):
                self._sound(start_ns + at_ns, self._clicks(score), demonstration_cues(score))
        else:
            self._sound(start_ns, *self._under_passes(whole))
        self.segments += [
            Segment(phase, i, start_ns + begin_ns, start_ns + end_ns)
            for i, (begin_ns, end_ns) in enumerate(zip(starts_ns, ends_ns, strict=True))
        ]
        self.end_ns += whole.length_ns
        return start_ns

    def passes(self, times: int) -> Score:
        """All passes in a row and the landing, at the tempi that they are played at."""
        return risen(self._section.repeated(times).landing_on(self._landing), self.steps)

    def _in_a_row(self, phase: Phase, times: int) -> Score:
        is_played = phase is Phase.PASS
        return self.passes(times) if is_played else self._section.repeated(times).landing_on(self._landing)

    def _count(self) -> None:
        if length_ns := self._count_in.length_ns:
            self.segments.append(Segment(Phase.COUNT_IN, 0, self.end_ns, self.end_ns + length_ns))
        count = self._count_in
        self._sound(self.end_ns, click_cues(count.tempo_map, count.end_tick, counting(self._click)))
        self.end_ns += length_ns

    def _under_passes(self, whole: Score) -> Iterable[NDArray[np.void]]:
        if self._options.click is not None:
            yield self._clicks(whole)
        if self._options.guide:
            yield demonstration_cues(whole)

    def _clicks(self, score: Score) -> NDArray[np.void]:
        """The clicks of `score`: of the landing's bar only the first, for the last stroke rings."""
        end_tick = score.end_tick
        if len(self._landing) and score is not self._section:
            end_tick = score.tempo_map.bar_start(score.bar_count - 1) + 1
        return click_cues(score.tempo_map, end_tick, self._click)

    def _sound(self, at_ns: int, *cues: NDArray[np.void]) -> None:
        self.cues += [moved_by(each, at_ns) for each in cues]


def _count_in(section: Score, bars: int) -> Score:
    """Empty bars at the section's first tempo and meter, up to its pickup if it has one."""
    tempo_map, end_tick = count_in(section.tempo_map, bars, section.tempo_map.pickup_ticks(section.end_tick))
    return Score.from_notes([], tempo_map, end_tick)


def _checked_tempo(requested_bpm: float | None, lesson: Lesson) -> float:
    tempo_bpm = lesson.tempo_bpm if requested_bpm is None else requested_bpm
    if not MIN_TEMPO_BPM <= tempo_bpm <= MAX_TEMPO_BPM:  # also refuses NaN
        limits = f"expected {MIN_TEMPO_BPM:g} to {MAX_TEMPO_BPM:g} beats a minute"
        raise BadInput("--tempo", f"{tempo_bpm:g}", limits)
    return tempo_bpm


def _steps(options: PlanOptions, lesson: Lesson, section: Score, passes: int) -> tuple[TempoStep, ...]:
    """The tempi of the passes where they rise; raises `BadInput`."""
    if options.rise is None:
        return ()
    if lesson.band is not None:
        raise BadInput("--rise", lesson.name, "the sound of a song has one tempo")
    if options.click is None:
        raise BadInput("--rise", "--no-click", "without a click the tempo is yours: nothing can raise it")
    tempo_bpm = lesson.tempo_bpm if options.tempo_bpm is None else options.tempo_bpm
    steps = steps_of(options.rise, lesson, tempo_bpm, passes * section.bar_count)
    _checked_tempo(steps[-1].tempo_bpm, lesson)
    return steps


def _checked_loops(requested: int | None, usual: int) -> int:
    loops = usual if requested is None else requested
    if not 1 <= loops <= MAX_LOOPS:
        raise BadInput("--loops", str(loops), f"expected 1 to {MAX_LOOPS}")
    return loops


def _checked_bars(requested: tuple[int, int] | None, lesson: Lesson) -> tuple[int, int]:
    """First and last bar from 0."""
    if requested is None:
        return lesson.loop
    first, last = requested
    if first > last:
        raise BadInput("--bars", f"{first}-{last}", "expected the first bar first")
    if not 1 <= first <= last <= lesson.score.bar_count:
        raise BadInput("--bars", f"{first}-{last}", f"the lesson has bars 1 to {lesson.score.bar_count}")
    return first - 1, last - 1


TAIL_S = 1.0
"""How long a session listens after its last bar, so that a late last stroke still counts; our choice."""
TAIL_NS = round(TAIL_S * NS_PER_S)
