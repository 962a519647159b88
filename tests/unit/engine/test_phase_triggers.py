"""The phase of a drill on sticks with sensors sounds through the engine, from the sensors' bytes on."""

import numpy as np

from station.core.events import Hit, PhaseEstimate
from station.core.imu import STANDARD_GRAVITY_M_S2, Mounting
from station.core.pieces import Limb
from station.core.units import NS_PER_S
from station.drills.library import find_lesson
from station.engine.engine import Engine
from station.engine.messages import EngineEvent, TrackPhase
from station.sync.drill.drill_model import HANDS
from station.sync.sonification.trigger_table import drill_triggers
from tests.fakes.impulse_kit import impulse_mixer
from tests.fakes.imu_speech import Measured, x_imu3
from tests.unit.sync.drummed_sticks import model_of, take

LESSON = "rock-1"
BLOCK = 128


def played(triggered: bool) -> tuple[np.ndarray, list[EngineEvent]]:
    """What a loop of the drill on two sticks sound like, (n,), and what the engine tells."""
    model, score = model_of(LESSON), find_lesson(LESSON).score
    engine = Engine(impulse_mixer(), own_stick=lambda device: Mounting(Limb[device]))
    for hand in HANDS:
        engine.sensor_found(hand.name, 0)
    engine.handle(TrackPhase(model, drill_triggers(score, model.repeats) if triggered else ()))
    motion, sound, told = take(LESSON, loops=1.5), [], list[EngineEvent]()
    for k, at_s in enumerate(motion.time_s.tolist()):
        for side, hand in enumerate(HANDS):
            force = tuple((motion.force[k, side] / STANDARD_GRAVITY_M_S2).tolist())
            rate = tuple(np.degrees(motion.rate[k, side]).tolist())
            engine.feed(hand.name, x_imu3(Measured(at_s, force, rate)), round(at_s * NS_PER_S))
        now_ns = round(at_s * NS_PER_S)
        told += engine.advance(now_ns)
        sound.append(engine.render(BLOCK, now_ns)[:, 0])
    return np.concatenate(sound), told


def test_what_the_phase_triggers_is_heard_and_is_no_hit() -> None:
    sound, told = played(triggered=True)
    assert any(isinstance(event, PhaseEstimate) and event.locked for event in told)
    assert np.count_nonzero(sound) >= len(find_lesson(LESSON).score) / 2  # it is found within a loop
    assert not any(isinstance(event, Hit) for event in told)


def test_without_triggers_the_phase_is_silent() -> None:
    sound, _ = played(triggered=False)
    assert np.count_nonzero(sound) == 0
