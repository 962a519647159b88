"""The trial of teaching policies: the rivals do what their names say, and what is counted is counted rightly."""

import numpy as np
import pytest

from station.bench.rigs.mastery_trial import Schedule, trial
from station.bench.rigs.mastery_tutors import TUTORS, FixedLadder, Mastery, Ratchet, Tutor
from station.drills.library import find_lesson
from station.drills.mastery.practice_steps import PracticeItem, item_of
from station.music.performance import HIT_DTYPE, Performance
from station.music.score import Score
from station.simulation.learner import Learner
from station.simulation.learner_kinds import LEARNERS

LESSON = find_lesson("rock-1")
ITEM: PracticeItem = item_of(LESSON)
SCORE: Score = LESSON.loop_score
LEARNER = Learner(LEARNERS["usual"], 1, 2)
SHORT = Schedule(days=2, session_s=40.0, block_s=20.0, exam_every_s=20.0)


def as_written(score: Score) -> Performance:
    hits = np.zeros(len(score), HIT_DTYPE)
    hits["at_ns"], hits["piece"], hits["velocity"] = score.onset_ns, score.notes["piece"], score.notes["velocity"]
    hits["openness"] = hits["position"] = np.nan
    return Performance.from_array(hits)


def tempi(tutor: Tutor, passes: int) -> list[float]:
    """What is asked for while every pass is played as it is written."""
    found = []
    for _ in range(passes):
        ask = tutor.ask()
        assert ask is not None
        found.append(ask.pct)
        tutor.hear(SCORE, as_written(SCORE), (0, 1))
    return found


def test_the_fixed_ladder_climbs_whatever_happens() -> None:
    assert tempi(FixedLadder(ITEM, passes_a_rung=3), 7) == [70, 70, 70, 75, 75, 75, 80]
    assert tempi(FixedLadder(ITEM), 60)[-1] == 100


def test_the_ratchet_climbs_after_two_clean_passes_and_stays_after_bad_ones() -> None:
    tutor = Ratchet(ITEM)
    assert tempi(tutor, 5) == [70, 70, 75, 75, 80]
    nothing = Performance.from_array(np.zeros(0, HIT_DTYPE))
    for _ in range(4):
        tutor.hear(SCORE, nothing, (0, 1))
    assert tempi(tutor, 1) == [80]


def test_ours_hears_a_perfect_pass_as_clean() -> None:
    """The minimal way up: see the policy's own tests."""
    assert tempi(Mastery(ITEM), 10) == [70, 70, 75, 75, 80, 80, 85, 85, 100, 100]


def test_none_is_the_target_from_the_start() -> None:
    assert tempi(TUTORS["none"](ITEM, 0, LEARNER), 3) == [100, 100, 100]


def test_random_is_the_same_for_the_same_seed() -> None:
    assert tempi(TUTORS["random"](ITEM, 3, LEARNER), 9) == tempi(TUTORS["random"](ITEM, 3, LEARNER), 9)
    assert len(set(tempi(TUTORS["random"](ITEM, 3, LEARNER), 9))) > 1


@pytest.mark.parametrize("tutor", TUTORS)
def test_a_trial_is_reproducible(tutor: str) -> None:
    outcome = trial(tutor, "usual", 3, SHORT)
    assert outcome == trial(tutor, "usual", 3, SHORT)
    assert 0 <= outcome.day_pct <= 100


def test_who_does_not_reach_the_criterion_counts_with_all_the_time() -> None:
    """Two sessions of 40 s; rock-fill-1 (seed 3) lasts 16 beats at 104 a minute, so that 8.67 fit in."""
    outcome = trial("none", "beginner", 3, SHORT)
    assert not outcome.reached
    assert outcome.minutes == pytest.approx(80 / 60)
    assert outcome.repetitions == pytest.approx(80 / (16 * 60 / 104), rel=1e-3)


def test_a_steady_ladder_has_no_turns_and_finds_no_weak_bars() -> None:
    outcome = trial("fixed ladder", "usual", 3, SHORT)
    assert (outcome.turns, outcome.found_pct) == (0.0, 0.0)


def test_swapped_cables_are_not_held_against_the_learner() -> None:
    """The same learner with and without them plays the same strokes, and the exams see that."""
    crossed, straight = (trial("none", kind, 3, SHORT) for kind in ("swapped_toms", "usual"))
    assert crossed.day_pct == pytest.approx(straight.day_pct)
    assert crossed.wrong_pct == pytest.approx(straight.wrong_pct)
