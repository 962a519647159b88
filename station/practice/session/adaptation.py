"""Practice that follows the student: each pass is laid out by what the mastery policy made of the one before.

A pass is a plan and a session of its own, with its own count-in, for tempo and bars may change between two passes and
never inside one; nothing carries over from pass to pass. `Adaptation` says what comes next and hears how it went;
`whole` puts all passes in a row, so that a session has one report. Pure: no clock, no device, no file.
"""

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from datetime import date
from functools import cached_property
from math import ceil

import numpy as np

from station.core.units import PPQ
from station.drills.lesson import Lesson
from station.drills.mastery.equipment_faults import rewired
from station.drills.mastery.mastery_state import ItemState
from station.drills.mastery.next_pass import begin, fix_tempo, new_item, next_step, veto
from station.drills.mastery.pass_measures.pass_facts import PassResult, PassView, measure_pass
from station.drills.mastery.practice_steps import PassKind, PracticeStep, item_of
from station.drills.mastery.rules import Rules
from station.drills.mastery.verdict import Grade, judge
from station.drills.orchestration import reorchestrated
from station.engine.engine import KEYBOARD
from station.music.performance import Performance
from station.music.score import Score
from station.music.tempo import TempoMap
from station.practice.session.cues.click_pattern import PLAIN, ClickPattern
from station.practice.session.cues.quiet_bars import Gap, RandomGap
from station.practice.session.device_latency import Latency
from station.practice.session.plan import (
    MAX_TEMPO_BPM,
    MIN_TEMPO_BPM,
    PassSeries,
    Phase,
    Plan,
    PlanOptions,
    Rounds,
    Segment,
    plan_practice,
)
from station.practice.session.played_phase import all_phases
from station.practice.session.session import Session, SessionResult
from station.scoring.align import align
from station.scoring.matching.hit_windows import Level
from station.scoring.matching.unheard import notes_within, with_unknown

REST_S = 1.5
"""At least so much silence lies between two passes of the joined score: more than a session listens before its first
bar and after its last (`session.EARLIEST_NS`, `plan.TAIL_S`), so that no stroke is near two passes."""
BAD_TO_STRUGGLE = 2
"""So many passes in a row that are not clean, and what comes before may be missing (our choice: as many as lower the
tempo)."""
SILENT_TO_STOP = 2
"""So many passes without a stroke, and nobody is there (TEACHING: auto-pause after two)."""


@dataclass(frozen=True, eq=False)
class PlayedPass:
    """A pass: what was asked, what came of it, and what the policy measured, None where it was stopped early."""

    step: PracticeStep
    result: SessionResult
    measured: PassResult | None


@dataclass(eq=False)
class Adaptation:
    """The passes of one student over one lesson today: play `plan`, hand `record_pass` its result, until `over`.

    `known` is what the last session left, None for a student who is new to the lesson. A tempo in `options` stays.
    Raises `BadInput` for options that cannot be.
    """

    lesson: Lesson
    options: PlanOptions
    today: date
    known: ItemState | None = None
    rounds: list[PlayedPass] = field(default_factory=list)

    def __post_init__(self) -> None:
        first = plan_practice(self.lesson, self.options)  # names what cannot be
        self.level = first.level
        self.rules = self._rules_at(self.level)
        self.loops = first.passes
        item = item_of(self.lesson, (first.first_bar, first.first_bar + first.section.bar_count - 1))
        if self.known is None or self.known.item != item:
            self.state = new_item(item, self.today, self.rules).at_level(self.level)
        else:
            self.state = begin(self.known.at_level(self.level), self.today, self.rules)
        if self.options.tempo_bpm is not None:
            self.state, _ = fix_tempo(self.state, self.options.tempo_bpm, self.rules)
        elif self.state.fixed_pct is not None:
            self.state, _ = fix_tempo(self.state, None, self.rules)
        self.step = self.state.step
        self._plan = self._laid_out()

    @property
    def plan(self) -> Plan:
        """The next pass, laid out."""
        return self._plan

    def session(self, latency: Latency) -> Session:
        """The next pass as a session, ready to start."""
        series = PassSeries(len(self.rounds), self.loops, (self.rounds[0] if self.rounds else self).step.tempo_bpm)
        return Session(self.plan, latency, feedback=self.step.feedback, message=self.words, series=series)

    @property
    def words(self) -> str:
        """What the student should read before the next pass: why it is so, and a fault of the kit that was found."""
        return self.step.why if self.step.notice is None else f"{self.step.why} {self.step.notice}"

    @property
    def over(self) -> bool:
        """Whether enough was played: all that was asked for, all that helps today, or nobody is there."""
        silent = [r.measured is not None and r.measured.is_silent for r in self.rounds[-SILENT_TO_STOP:]]
        has_left = len(silent) == SILENT_TO_STOP and all(silent)
        is_stopped = bool(self.rounds) and not self.rounds[-1].result.complete
        is_enough = bool(self.rounds) and self.step.kind is PassKind.LEAVE
        return len(self.rounds) >= self.loops or has_left or is_stopped or is_enough

    def record_pass(self, result: SessionResult) -> PracticeStep:
        """Hear the pass that was asked for last; returns the next. What was stopped early is kept and not judged."""
        measured = self._measured(result) if result.complete else None
        self.rounds.append(PlayedPass(self.step, result, measured))
        if measured is not None:
            had_grown = self.has_grown
            self.state, self.step = next_step(self.state, measured, self._rules_of(self.step.kind))
            if self.has_grown and not had_grown:
                self._notice(held_words(self.level, self.next_level))
            self._plan = self._laid_out()
        return self.step

    @property
    def next_level(self) -> Level:
        """The level of the next session: a narrower one where the student holds the lesson's whole loop at this one."""
        is_held = self.state.item.bars == self.lesson.loop and self.state.is_stable(self.rules)
        return self.lesson.levels.after(self.level) if is_held else self.level

    @property
    def next_time(self) -> PracticeStep:
        """The first pass of a session that goes on today from where this one ended."""
        if self.options.tempo_bpm is not None:
            return self.step
        level = self.next_level
        return begin(self.state.at_level(level), self.today, self._rules_at(level)).step

    @property
    def has_grown(self) -> bool:
        """Whether the next session is judged more strictly than this one."""
        return self.next_level is not self.level

    @property
    def struggles(self) -> bool:
        """Whether the last two passes that were judged were both not clean, nor only as loose as slow waits are."""
        judged = [judge(one.measured, self._rules_of(one.step.kind)) for one in self.rounds if one.measured is not None]
        bad = [verdict.grade in (Grade.BAD, Grade.BROKEN) for verdict in judged[-BAD_TO_STRUGGLE:]]
        return len(bad) == BAD_TO_STRUGGLE and all(bad)

    def _rules_of(self, kind: PassKind) -> Rules:
        """What a pass of this `kind` is judged by: a review by the level at which the item was mastered."""
        return self._rules_at(self.state.review.level) if kind is PassKind.REVIEW else self.rules

    def _rules_at(self, level: Level) -> Rules:
        return Rules().for_lesson(self.lesson, level)

    def _notice(self, words: str) -> None:
        """Let the student read `words` before the next pass, too."""
        notice = words if self.step.notice is None else f"{self.step.notice} {words}"
        self.step = replace(self.step, notice=notice)
        self.state = replace(self.state, step=self.step)

    def veto(self) -> PracticeStep:
        """The student refuses what comes next: all stays as it was."""
        self.state, self.step = veto(self.state, self.rules)
        self._plan = self._laid_out()
        return self.step

    def result(self) -> SessionResult:
        """All passes as one session; at least one was played."""
        return whole([one.result for one in self.rounds], self.state.item.bars)

    def row(self) -> "ScoreRow":
        """What was judged of all passes, in a row."""
        return ScoreRow(tuple(one.result.score for one in self.rounds))

    def _laid_out(self) -> Plan:
        step, played = self.step, bool(self.rounds)
        options = replace(
            self.options,
            tempo_bpm=min(max(step.tempo_bpm, MIN_TEMPO_BPM), MAX_TEMPO_BPM),
            loops=step.repeats,
            bars=(step.bars[0] + 1, step.bars[1] + 1),
            demonstrations=0 if played else self.options.demonstrations,
            click=self._click(),
        )
        lesson = replace(self.lesson, score=reorchestrated(self.lesson.score)) if step.reorchestrated else self.lesson
        return plan_practice(lesson, options)

    def _click(self) -> ClickPattern | None:
        """What clicks in the next pass: a gap that the policy wants, else the student's own, which goes on."""
        click, gap = self.options.click, self.step.gap
        if gap is not None:
            return replace(click or PLAIN, gap=Gap(*gap))
        if click is None or not isinstance(click.gap, RandomGap):
            return click
        bars = sum(one.result.plan.score.bar_count for one in self.rounds)
        return replace(click, gap=click.gap.going_on(bars, len(self.rounds)))

    def _measured(self, result: SessionResult) -> PassResult:
        swap = self.state.equipment.swap
        performance = rewired(result.performance, swap)
        alignment = result.alignment
        if swap is not None:
            within = notes_within(result.score, result.unheard)
            alignment = with_unknown(align(result.score, performance, clocked=True), within)
        view = PassView(self.level.windows, self.rules.asked, result.device != KEYBOARD)
        return measure_pass(result.score, performance, alignment, result.plan.practised_bars, view)


def held_words(level: Level, after: Level) -> str:
    """That a student who holds a lesson at `level` is judged at the one `after` it."""
    return f"You hold it at {level}: judged as {after} from next time on."


# --- all passes in a row ----------------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class ScoreRow:
    """Scores in a row, a silence of some bars before each but the first: `score`, and where each begins."""

    parts: tuple[Score, ...]

    @cached_property
    def _joined(self) -> tuple[Score, tuple[int, ...]]:
        """The score, and the bar in which each part begins."""
        row: list[Score] = [self.parts[0]]
        starts, bars = [0], self.parts[0].bar_count
        for part in self.parts[1:]:
            rest = _rest(part)
            starts.append(bars + rest.bar_count)
            bars = starts[-1] + part.bar_count
            row += [rest, part]
        return Score.joined(row), tuple(starts)

    @property
    def score(self) -> Score:
        """All parts and the silences between them."""
        return self._joined[0]

    @property
    def start_bars(self) -> tuple[int, ...]:
        """The bar of `score` in which each part begins."""
        return self._joined[1]

    @cached_property
    def start_ns(self) -> tuple[int, ...]:
        """When each part begins."""
        tempo_map = self.score.tempo_map
        return tuple(int(ns) for ns in tempo_map.ns_at([tempo_map.bar_start(bar) for bar in self.start_bars]))

    def performance(self, played: Iterable[Performance]) -> Performance:
        """What was played to each part, in the time of `score`."""
        moved = [one.shifted(at_ns) for one, at_ns in zip(played, self.start_ns, strict=True)]
        hits, chokes = ([getattr(one, name) for one in moved] for name in ("hits", "chokes"))
        return Performance.from_array(np.concatenate(hits), np.concatenate(chokes))


def _rest(part: Score) -> Score:
    """Whole bars of silence in the tempo and meter of `part`, long enough to keep it from what was before."""
    tempo, meter = part.tempo_map.tempos[0], part.tempo_map.meters[0]
    bar_s = tempo.us_per_quarter / 1e6 * meter.bar_ticks / PPQ
    tempo_map = TempoMap.build([replace(tempo, tick=0)], [replace(meter, tick=0)])
    return Score.from_notes([], tempo_map, ceil(REST_S / bar_s) * meter.bar_ticks)


def whole(results: list[SessionResult], bars: tuple[int, int]) -> SessionResult:
    """Several sessions of one lesson as one; what was practised of it are the `bars` (first, last, from 0)."""
    assert results, "nothing was played"
    row = ScoreRow(tuple(result.score for result in results))
    score, performance = row.score, row.performance(result.performance for result in results)
    last = results[-1]
    unheard = tuple(
        (start_ns + begin_ns, start_ns + end_ns)
        for start_ns, result in zip(row.start_ns, results, strict=True)
        for begin_ns, end_ns in result.unheard
    )
    return SessionResult(
        plan=_whole_plan([result.plan for result in results], row, bars),
        score=score,
        performance=performance,
        alignment=with_unknown(align(score, performance, clocked=True), notes_within(score, unheard)),
        latency=last.latency,
        complete=last.complete,
        device=_played_on(results),
        output=last.output,
        pauses=tuple(
            replace(pause, bar=start + pause.bar)
            for start, result in zip(row.start_bars, results, strict=True)
            for pause in result.pauses
        ),
        felt=tuple(pair for result in results for pair in result.felt),
        phase=all_phases([result.phase for result in results]),
        unheard=unheard,
    )


def _whole_plan(plans: list[Plan], row: ScoreRow, bars: tuple[int, int]) -> Plan:
    """A plan whose one section is all that was played; its bars bear the lesson's names."""
    score, last = row.score, plans[-1]
    names = np.full(score.bar_count, bars[0], np.int64)
    for start, plan in zip(row.start_bars, plans, strict=True):
        played = plan.bar_names
        names[start : start + len(played)] = played
    silences = tuple(
        (start_ns + begin_ns, start_ns + end_ns)
        for start_ns, plan in zip(row.start_ns, plans, strict=True)
        for begin_ns, end_ns in plan.silences
    )
    ends = (*row.start_ns[1:], score.length_ns)
    segments = tuple(Segment(Phase.PASS, i, *span) for i, span in enumerate(zip(row.start_ns, ends, strict=True)))
    return replace(
        last,
        section=score,
        score=score,
        first_bar=bars[0],
        passes=len(plans),
        segments=segments,
        passes_start_ns=0,
        end_ns=score.length_ns,
        landing=last.landing[:0],
        rounds=Rounds(tuple(names.tolist()), row.start_bars, bars, silences),
    )


def _played_on(results: list[SessionResult]) -> str | None:
    """What most hits were played on."""
    devices: Counter[str] = Counter()
    for result in results:
        if result.device is not None:
            devices[result.device] += len(result.performance)
    return devices.most_common(1)[0][0] if devices else None
