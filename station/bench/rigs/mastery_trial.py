"""A trial of teaching policies on simulated learners, at equal time.

Three days of 20 minutes in blocks of five with a minute's breath between; every minute of playing the learner is
examined, blind, at the target tempo, without learning from it, and the criterion is reached with two clean exams in a
row. A day and a week after the last day it plays the whole eight times, blind; a day after, also 15 % faster than the
target, a tempo that no policy trains. Repetitions count the bars that were played, in whole loops. Who does not reach
the criterion counts with all the time, and all repetitions that it holds at the target tempo.

Exams know the learner's truth (which hit answers which note, and swapped cables); the policies hear only the hits. A
bar that a learner plays once is one repetition to learn from, also where a pass repeats it.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from station.bench.rigs.mastery_tutors import TUTORS, Tutor, TutorRequest
from station.core.units import s_from_ns
from station.drills.library import find_lesson
from station.drills.mastery.pass_measures.pass_facts import PassResult, measure_pass
from station.drills.mastery.practice_steps import PracticeItem, item_of
from station.drills.mastery.rules import DEFAULT_RULES
from station.drills.mastery.tempo_ladder import TOP_PCT
from station.drills.mastery.verdict import judge
from station.music.judgement import Label
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.matching.alignment import Alignment, Reference
from station.simulation.learner import Exercise, Learner
from station.simulation.learner_kinds import LEARNERS
from station.simulation.learner_params import HUMAN, perturbed
from station.simulation.student_limbs import limbs_of
from station.simulation.virtual_student import VirtualPerformance

LESSONS = ("bossa-fill-1", "half-time-fill-1", "linear-fill-1", "rock-fill-1", "shuffle-fill-1")
"""The shipped lessons of four bars that need both toms, so that weak bars and swapped cables can show; in turn."""
EXAMS_TO_PASS = 2
DAY_S = 86_400.0
RETENTION_PASSES = 8
TRANSFER_PCT = 115.0
WRONG_SHARE = 0.1
"""A bar with more of its strokes missed or misplaced is a wrong repetition: what a clean pass allows."""


@dataclass(frozen=True, slots=True)
class Schedule:
    """The time that all have: sessions on so many days in a row, a breath after each block, exams while playing."""

    days: int = 3
    session_s: float = 1200.0
    block_s: float = 300.0
    breath_s: float = 60.0
    exam_every_s: float = 60.0


USUAL_SCHEDULE = Schedule()


@dataclass(frozen=True, slots=True)
class TrialOutcome:
    """What became of one learner; shares in percent, None where there is none.

    `minutes` and `repetitions` to the criterion, `wrong_pct` of the bars played, `day_pct`, `week_pct` and
    `transfer_pct` of the notes right in the blind exams, `found_pct` of the weak bars practised alone, `turns` changes
    of the tempo's direction in 100 passes, `unused_min` left for the day early.
    """

    reached: bool
    minutes: float
    repetitions: float
    wrong_pct: float
    day_pct: float
    week_pct: float
    transfer_pct: float
    found_pct: float | None
    turns: float
    unused_min: float
    gone: bool


def trial(
    tutor: str, kind: str, seed: int, schedule: Schedule = USUAL_SCHEDULE, perturb_share: float = 0.0
) -> TrialOutcome:
    """Teach one learner for the whole time, and examine it afterwards.

    With `perturb_share` every number of the learner and of how people learn is drawn anew within that share.
    """
    return Trial(tutor, kind, seed, schedule, perturb_share).run()


def repetitions(tutor: str, kind: str, seed: int) -> float:
    """Teach one learner until it reaches the criterion, and no longer."""
    return Trial(tutor, kind, seed).to_criterion()


class Trial:
    """One learner, one tutor, one lesson."""

    def __init__(
        self, tutor: str, kind: str, seed: int, schedule: Schedule = USUAL_SCHEDULE, perturb_share: float = 0.0
    ) -> None:
        self._schedule = schedule
        self._lesson = LESSONS[seed % len(LESSONS)]
        self._item: PracticeItem = item_of(find_lesson(self._lesson))
        self._bars = len(self._item.bar_notes)
        rng = np.random.default_rng([seed, 41])
        person, nature = perturbed(LEARNERS[kind], rng, perturb_share), perturbed(HUMAN, rng, perturb_share)
        self._learner = Learner(person, seed, self._bars, nature)
        self._tutor: Tutor = TUTORS[tutor](self._item, seed, self._learner)
        self._played_s, self._bars_played, self._bars_wrong = 0.0, 0, 0
        self._exams_s, self._exams_clean = schedule.exam_every_s, 0
        self._criterion: tuple[float, float] | None = None
        self._pct: list[float] = []
        self._unused_s = 0.0

    def run(self) -> TrialOutcome:
        """All days, then the exams."""
        self._teach(all_the_time=True)
        self._learner.rest(DAY_S)
        after_day = self._exam(TOP_PCT, RETENTION_PASSES)
        transfer = self._exam(TRANSFER_PCT, RETENTION_PASSES)
        self._learner.rest(6 * DAY_S)
        after_week = self._exam(TOP_PCT, RETENTION_PASSES)
        minutes, repetitions = self._effort()
        return TrialOutcome(
            reached=self._criterion is not None,
            minutes=minutes,
            repetitions=repetitions,
            wrong_pct=100.0 * self._bars_wrong / max(self._bars_played, 1),
            day_pct=_right_pct(after_day),
            week_pct=_right_pct(after_week),
            transfer_pct=_right_pct(transfer),
            found_pct=self._found_pct(),
            turns=_turns(self._pct),
            unused_min=self._unused_s / 60,
            gone=self._learner.gone,
        )

    def to_criterion(self) -> float:
        """The repetitions until the criterion."""
        self._teach(all_the_time=False)
        return self._effort()[1]

    def _effort(self) -> tuple[float, float]:
        """Minutes and repetitions to the criterion."""
        all_s = self._schedule.days * self._schedule.session_s
        return self._criterion or (all_s / 60, all_s / sum(self._item.bar_s))

    def _teach(self, all_the_time: bool) -> None:
        for day in range(self._schedule.days):
            if day:
                self._learner.rest(DAY_S - self._schedule.session_s)
                self._tutor.new_day(day)
            self._session(all_the_time)

    def _session(self, all_the_time: bool) -> None:
        now_s, block_s = 0.0, 0.0
        while now_s < self._schedule.session_s and (all_the_time or self._criterion is None):
            ask = None if self._learner.gone else self._tutor.ask()
            if ask is None:
                self._unused_s += self._schedule.session_s - now_s
                return
            length_s = self._pass(ask)
            now_s, block_s = now_s + length_s, block_s + length_s
            if block_s >= self._schedule.block_s:
                self._learner.rest(self._schedule.breath_s)
                block_s = 0.0
            self._examine()

    def _pass(self, ask: TutorRequest) -> float:
        """Play what is asked for; returns its length in seconds."""
        if ask.on_ladder:
            self._pct.append(ask.pct)
        once = _score(self._lesson, ask.bars, 1, ask.pct)
        bars = tuple(range(ask.bars[0], ask.bars[1] + 1))
        parts = []
        for turn in range(ask.repeats):
            if self._learner.gone:
                break
            played = self._learner.practise(Exercise(once, bars, ask.pct / 100.0, ask.feedback))
            self._bars_wrong += _wrong_bars(once, self._truth(played))
            self._bars_played += len(bars)
            parts.append(played.performance.shifted(turn * once.length_ns))
        whole = _score(self._lesson, ask.bars, ask.repeats, ask.pct)
        self._tutor.hear(whole, _joined(parts), bars * ask.repeats)
        length_s = s_from_ns(whole.length_ns)
        self._played_s += length_s
        return length_s

    def _examine(self) -> None:
        if self._criterion is not None or self._played_s < self._exams_s:
            return
        self._exams_s += self._schedule.exam_every_s
        is_clean = judge(self._exam(TOP_PCT, 1), DEFAULT_RULES).is_clean
        self._exams_clean = self._exams_clean + 1 if is_clean else 0
        if self._exams_clean >= EXAMS_TO_PASS:
            self._criterion = self._played_s / 60, self._bars_played / self._bars

    def _exam(self, pct: float, times: int) -> PassResult:
        score = _score(self._lesson, self._item.bars, times, pct)
        bars = tuple(range(self._bars)) * times
        played = self._learner.examined(Exercise(score, bars, pct / 100.0))
        return measure_pass(score, played.performance, self._truth(played), bars)

    def _truth(self, played: VirtualPerformance) -> Alignment:
        """What the learner meant, as an alignment; swapped cables are put right."""
        score, truth, hits = played.score, played.truth, played.performance.hits
        paired = truth.hit_of_note >= 0
        asynchrony, label = np.zeros(len(score), np.int64), truth.note_label.copy()
        asynchrony[paired] = hits["at_ns"][truth.hit_of_note[paired]] - score.onset_ns[paired]
        for meant, reported in self._learner.kind.wires.items():
            crossed = paired & (hits["piece"][truth.hit_of_note] == reported)
            label[crossed] = np.where(score.notes["piece"][crossed] == meant, Label.MATCH, Label.WRONG_PIECE)
        return Alignment(
            hit_of_note=truth.hit_of_note,
            note_of_hit=truth.note_of_hit,
            note_label=label,
            hit_label=truth.hit_label,
            asynchrony_ns=asynchrony,
            hit_score_ns=hits["at_ns"],
            segment=np.zeros(len(hits), np.int64),
            reference=Reference.CLICK,
            sd_ms=None,
        )

    def _found_pct(self) -> float | None:
        weak = set(self._learner.weak_bars)
        return 100.0 * len(weak & self._tutor.chunks) / len(weak) if weak else None


# --- helpers ----------------------------------------------------------------------------------------------------------


@lru_cache(maxsize=2048)
def _score(lesson: str, bars: tuple[int, int], times: int, pct: float) -> Score:
    """Bars of a lesson at a share of the target tempo, with limbs; kept, for learners play the same ones often."""
    found = find_lesson(lesson)
    speed = pct / 100.0 * found.target_tempo_bpm / found.tempo_bpm
    score = found.score.bars(*bars).at_speed(speed).repeated(times)
    return score.with_limbs(limbs_of(score))


def _joined(parts: list[Performance]) -> Performance:
    if len(parts) == 1:
        return parts[0]
    return Performance.from_array(
        np.concatenate([part.hits for part in parts]), np.concatenate([part.chokes for part in parts])
    )


def _wrong_bars(score: Score, truth: Alignment) -> int:
    """How many bars went wrong."""
    wrong = np.isin(truth.note_label, (Label.MISS, Label.WRONG_PIECE))
    notes = np.bincount(score.bar)
    return int((np.bincount(score.bar, weights=wrong) > WRONG_SHARE * notes).sum())


def _right_pct(result: PassResult) -> float:
    return 100.0 * result.right / result.notes


def _turns(pct: list[float]) -> float:
    """How often the tempo turned back, in 100 passes."""
    way = np.sign(np.diff(np.array(pct)))
    way = way[way != 0]
    return 100.0 * float((way[1:] != way[:-1]).sum()) / max(len(pct), 1)
