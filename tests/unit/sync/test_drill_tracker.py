"""The tracker of drills against a student whose phase is known: another tempo, another manner, a stick less."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from station.core.events import PhaseEstimate, SensorMounted, SensorSamples
from station.motion.style.style import Style
from station.motion.style.style_file import load_style
from station.sync.drill.drill_model import HANDS
from station.sync.sticks import Sticks
from tests.unit.sync.drummed_sticks import Take, errors_ms, estimates, events, model_of, take

LESSON = "single-paradiddle"


@pytest.mark.parametrize("tempo", [0.5, 0.75, 1.0, 1.5, 2.0])
def test_half_to_double_the_tempo_locks_and_the_phase_is_right(tempo: float) -> None:
    """Written sixteenths are 214 ms apart at the lesson's tempo; a tenth of that is 21 ms."""
    model, played = model_of(LESSON), take(LESSON, tempo)
    found = estimates(model, events(played))
    late = slice(len(found) // 2, None)
    assert np.mean([e.locked for e in found[late]]) > 0.95
    assert abs(np.median(errors_ms(model, found, played.loop_s)[late])) < 10 / tempo
    assert np.percentile(np.abs(errors_ms(model, found, played.loop_s)[late]), 95) < 21 / tempo
    cadence = np.median([e.cadence_rad_s for e in found[late]])
    assert cadence == pytest.approx(2 * np.pi * tempo / model.cycle_s, rel=0.02)


@pytest.mark.parametrize("style", ["wild", "subdued"])
def test_another_manner_is_still_the_same_drill(style: str) -> None:
    model, played = model_of(LESSON), take(LESSON, 1.1, replace(load_style(style), seed=9))
    found = estimates(model, events(played))
    late = slice(len(found) // 2, None)
    assert np.mean([e.locked for e in found[late]]) > 0.95
    assert np.percentile(np.abs(errors_ms(model, found, played.loop_s)[late]), 95) < 30


def test_one_stick_is_enough() -> None:
    model, played = model_of(LESSON), take(LESSON)
    found = estimates(model, events(played, hands=HANDS[:1]))
    late = slice(len(found) // 2, None)
    assert np.mean([e.locked for e in found[late]]) > 0.9
    assert np.percentile(np.abs(errors_ms(model, found, played.loop_s)[late]), 95) < 50


def test_another_drill_does_not_lock() -> None:
    found = estimates(model_of(LESSON), events(take("train-1")))
    assert np.mean([e.locked for e in found]) < 0.05


def test_sticks_held_still_do_not_lock() -> None:
    """A model at rest is matched well by a stick at rest: only motion is a sign of life."""
    count = 1200
    force = np.tile([1.5, 0.0, 9.7], (count, 2, 1)) + np.random.default_rng(1).normal(0, 0.3, (count, 2, 3))
    rate = np.random.default_rng(2).normal(0, 0.02, (count, 2, 3))
    found = estimates(model_of(LESSON), events(Take(np.arange(count) / 200, force, rate, 1.0)))
    assert max(e.confidence for e in found) < 0.1
    assert not any(e.locked for e in found)


def test_who_stops_is_let_go_within_seconds_and_found_again() -> None:
    model, played = model_of(LESSON), take(LESSON, loops=3.0)
    rest = 1200
    still = np.zeros((rest, 2, 3))
    join = len(played.time_s) // 2
    held = played.force[join - 200 : join].mean(axis=0)
    force = np.concatenate([played.force[:join], still + held, played.force[join:]])
    rate = np.concatenate([played.rate[:join], still, played.rate[join:]])
    time_s = played.time_s[0] + np.arange(len(force)) / 200
    found = estimates(model, events(Take(time_s, force, rate, played.loop_s)))
    locked = np.array([e.locked for e in found])
    begin = join // 2  # two samples a step
    assert locked[begin - 100 : begin].all()
    assert not locked[begin + rest // 2 - 20 : begin + rest // 2].any()
    assert locked[-50:].all()


def test_any_chunks_of_samples_give_the_same_phases() -> None:
    model, played = model_of(LESSON), take(LESSON, loops=1.0)
    few, many = (estimates(model, events(played, chunk=chunk)) for chunk in (1, 23))
    shared = min(len(few), len(many))
    assert shared > 200
    assert np.allclose([e.phase_rad for e in few[:shared]], [e.phase_rad for e in many[:shared]])


def test_phases_are_in_range_and_in_order() -> None:
    found = estimates(model_of(LESSON), events(take(LESSON, loops=1.0)))
    assert all(-np.pi < e.phase_rad <= np.pi and 0 <= e.confidence <= 1 and e.quality <= 1.0001 for e in found)
    assert all(a.at_ns < b.at_ns for a, b in pairwise(found))


def test_a_sensor_that_is_mounted_otherwise_counts_from_then_on() -> None:
    """Sticks changed between the hands in the middle: told so, the phase is right again."""
    model, played = model_of(LESSON), take(LESSON, loops=3.0)
    told = events(played)
    swapped = [SensorMounted(0, told[k].device, told[1 - k].mounting) for k in (0, 1)]  # type: ignore[union-attr]
    join = len(played.time_s) // 2
    changed = Take(
        played.time_s,
        np.concatenate([played.force[:join], played.force[join:, ::-1]]),
        np.concatenate([played.rate[:join], played.rate[join:, ::-1]]),
        played.loop_s,
    )
    parts = events(changed)
    middle = 2 + 2 * (join // 5)
    found = estimates(model, [*parts[:middle], *swapped, *parts[middle:]])
    late = slice(-100, None)
    assert np.percentile(np.abs(errors_ms(model, found, played.loop_s)[late]), 95) < 30


def test_the_styles_own_chance_is_no_part_of_the_model() -> None:
    """A paradiddle of sixteenths stands twice in its bar: the drummer's small variations do not hide it."""
    assert model_of(LESSON).repeats == 2
    assert Style().variation > 0


def test_the_sticks_tell_phases_while_they_are_asked_for() -> None:
    """As the engine has it: sensors found before the drill was asked for are mounted in it too."""
    played, sticks = take(LESSON, loops=0.3), Sticks()
    told = events(played)
    mounted, samples = told[:2], told[2:]
    for event in mounted:
        sticks.handle(event)
    third = len(samples) // 3

    def phases(some: list[SensorMounted | SensorSamples]) -> int:
        return sum(isinstance(each, PhaseEstimate) for event in some for each in sticks.handle(event))

    assert phases(samples[:third]) == 0
    sticks.track_drill(model_of(LESSON))
    assert phases(samples[third : 2 * third]) > 15
    sticks.track_drill(None)
    assert phases(samples[2 * third :]) == 0
