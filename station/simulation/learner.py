"""A virtual student who learns, tires, forgets and comes to lean on feedback: for trying teaching policies on.

A learner's skill in a bar of the lesson is the speed (a share of the target tempo) that it plays comfortably, in
octaves:

    comfort = what it brought + fast + slow − effect of fatigue ± effect of feedback

How a bar goes depends on the overload, log2(speed) − comfort: the spread grows with it, and lapses and confusions rise
along a logistic curve. What a pass teaches is shared between two memories (Smith, Ghazizadeh & Shadmehr 2006): the
fast one learns and forgets quickly, the slow one slowly; only right repetitions teach, and the most where the speed is
near the comfortable one; wrong ones leave a bad habit that right ones must wear off (Duke 2009, by TEACHING). Live
feedback steadies the playing and feeds the fast memory, takes from the slow one, and is missed when it is not there
(guidance, by TEACHING). Rest takes fatigue away, and what was learnt too; a slow memory that is revisited after a day
lasts longer (Simmons 2012).

`practise` teaches, `examined` shows what would be played now and changes nothing.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.core.units import NS_PER_MS, s_from_ns
from station.music.judgement import Label
from station.music.score import Score
from station.simulation.learner_kinds import LearnerKind
from station.simulation.learner_params import HUMAN, LearnerParams
from station.simulation.student_form import SMALLEST_SD_MS, Form, usual_wait_ms
from station.simulation.student_limbs import limbs_of
from station.simulation.student_spec import StudentSpec
from station.simulation.virtual_student import VirtualPerformance, VirtualStudent

Floats = NDArray[np.float64]

RIGHT_WITHIN_MS = 40.0
RIGHT_WITHIN_INTERVALS = 0.2
"""A stroke further than both from where the student means to play is a wrong repetition: HUMANS calls 40 ms a clear
fault, but long waits are hard to keep (the spread grows with them), and a novice's wide stroke in a slow beat is no
bad habit. The share is our choice: two fifths of the way to where it would be another stroke."""
BAD_PASS = 0.75
"""A quitter counts a pass with fewer right strokes as bad; our choice."""
SPACING_S = 86_400.0
"""Gains last longer only after gaps of a day (TEACHING: Simmons 2012)."""

_LIMBS = 4


@dataclass(frozen=True, eq=False)
class Exercise:
    """One pass as it is asked of a learner.

    `score` at the tempo to be played; `bars` names the lesson's bar of each bar of `score`; `speed` its tempo over the
    target tempo; `feedback` 0–1 how much of it is commented on live (0: a blind probe).
    """

    score: Score
    bars: tuple[int, ...]
    speed: float
    feedback: float = 0.0


class Learner:
    """One learner and one lesson of `bar_count` bars."""

    def __init__(self, kind: LearnerKind, seed: int, bar_count: int, params: LearnerParams = HUMAN) -> None:
        self.kind = kind
        self._params = params
        rng = np.random.default_rng([seed, 99])
        weak = rng.permutation(bar_count) < round(kind.weak_share * bar_count)
        self.weak_bars: tuple[int, ...] = tuple(np.flatnonzero(weak).tolist())
        scatter = kind.bar_scatter_octaves * rng.standard_normal(bar_count)
        self._brought: Floats = math.log2(kind.start_speed) + scatter - kind.weak_octaves * weak
        self._fast, self._slow, self._habit = np.zeros(bar_count), np.zeros(bar_count), np.zeros(bar_count)
        self._bias_ms: Floats = kind.bias_ms + kind.lean_ms * rng.standard_normal(_LIMBS)
        self._lapse, self._confusion = np.full(_LIMBS, kind.lapse), np.full(_LIMBS, kind.confusion)
        self._fatigue, self._dependence = 0.0, 0.0
        self._slow_life_s = params.slow_life_s
        self._bad_passes = 0
        self._student = VirtualStudent(StudentSpec(seed=seed))

    # --- what a trial may ask -----------------------------------------------------------------------------------------

    @property
    def gone(self) -> bool:
        """Whether this learner has had enough."""
        return self.kind.quits_after is not None and self._bad_passes >= self.kind.quits_after

    def comfort(self, feedback: float = 0.0) -> Floats:
        """The comfortable speed of each bar of the lesson now, in octaves of the target tempo."""
        ceiling = math.log2(self.kind.ceiling_speed)
        learnt = np.minimum(self._brought + self._fast + self._slow, ceiling)
        helped = self._params.feedback_help_octaves * (feedback - (1.0 - feedback) * self._dependence)
        comfort: Floats = learnt + helped - self._params.fatigue_octaves * self._fatigue
        return comfort

    def practise(self, exercise: Exercise) -> VirtualPerformance:
        """Play the exercise and learn from it."""
        assert not self.gone, "this learner has left"
        played = self._student.play(exercise.score, self._form(exercise))
        self._learn(exercise, played)
        return played

    def examined(self, exercise: Exercise) -> VirtualPerformance:
        """What would be played now; nothing is learnt from it."""
        return self._student.twin().play(exercise.score, self._form(exercise))

    def rest(self, seconds: float) -> None:
        """Do something else."""
        self._fatigue *= math.exp(-seconds / self._params.recovery_s)
        self._fast *= math.exp(-seconds / self._params.fast_life_s)
        self._slow *= math.exp(-seconds / self._slow_life_s)
        if seconds >= SPACING_S:
            self._slow_life_s *= self._params.spacing_growth

    # --- how it plays -------------------------------------------------------------------------------------------------

    def _form(self, exercise: Exercise) -> Form:
        score, kind, params = exercise.score, self.kind, self._params
        bar, limb = np.array(exercise.bars)[score.bar], limbs_of(score)
        overload = math.log2(exercise.speed) - self.comfort(exercise.feedback)[bar]
        hurried = 1.0 / (1.0 + np.exp(params.comfort_odds - params.steepness * overload))
        steep = params.steepness
        spread = 1.0 + params.spread_per_octave * np.logaddexp(0.0, steep * overload) / steep
        sd_ms = kind.sd_interval_pct / 100.0 * usual_wait_ms(score) * spread
        miss = np.clip(self._lapse[limb] + self._habit[bar] + params.worst_lapse * hurried, 0.0, 1.0)
        return Form(
            bias_ms=self._bias_ms[limb] + kind.latency_ms,
            sd_ms=np.maximum(sd_ms, SMALLEST_SD_MS),
            miss=miss,
            wrong_piece=np.minimum(self._confusion[limb] + params.worst_confusion * hurried, 1.0 - miss),
            velocity_sd=kind.velocity_cv_pct / 100.0 * score.notes["velocity"].astype(np.float64),
            extra=kind.extra,
            wires=kind.wires,
        )

    # --- what it makes of it ------------------------------------------------------------------------------------------

    def _learn(self, exercise: Exercise, played: VirtualPerformance) -> None:
        score, feedback, params = exercise.score, exercise.feedback, self._params
        right = self._rightly_struck(played)
        practised, success = self._success(exercise, right)
        overload = math.log2(exercise.speed) - self.comfort(feedback)[practised]
        left = np.maximum(
            math.log2(self.kind.ceiling_speed) - (self._brought + self._fast + self._slow)[practised], 0.0
        )
        taught = self.kind.quickest * success * np.exp(-((overload / params.challenge_octaves) ** 2)) * left
        self._fast *= params.fast_kept
        self._slow *= params.slow_kept
        self._fast[practised] += params.fast_gain * (1.0 + params.feedback_to_fast * feedback) * taught
        self._slow[practised] += params.slow_gain * (1.0 - params.feedback_from_slow * feedback) * taught
        habit = self._habit[practised] + params.habit_gain * (1.0 - success) - params.habit_worn_off * success
        self._habit[practised] = np.clip(habit, 0.0, params.worst_habit)
        limbs = limbs_of(score)
        for limb in np.unique(limbs).tolist():
            share = params.limb_gain * float(right[limbs == limb].mean())
            self._lapse[limb] *= 1.0 - share
            self._confusion[limb] *= 1.0 - share
            self._bias_ms[limb] *= 1.0 - share * feedback
        self._fatigue += (1.0 - self._fatigue) * -math.expm1(-s_from_ns(score.length_ns) / params.tiring_s)
        self._dependence += params.habituation * (feedback - self._dependence)
        self._bad_passes = self._bad_passes + 1 if right.mean() < BAD_PASS else 0

    def _rightly_struck(self, played: VirtualPerformance) -> NDArray[np.bool_]:
        """Which rows the learner's own hands got right, (n,): swapped cables and latency are no mistake of theirs."""
        score, truth = played.score, played.truth
        struck = np.flatnonzero(truth.note_label != Label.MISS)
        hits = played.performance.hits[truth.hit_of_note[struck]]
        written = score.notes["piece"][struck].tolist()
        meant = np.array([self.kind.wires.get(Piece(p), p) for p in written], np.uint8)
        off_ms = (hits["at_ns"] - score.onset_ns[struck]) / NS_PER_MS
        off_ms -= self._bias_ms[limbs_of(score)[struck]] + self.kind.latency_ms
        right_within_ms = max(RIGHT_WITHIN_MS, RIGHT_WITHIN_INTERVALS * usual_wait_ms(score))
        right = np.zeros(len(score), bool)
        right[struck] = (hits["piece"] == meant) & (np.abs(off_ms) <= right_within_ms)
        return right

    def _success(self, exercise: Exercise, right: NDArray[np.bool_]) -> tuple[NDArray[np.int64], Floats]:
        """The lesson's bars that were practised, in order, and the share of right strokes in each."""
        bar = np.array(exercise.bars)[exercise.score.bar]
        practised, which = np.unique(bar, return_inverse=True)
        return practised, np.bincount(which, weights=right) / np.bincount(which)
