"""The simulated learners do what their model says: sizes where a formula gives one, else the direction."""

import math
from dataclasses import replace

import numpy as np
import pytest

from station.core.pieces import Piece
from station.music.judgement import Label
from station.simulation.learner import Exercise, Learner
from station.simulation.learner_kinds import LEARNERS, LearnerKind
from station.simulation.virtual_student import VirtualPerformance
from tests.fakes import scores

DAY_S = 86_400.0
EVEN = replace(LEARNERS["usual"], start_speed=0.70, bar_scatter_octaves=0.0, weak_share=0.0, lean_ms=0.0)


def _pass(speed: float, feedback: float = 0.0, times: int = 1) -> Exercise:
    """Two bars of the rock beat, whose target tempo is 100 bpm."""
    return Exercise(scores.rock_beat(2 * times, 100.0 * speed), (0, 1) * times, speed, feedback)


def _long(speed: float, feedback: float = 0.0) -> Exercise:
    """So often that shares and spreads can be measured."""
    return _pass(speed, feedback, times=300)


def _practised(kind: LearnerKind, passes: int, speed: float, feedback: float = 0.0, seed: int = 1) -> Learner:
    learner = Learner(kind, seed, 2)
    for _ in range(passes):
        learner.practise(_pass(speed, feedback))
    return learner


def _comfortable_speed(learner: Learner) -> float:
    return float(2.0 ** learner.comfort().mean())


def _missed(played: VirtualPerformance) -> float:
    return played.truth.count(Label.MISS) / len(played.score)


def test_a_learner_begins_where_its_kind_does() -> None:
    assert _comfortable_speed(Learner(EVEN, 1, 2)) == pytest.approx(0.70)


def test_misses_at_the_comfortable_speed() -> None:
    """Its own 2 %, and 40 % · 1/(1 + e²) = 4.77 %."""
    played = Learner(EVEN, 1, 2).examined(_long(0.70))
    expected, draws = 0.02 + 0.40 / (1 + math.e**2), len(played.score)
    assert abs(_missed(played) - expected) < 4 * math.sqrt(expected * (1 - expected) / draws)


def test_the_spread_at_twice_the_comfortable_speed() -> None:
    """4.5 % of 214 ms (eighths at 140 bpm), times 1 + 3·ln(1 + e⁸)/8 = 4.0001."""
    played = Learner(replace(EVEN, lapse=0.0, bias_ms=0.0), 1, 2).examined(_long(1.40))
    expected = 0.045 * 60_000 / 140 / 2 * 4.0001
    assert abs(played.asynchrony_ms().std() - expected) < 4 * expected * math.sqrt(1.5 / (2 * 5400))


def test_weak_bars_are_played_worse() -> None:
    learner = Learner(LEARNERS["usual"], 3, 8)
    assert len(learner.weak_bars) == 2
    played = learner.examined(Exercise(scores.rock_beat(800, 75.0), tuple(range(8)) * 100, 0.75))
    weak = np.isin(played.score.bar % 8, learner.weak_bars)
    missed = played.truth.note_label == Label.MISS
    assert missed[weak].mean() > missed[~weak].mean()


def test_practice_helps_and_rest_takes_some_of_it_back() -> None:
    learner = _practised(EVEN, 30, 0.75)
    after, before = _comfortable_speed(learner), 0.70
    learner.rest(DAY_S)
    assert before < _comfortable_speed(learner) < after


def test_forgetting_goes_on() -> None:
    kept = []
    for seconds in (DAY_S, 7 * DAY_S, 60 * DAY_S):
        learner = _practised(EVEN, 30, 0.75)
        learner.rest(seconds)
        kept.append(_comfortable_speed(learner))
    assert kept[0] > kept[1] > kept[2] > 0.70


def test_practice_far_too_fast_or_slow_teaches_less() -> None:
    at = {speed: _comfortable_speed(_rested(_practised(EVEN, 20, speed))) for speed in (0.40, 0.72, 1.30)}
    assert at[0.72] > at[0.40]
    assert at[0.72] > at[1.30]


def _rested(learner: Learner, seconds: float = 3600.0) -> Learner:
    learner.rest(seconds)
    return learner


def test_wrong_repetitions_leave_a_habit() -> None:
    """Measured far below every comfortable speed, where only what is ingrained goes wrong."""
    careful, reckless = (_practised(EVEN, 20, speed) for speed in (0.60, 1.40))
    assert _missed(reckless.examined(_long(0.35))) > _missed(careful.examined(_long(0.35))) + 0.05


def test_spaced_practice_lasts_longer_than_massed() -> None:
    massed, spaced = _practised(EVEN, 30, 0.75), Learner(EVEN, 1, 2)
    for _ in range(3):
        for _ in range(10):
            spaced.practise(_pass(0.75))
        spaced.rest(DAY_S)
    massed.rest(3 * DAY_S)
    for learner in (massed, spaced):
        learner.rest(21 * DAY_S)
    assert _comfortable_speed(spaced) > _comfortable_speed(massed)


def test_feedback_helps_now_and_hurts_retention() -> None:
    guided, alone = _practised(EVEN, 40, 0.75, feedback=1.0), _practised(EVEN, 40, 0.75)
    now = [float(learner.comfort(feedback).mean()) for learner, feedback in ((guided, 1.0), (alone, 0.0))]
    later = [float(_rested(learner, DAY_S).comfort().mean()) for learner in (guided, alone)]
    assert now[0] > now[1]
    assert later[0] < later[1]


def test_who_is_used_to_feedback_misses_it() -> None:
    learner = _practised(EVEN, 40, 0.75, feedback=1.0)
    fresh_loss = float((Learner(EVEN, 1, 2).comfort(1.0) - Learner(EVEN, 1, 2).comfort(0.0)).mean())
    assert float((learner.comfort(1.0) - learner.comfort(0.0)).mean()) > fresh_loss


def test_a_lean_is_only_lost_with_feedback() -> None:
    def lean_ms(feedback: float) -> float:
        learner = _practised(EVEN, 40, 0.60, feedback)
        return float(learner.examined(_long(0.60)).asynchrony_ms().mean())

    assert lean_ms(0.0) == pytest.approx(-12.0, abs=1.5)
    assert abs(lean_ms(1.0)) < 6.0


def test_playing_tires_and_rest_restores() -> None:
    learner = Learner(replace(EVEN, quickest=0.0), 1, 2)
    for _ in range(10):
        learner.practise(_pass(0.70, times=25))
    tired = _comfortable_speed(learner)
    learner.rest(3600.0)
    assert tired < 0.68
    assert _comfortable_speed(learner) == pytest.approx(0.70, abs=0.002)


def test_a_plateau_is_never_passed() -> None:
    learner = Learner(replace(LEARNERS["plateau"], quickest=5.0), 1, 2)
    for _ in range(200):
        learner.practise(_pass(0.85))
    learner.rest(3600.0)
    assert learner.comfort().max() <= math.log2(0.85) + 1e-9
    assert learner.comfort().max() > math.log2(0.75)


def test_a_quitter_leaves_after_bad_passes() -> None:
    learner = Learner(LEARNERS["quitter"], 1, 2)
    passes = 0
    while not learner.gone and passes < 20:
        learner.practise(_pass(1.40))
        passes += 1
    assert passes == 3
    assert not _practised(LEARNERS["quitter"], 20, 0.50).gone


def test_late_equipment_stays_late() -> None:
    kind = replace(LEARNERS["late_equipment"], start_speed=0.70, lean_ms=0.0)
    learner = _practised(kind, 60, 0.60, feedback=1.0)
    off_ms = learner.examined(_long(0.60)).asynchrony_ms().mean()
    assert off_ms == pytest.approx(100.0, abs=6.0)
    assert learner.comfort().mean() > math.log2(0.70)  # and that is no reason not to learn


def test_swapped_toms_are_reported_wrong_and_learnt_all_the_same() -> None:
    fill = Exercise(scores.beat_and_fill(1, 70.0), (0, 1, 2, 3), 0.70)
    swapped, straight = (Learner(LEARNERS[name], 1, 4) for name in ("swapped_toms", "usual"))
    toms = np.isin(fill.score.notes["piece"], (Piece.TOM_1, Piece.TOM_2))
    for _ in range(10):
        heard, meant = swapped.practise(fill).truth.note_label, straight.practise(fill).truth.note_label
        assert (heard[~toms] == meant[~toms]).all()
        assert (heard[toms & (meant == Label.MATCH)] == Label.WRONG_PIECE).all()
    np.testing.assert_allclose(swapped.comfort(), straight.comfort())


def test_an_examination_changes_nothing() -> None:
    one, two = Learner(EVEN, 1, 2), Learner(EVEN, 1, 2)
    one.examined(_pass(1.2))
    first, second = one.practise(_pass(0.7)), two.practise(_pass(0.7))
    assert first.performance.hits.tobytes() == second.performance.hits.tobytes()
    np.testing.assert_array_equal(one.comfort(), two.comfort())


@pytest.mark.parametrize("name", LEARNERS)
def test_every_kind_practises_and_is_reproducible(name: str) -> None:
    def history(seed: int) -> list[float]:
        learner, speeds = Learner(LEARNERS[name], seed, 2), []
        for _ in range(5):
            learner.practise(_pass(0.6, 0.5))
            speeds.append(_comfortable_speed(learner))
        return speeds

    assert history(1) == history(1)
    assert history(1) != history(2)
