"""What the engine's process hears of a kit that plays, over a serial line or JACK, while another process draws.

The set-up of every measurement of devices in real time: a JACK server where one is wanted, a kit, the engine, a drawer.
"""

import contextlib
import json
import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from station.bench.rigs.devices.jack_server import JackServer
from station.bench.rigs.devices.playing_kit import PlayingKit
from station.core.clock import monotonic_ns
from station.core.errors import DeviceError
from station.core.events import DeviceFound, Hit
from station.core.units import NS_PER_S
from station.devices.device_ports import DeviceRequest, parse_device
from station.engine.engine_config import EngineConfig
from station.engine.engine_process import EngineProcess
from station.engine.messages import EngineEvent, Ready, Status

KIT = "bench kit"
WITHIN_S = 30.0
LEAD_NS = NS_PER_S
AFTER_NS = NS_PER_S // 2
"""How long after the last stroke everything has been told; the engine's guard holds a hit back for 60 ms at most."""


@dataclass(frozen=True, slots=True)
class Wire:
    """What the kit speaks through: a JACK server of `jack_frames` a period, or where that is 0 a line of `baud`.

    A `patient` server waits for a client that a busy machine holds up, and loses no MIDI over it.
    """

    jack_frames: int = 0
    baud: int = 31_250
    patient: bool = False


@dataclass(frozen=True, eq=False)
class ListeningRig:
    """A kit and the engine that hears it."""

    player: PlayingKit
    engine: EngineProcess
    device: str

    def until(self, is_it: Callable[[EngineEvent], bool], within_s: float = WITHIN_S) -> list[EngineEvent]:
        """What the engine tells until `is_it` holds of something; raises `DeviceError` where it does not in time."""
        events: list[EngineEvent] = []
        give_up_s = time.monotonic() + within_s
        while not any(map(is_it, events)):
            if time.monotonic() > give_up_s:
                raise DeviceError(f"the engine did not tell in {within_s:g} s what was awaited")
            events += self.engine.events(0.05)
        return events

    def played(self, verb: str, step_ns: int, count: int) -> tuple[list[int], list[Hit]]:
        """When the kit sent each message, and the hits that the engine told of it."""
        start_ns = monotonic_ns() + LEAD_NS
        self.player.command(f"{verb} {start_ns} {step_ns} {count}")
        end_ns = start_ns + step_ns * count + AFTER_NS
        events = self.until(
            lambda event: isinstance(event, Status) and event.at_ns > end_ns, WITHIN_S + 2e-9 * (end_ns - start_ns)
        )
        sent: list[int] = json.loads(self.player.hear())
        return sent, [event for event in events if isinstance(event, Hit)]


@contextlib.contextmanager
def stage(wire: Wire, draws: bool = True) -> Iterator[ListeningRig]:
    """Everything set up, with the kit found; over a serial line the engine sounds nothing."""
    with contextlib.ExitStack() as things:
        folder = Path(things.enter_context(TemporaryDirectory()))
        if wire.jack_frames:
            server = things.enter_context(JackServer(period_frames=wire.jack_frames, patient=wire.patient))
            os.environ.update(server.env)
            player = things.enter_context(PlayingKit("jack", KIT))
            config = EngineConfig(kits=(DeviceRequest(KIT),), midi_driver="jack", output="jack")
        else:
            source = f"serial:{folder / 'kit'}"
            player = things.enter_context(PlayingKit("serial", str(folder / "kit"), str(wire.baud)))
            config = EngineConfig(kits=(parse_device(f"{source}@{wire.baud}"),), sound=False)
        if draws:
            things.enter_context(_drawing())
        engine = things.enter_context(EngineProcess(config))
        made = ListeningRig(player, engine, "")
        events = made.until(lambda event: isinstance(event, DeviceFound))
        device = next(event.device for event in events if isinstance(event, DeviceFound))
        if not any(isinstance(event, Ready) for event in events):
            made.until(lambda event: isinstance(event, Ready))
        yield ListeningRig(player, engine, device)


def read_barely(baud: int, step_ns: int, count: int) -> tuple[list[int], list[int]]:
    """When a kit on a line of `baud` sent each of `count` strokes, and when the plainest reader had each."""
    with TemporaryDirectory() as folder, PlayingKit("serial", f"{folder}/kit", str(baud)) as player, _drawing():
        words = [sys.executable, "-m", "station.bench.rigs.devices.bare_reader", f"{folder}/kit", str(count), "3"]
        with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as reader:
            assert reader.stdout is not None
            reader.stdout.readline()
            player.command(f"play {monotonic_ns() + LEAD_NS} {step_ns} {count}")
            sent: list[int] = json.loads(player.hear())
            read: list[int] = json.loads(reader.stdout.readline())
    return sent, read


@contextlib.contextmanager
def _drawing() -> Iterator[None]:
    """The app's picture at 60 frames a second, as a process beside the engine."""
    with subprocess.Popen(
        [sys.executable, "-m", "station.bench.rigs.drawer"], stdout=subprocess.PIPE, text=True
    ) as drawer:
        assert drawer.stdout is not None
        try:
            if not drawer.stdout.readline():
                raise DeviceError("nothing can be drawn here")
            yield
        finally:
            drawer.kill()
