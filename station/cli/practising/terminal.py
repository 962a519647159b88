"""A live session in the terminal: the engine's process plays and hears, every stroke is shown as it is judged."""

from contextlib import ExitStack, suppress
from dataclasses import replace
from functools import partial
from pathlib import Path

from station.cli.console import is_attended, say
from station.core.clock import MonotonicClock
from station.core.errors import BadInput, DeviceError
from station.core.measured_latency import load_calibration
from station.core.settings import Settings
from station.devices.device_ports import no_device
from station.engine.engine_config import EngineConfig
from station.engine.supervisor import EngineSupervisor
from station.music.score import Score
from station.practice.control.pad_commands import PadCommands, ways_to_go_on
from station.practice.exam.exam_take import exam_runner
from station.practice.headless.end_signals import end_asked
from station.practice.headless.guarded_output import GuardedOutput
from station.practice.headless.live import LiveOutcome, LiveSetup, practise_live, wait_for_kits
from station.practice.headless.live_text import LEGEND, LiveText, level_words
from station.practice.session.adaptation import Adaptation
from station.practice.session.backing_track import Backing, BackingRequest
from station.practice.session.device_latency import latency_of
from station.practice.session.plan import Plan
from station.practice.session.runner import SessionRunner
from station.practice.session.session import Session
from station.sound.track import PreparedTrack
from station.sync.drill.drill_model import DrillModel
from station.sync.drill.drummed_model import is_soon_made, shipped_model

KIT_WAIT_S = 5.0
"""How long to look for a kit before giving up: a USB kit announces itself within two seconds; our choice."""

_LACKING_SENSORS = (
    "{count} of {asked} sensors on the sticks cannot be heard yet, and may still come;"
    " station devices monitor --sticks PORT shows why"
)


def practise_in_terminal(
    asked: Plan | Adaptation,
    settings: Settings,
    capture: Path,
    until_saved: ExitStack,
    request: BackingRequest | None = None,
    is_exam: bool = False,
) -> LiveOutcome:
    """Practise a plan, along to a track where one is asked for or in a song, or what an adaptation asks for.

    In an exam nothing is shown of what was right or wrong, and nothing pauses.

    From the first count-in on nothing ends the program before the session is kept: `until_saved` is left then.

    Raises `BadInput` for a track that cannot be had, `DeviceError` where there is no kit, or where the engine dies
    before it began.
    """
    pads = PadCommands(settings, asked.plan.score if isinstance(asked, Adaptation) else asked.score)
    latency = latency_of(settings, load_calibration())
    runner = exam_runner(asked, latency) if is_exam else SessionRunner(asked, latency, pads)
    ways_on = [] if is_exam else ways_to_go_on(settings)
    text, telling = LiveText(partial(say, end=""), ways_on), GuardedOutput()
    clock = MonotonicClock()
    config = EngineConfig.from_settings(settings)
    telling.attempt(say, "looking for a kit and a sound output …")
    with EngineSupervisor(config) as engine:
        setup = LiveSetup(engine, clock, text.show, telling, in_air=config.air is not None and bool(config.air.zones))
        wait_for_kits(engine, runner, clock, KIT_WAIT_S, len(config.kits), len(config.sticks))
        if not setup.is_played(runner.heard):
            raise DeviceError(f"{no_device(config.kits)}; station practice --virtual-student intermediate needs none")
        try:
            if 0 < len(runner.heard.devices) < len(config.kits):
                here = ", ".join(runner.heard.devices)
                telling.attempt(say, f"\nof {len(config.kits)} kits there is {here}; the others may come", end="")
            if (lacking := len(config.sticks) - len(runner.heard.sensors)) > 0:
                telling.attempt(say, f"\n{_LACKING_SENSORS.format(count=lacking, asked=len(config.sticks))}", end="")
            if not is_exam:
                telling.attempt(say, f"\n{level_words(runner.session.plan.level)}\n{LEGEND}")
            runner.session.waits = settings.auto_pause and bool(ways_on) and is_attended()
            if request is not None or runner.session.plan.lesson.band is not None:
                telling.attempt(say, "\nmaking the track ready …")
                runner.session.backing = _track(request, runner.session, settings)
            section = runner.session.plan.section
            may_track = bool(config.sticks) and not runner.session.plan.steps and is_soon_made(section)
            drill = _drill(section, telling) if may_track else None
            setup = replace(setup, asked=until_saved.enter_context(end_asked()))
            return practise_live(setup, runner, capture, drill)
        finally:
            telling.attempt(text.last_words, runner.session)


def _drill(section: Score, telling: GuardedOutput) -> DrillModel | None:
    """The model that the sticks are tracked by, None where a section has none."""
    telling.attempt(say, "\nlearning how the sticks move in this drill …", end="")
    with suppress(BadInput):
        return shipped_model(section)
    return None


def _track(request: BackingRequest | None, session: Session, settings: Settings) -> PreparedTrack | None:
    backing = Backing(request)
    backing.ask(session.plan, session.heard.rate_hz or settings.rate_hz, settings.band_drums)
    return backing.ready(wait_s=None)
