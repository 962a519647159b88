"""The engine's process from inside: ready to begin as soon as it knows what to open, ended with its parent.

It polls the kits every half millisecond in its main thread; the sound card's driver asks for blocks in a thread of its
own. Whatever takes long to import is imported before it begins, and the sounds that will be wanted are made,
so that a process that waits as a spare begins at once.
"""

import gc
import signal
import sys
import time
import traceback
from contextlib import nullcontext, suppress
from functools import lru_cache
from multiprocessing.connection import Connection

from station.core.clock import monotonic_ns
from station.core.errors import StationError
from station.core.processes import silence_libraries
from station.devices.device_ports import Watches, watch_devices
from station.devices.mapping.device_file import own_kit
from station.devices.mapping.stick_file import own_stick
from station.devices.midi.midi_out import open_midi_output
from station.devices.port_watch import ClaimedPorts
from station.devices.stick_ports import StickWatches, watch_sticks
from station.engine.card import Card
from station.engine.engine import Engine
from station.engine.engine_config import WORN_OUT, EngineConfig, Prepare
from station.engine.engine_step import Runner
from station.engine.hotplug import Hotplug
from station.engine.messages import Command, EngineEvent, Notice, Ready, SetSounds, SoundsSet
from station.engine.pipes import Inbox, Outbox
from station.engine.priority import be_less_nice, be_real_time
from station.engine.sound_loader import SoundLoader
from station.sound.buses import ClickVoice
from station.sound.click_sounds import DEFAULT_TIMBRE, click_sounds
from station.sound.drum_kit import DrumKit, Frames
from station.sound.mixer import Mixer
from station.sound.output.sound_output import open_output
from station.sound.samples.load_kit import DEFAULT_KIT, load_kit
from station.sound.synth.make_kit import make_kit_apart
from station.sound.synth.synth_cache import is_made
from station.sound.synth.synth_kits import MODELS

POLL_S = 0.0004
"""Pause between two looks at the kits; with the work itself and the system's timer slack about half a millisecond."""
SWITCH_INTERVAL_S = 0.0002
"""How soon the audio callback gets the interpreter lock; 5 ms, Python's own choice, is four blocks of sound."""


def run_engine(commands: "Connection[None, Command]", events: "Connection[list[EngineEvent], None]") -> None:
    """The child's whole life: before any command it is sent its configuration, and before that what to make ready."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C reaches both; the parent asks the child to quit
    silence_libraries()
    try:
        config: object = commands.recv()
        if isinstance(config, Prepare):
            _make_ready(config)
            config = commands.recv()
    except (EOFError, OSError):  # a spare whose parent needs it no more
        return
    assert isinstance(config, EngineConfig), "an engine learns what to open before anything else"
    be_less_nice()
    outbox = Outbox(events)
    try:
        is_worn = _live(config, Inbox(commands), outbox)
    except Exception as fault:
        traceback.print_exc()
        outbox.put([Notice(f"the sound and MIDI engine failed: {fault!r}")])
        raise SystemExit(1) from fault
    finally:
        outbox.close()
    if is_worn:
        raise SystemExit(WORN_OUT)


def _make_ready(sounds: Prepare) -> None:
    """Make what the engine will ask for; only of kits that all processes share, for memory's sake."""
    with suppress(StationError):  # told when it is wanted
        if sounds.drums in MODELS and is_made(sounds.drums, sounds.rate_hz):
            _kit(sounds.drums, sounds.rate_hz)
        _click(sounds.click, sounds.rate_hz)
    gc.collect()
    gc.freeze()


def _live(config: EngineConfig, inbox: Inbox, outbox: Outbox) -> bool:
    """Runs until told to quit, or the parent is gone; returns whether it ended because it is worn out."""
    engine = Engine(
        open_midi_out=lambda port: open_midi_output(config.midi_driver, port, undisturbed),
        own_kit=own_kit,
        own_stick=own_stick,
    )
    sounds = SoundLoader(SetSounds(config.drums, config.click), _kit_beside_sound, _click)
    card = _card(engine, config, sounds, outbox) if config.sound else None
    undisturbed = card.paused if card is not None else nullcontext
    claims = ClaimedPorts()
    watches, sticks = _watches(engine, config, card, claims), _stick_watches(engine, config, claims)
    runner = Runner(engine, watches.kits, card, sticks=sticks.sticks)
    for command in config.first_commands:
        engine.handle(command)
    try:
        runner.start(monotonic_ns())
        sys.setswitchinterval(SWITCH_INTERVAL_S)  # not before: making the drum kit takes long turns
        gc.collect()
        gc.freeze()
        be_real_time()
        gc.disable()  # a collection in the audio thread is a late block; what runs from here on makes no cycles
        outbox.put([Ready(card.name, card.rate_hz) if card is not None else Ready(None)])
        while not (engine.quitting or inbox.is_closed or runner.is_worn_out):
            commands = inbox.pop_all()
            happened = runner.step(monotonic_ns())  # after taking them: what was played before a command counts before
            if happened:
                outbox.put(happened)
            for command in commands:
                if isinstance(command, SetSounds):
                    sounds.ask(command)
                else:
                    runner.handle(command)
            _take_sounds(engine, sounds, card)
            time.sleep(POLL_S)
    finally:
        runner.close()
        watches.close()
        sticks.close()
        outbox.put(engine.advance(monotonic_ns()))
    return runner.is_worn_out and not engine.quitting


def _take_sounds(engine: Engine, sounds: SoundLoader, card: Card | None) -> None:
    """Let sound what has been read."""
    read = sounds.advance(None if card is None else card.rate_hz)
    if read is None:
        return
    if read.kit is not None and read.clicks is not None:
        engine.use_sounds(read.kit, read.clicks)
    if card is not None and read.fault is None:
        card.forget_others()
    engine.report(SoundsSet(read.asked.drums, read.asked.click, read.fault))


def _watches(engine: Engine, config: EngineConfig, card: Card | None, claims: ClaimedPorts) -> Watches:
    watches = watch_devices(config.kits, config.midi_driver, monotonic_ns, card, claims)
    if watches.fault is not None:
        engine.notify(f"no MIDI kit can be heard: {watches.fault}")
    return watches


def _stick_watches(engine: Engine, config: EngineConfig, claims: ClaimedPorts) -> StickWatches:
    watches = watch_sticks(config.sticks, claims)
    if watches.fault is not None:
        engine.notify(f"not every stick can be heard: {watches.fault}")
    return watches


def _card(engine: Engine, config: EngineConfig, sounds: SoundLoader, outbox: Outbox) -> Card:
    def mixer(rate_hz: int) -> Mixer:
        drums, click = sounds.now.drums, sounds.now.click
        if drums in MODELS and not is_made(drums, rate_hz):
            outbox.put([Notice(f"the {drums} kit is being made for {rate_hz} Hz, this once; a few seconds")])
        return Mixer(_drums(engine, drums, rate_hz), _clicks(engine, click, rate_hz))

    return Card(
        engine,
        lambda: open_output(config.output, config.block_frames, config.rate_hz),
        mixer,
        Hotplug(config.output),
    )


@lru_cache(maxsize=2)  # the one that was chosen, and one that is tried
def _kit(name: str, rate_hz: int) -> DrumKit:
    return load_kit(name, rate_hz)


def _kit_beside_sound(name: str, rate_hz: int) -> DrumKit:
    """The kit, read while others sound."""
    make_kit_apart(name, rate_hz)
    return _kit(name, rate_hz)


@lru_cache(maxsize=4)
def _click(timbre: str, rate_hz: int) -> dict[ClickVoice, Frames]:
    return click_sounds(rate_hz, timbre)


def _drums(engine: Engine, name: str, rate_hz: int) -> DrumKit:
    """The kit called `name`; where it cannot be had the user is notified, and the default one plays."""
    try:
        return _kit(name, rate_hz)
    except StationError as fault:
        engine.notify(f"{fault}; the {DEFAULT_KIT} kit plays instead")
        return load_kit(DEFAULT_KIT, rate_hz)


def _clicks(engine: Engine, timbre: str, rate_hz: int) -> dict[ClickVoice, Frames]:
    """The clicks of `timbre`, likewise."""
    try:
        return _click(timbre, rate_hz)
    except StationError as fault:
        engine.notify(f"{fault}; the click called {DEFAULT_TIMBRE} plays instead")
        return click_sounds(rate_hz)
