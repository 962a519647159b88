"""A practice session laid out in time before it starts: count-in, demonstration, count-in, passes without a gap.

Pure: a lesson and the student's options in; the score that will be judged, the cues that the engine will play and the
segments of the timeline out. Times are nanoseconds from the transport's zero unless a name says otherwise.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from station.core.errors import BadInput
from station.core.units import NS_PER_S, PPQ
from station.drills.lesson import Lesson
from station.engine.messages import CUE_DTYPE, Bus
from station.motion.kit.kit import Kit
from station.motion.sticking.hand_notes import Hands
from station.motion.sticking.limbs import as_led, assign_limbs
from station.music.score import Score
from station.practice.session.click_pattern import (
    PLAIN,
    ClickPattern,
    click_cues,
    count_in,
    counting,
    pickup_of,
    silences,
)
from station.practice.session.leading_hand import drummers_kit
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
    """A stretch of the timeline: the `index`-th (from 0) demonstration or pass, or the count-in before it."""

    phase: Phase
    index: int
    start_ns: int
    end_ns: int


@dataclass(frozen=True, slots=True)
class PlanOptions:
    """What a student asks of a lesson; None leaves the choice to the lesson. `bars` (first, last) counts from 1.

    `click` is for the demonstrations and passes; the count-in clicks, or counts, every beat. With None the passes have
    no click, and the score follows the student. With `guide` the demonstration plays along in the passes. `hands` says
    whose hand leads, None as the lesson's kit is built. `level` is how strictly is judged, None as the lesson suggests;
    `stands` which kit stands before the demonstrator, empty for the lesson's.
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


@dataclass(frozen=True, slots=True)
class Rounds:
    """Passes that differ: the lesson's bar (from 0) of each of `bars`, the bars in which passes start, the `loop`.

    `silences` say from and until which ns the click was silent.
    """

    bars: tuple[int, ...]
    starts: tuple[int, ...]
    loop: tuple[int, int]
    silences: tuple[tuple[int, int], ...]


@dataclass(frozen=True, eq=False)
class Plan:
    """A session laid out.

    `kit` is the drummer's, `section` one pass at the practice tempo, `score` all passes in a row (what is judged),
    `first_bar` the lesson's bar (from 0) where the section begins, `passes_start_ns` where tick 0 of `score` lies on
    the transport, `end_ns` where the last pass ends, `cues` (n,) of `CUE_DTYPE` everything that sounds, `click` the
    pattern under the passes, None where the score follows the student, `level` how strictly is judged.
    `rounds` is there where passes differ in bars or tempo: then `section` is all of them in a row.
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

    def words(self, segment: Segment) -> str:
        """What is going on, for people."""
        match segment.phase:
            case Phase.PASS:
                return f"Pass {segment.index + 1} of {self.passes}"
            case Phase.DEMONSTRATION:
                return "Demonstration"
            case Phase.COUNT_IN:
                return "Count-in"
            case _:
                return "Over"


def plan_practice(lesson: Lesson, options: PlanOptions) -> Plan:
    """Lay out a session; raises `BadInput` for a tempo, a number of loops or bars that cannot be."""
    tempo_bpm = _checked_tempo(options.tempo_bpm, lesson)
    passes = _checked_loops(options.loops, lesson)
    first, last = _checked_bars(options.bars, lesson)
    kit = drummers_kit(lesson, options.hands, options.stands)
    section = lesson.score.bars(first, last).at_speed(tempo_bpm / lesson.tempo_bpm)
    section = with_sticking(section, kit, options.hands)
    demonstrations = lesson.demonstrations if options.demonstrations is None else options.demonstrations

    line = _Timeline(section, lesson.count_in_bars, options)
    line.add(Phase.DEMONSTRATION, demonstrations)
    passes_start_ns = line.add(Phase.PASS, passes)
    return Plan(
        lesson=lesson,
        kit=kit,
        tempo_bpm=tempo_bpm,
        section=section,
        score=section.repeated(passes),
        first_bar=first,
        passes=passes,
        segments=tuple(line.segments),
        passes_start_ns=passes_start_ns,
        end_ns=line.end_ns,
        cues=_in_order(line.cues),
        click=options.click,
        level=lesson.levels.level(options.level),
    )


class _Timeline:
    """A session's `segments` and `cues` so far, until `end_ns`; each phase is counted in."""

    def __init__(self, section: Score, count_in_bars: int, options: PlanOptions) -> None:
        self.segments: list[Segment] = []
        self.cues: list[NDArray[np.void]] = []
        self.end_ns = 0
        self._section, self._options, self._click = section, options, options.click or PLAIN
        self._count_in = _count_in(section, count_in_bars)

    def add(self, phase: Phase, times: int) -> int:
        """The section `times` times in a row behind a count-in, nothing where it is none; returns when it begins."""
        if times == 0:
            return self.end_ns
        self._count()
        start_ns, whole = self.end_ns, self._section.repeated(times)
        ends_ns = whole.tempo_map.ns_at(np.arange(1, times + 1) * self._section.end_tick).tolist()
        starts_ns = [0, *ends_ns[:-1]]
        if phase is Phase.DEMONSTRATION:
            for at_ns in starts_ns:
                self._sound(start_ns + at_ns, self._clicks(self._section), demonstration_cues(self._section))
        else:
            self._sound(start_ns, *self._under_passes(whole))
        self.segments += [
            Segment(phase, i, start_ns + begin_ns, start_ns + end_ns)
            for i, (begin_ns, end_ns) in enumerate(zip(starts_ns, ends_ns, strict=True))
        ]
        self.end_ns += whole.length_ns
        return start_ns

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
        return click_cues(score.tempo_map, score.end_tick, self._click)

    def _sound(self, at_ns: int, *cues: NDArray[np.void]) -> None:
        self.cues += [moved_by(each, at_ns) for each in cues]


def demonstration_cues(score: Score) -> NDArray[np.void]:
    """Every stroke of `score`, and a cue of velocity 0 wherever a cymbal is grabbed."""
    strokes = np.zeros(len(score), CUE_DTYPE)
    for name in ("piece", "zone", "articulation", "velocity", "openness"):
        strokes[name] = score.notes[name]
    strokes["at_ns"] = score.onset_ns
    strokes["bus"] = Bus.DEMONSTRATION
    grabbed = score.notes["choke_ticks"] > 0
    chokes = strokes[grabbed]
    chokes["at_ns"] = score.tempo_map.ns_at(score.notes["tick"][grabbed] + score.notes["choke_ticks"][grabbed])
    chokes["velocity"] = 0
    return np.concatenate([strokes, chokes])


def with_sticking(section: Score, kit: Kit, hands: Hands | None) -> Score:
    """The section with a limb for every stroke: the written one, else the one that the drummer takes.

    So the demonstration, the per-limb figures and the advice all speak of the same hands.
    """
    led = as_led(section, kit, hands)
    return led.with_limbs(assign_limbs(led, kit, hands=hands).limbs)


def _count_in(section: Score, bars: int) -> Score:
    """Empty bars at the section's first tempo and meter, up to its pickup if it has one."""
    tempo_map, end_tick = count_in(section.tempo_map, bars, pickup_of(section.tempo_map, section.end_tick))
    return Score.from_notes([], tempo_map, end_tick)


def moved_by(cues: NDArray[np.void], by_ns: int) -> NDArray[np.void]:
    """The cues, each so much later; negative is earlier."""
    moved = cues.copy()
    moved["at_ns"] += by_ns
    return moved


def _in_order(parts: Iterable[NDArray[np.void]]) -> NDArray[np.void]:
    cues = np.concatenate(list(parts))
    return cues[np.argsort(cues["at_ns"], kind="stable")]


def _checked_tempo(requested_bpm: float | None, lesson: Lesson) -> float:
    tempo_bpm = lesson.tempo_bpm if requested_bpm is None else requested_bpm
    if not MIN_TEMPO_BPM <= tempo_bpm <= MAX_TEMPO_BPM:  # also refuses NaN
        limits = f"expected {MIN_TEMPO_BPM:g} to {MAX_TEMPO_BPM:g} beats a minute"
        raise BadInput("--tempo", f"{tempo_bpm:g}", limits)
    return tempo_bpm


def _checked_loops(requested: int | None, lesson: Lesson) -> int:
    loops = lesson.passes if requested is None else requested
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
