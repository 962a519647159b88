"""From a stroke to its sound, through real processes and JACK, while a drummer is drawn beside them.

    PYTHONPATH=. .venv/bin/python benchmarks/hit_to_sound.py [--periods 32 64 128] [--seconds 20] [--idle]

A kit in a process of its own plays strokes at random times into a MIDI port, the engine's process sounds them with a
drum kit of pulses, and a third process records what JACK is given. A fourth draws the drummer at 1280×720, 60 times a
second or as often as it can. Time is measured from the moment before the kit hands a stroke to its driver to the
moment at which JACK begins the period in which the sound's first frame lies: the driver's own wait for its next
period is within. The soak of ten minutes: --periods 128 --seconds 600 --a-second 33.4 (20,000 strokes).

A server of its own has one client beside all this that does nothing at all: the underflows that even it has, and the
time that a host took from this machine (`stolen`, Linux), tell what of ours is ours.

Targets (one period of P ms): median ≤ P + 0.7, 99th percentile ≤ P + 2, no stroke lost, none without a sound, at most
one underflow a minute. Stamps: their scatter within the driver's own period is its quantisation, what is beyond is
ours.
"""

import argparse
import os
import subprocess
import sys
import tempfile
import time
import wave
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Self

import numpy as np
from numpy.typing import NDArray

from station.core.events import DeviceFound, Hit
from station.core.units import NS_PER_MS, NS_PER_S
from station.devices.device_ports import DeviceRequest
from station.engine.engine_config import EngineConfig
from station.engine.engine_process import EngineProcess
from station.engine.messages import Ready, Status
from tests.fakes.engine_listener import EngineListener
from tests.fakes.jack_recorder import JackRecorder, Recording
from tests.fakes.jack_server import JackServer, joined
from tests.fakes.kit_player import KitPlayer, Stroke

KIT = "TD-17 fake kit"
RATE_HZ = 48_000
PULSE_S = 0.004
SNARE = bytes((0x99, 38, 110))
MATCH_NS = 25 * NS_PER_MS
"""A sound that comes later than this after a stroke is not its own."""
_DRAW = """
import time
from station.bench.rigs.drawer import SIZE, snapshots
from station.render.picture import PictureMaker
from station.render.quality import QUALITIES
maker, frames = PictureMaker(SIZE, QUALITIES[0]), snapshots(60)
print("draws", flush=True)
count, begun = 0, time.monotonic()
while True:
    maker.draw(frames[count % 60])
    count += 1
    time.sleep(max(0.0, begun + count / 60 - time.monotonic()))
    begun = max(begun, time.monotonic() - count / 60)
"""
_BARE = """
import sys, jack
client, late = jack.Client("bare", no_start_server=True), []
client.set_xrun_callback(late.append)
client.inports.register("in")
client.activate()
print("waits", flush=True)
sys.stdin.readline()
del late[:]
sys.stdin.readline()
print(len(late), flush=True)
"""


class BareClient:
    """A JACK client that does nothing, with a server to itself; use it as a context manager."""

    def __init__(self, period: int) -> None:
        self._server = JackServer(RATE_HZ, period)

    def begin(self) -> None:
        """Count from now on."""
        self._say()

    def underflows(self) -> int:
        """How often the server went on without it."""
        self._say()
        return int(self._hear())

    def _say(self) -> None:
        assert self._process.stdin is not None
        self._process.stdin.write("\n")
        self._process.stdin.flush()

    def _hear(self) -> str:
        assert self._process.stdout is not None
        return self._process.stdout.readline()

    def __enter__(self) -> Self:
        self._server.start()
        self._process = subprocess.Popen(
            [sys.executable, "-c", _BARE],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            env=self._server.env,
        )
        self._hear()
        return self

    def __exit__(self, *_: object) -> None:
        self._process.kill()
        self._process.communicate()
        self._server.stop()


def stolen_s() -> float:
    """For how long, over all processors, a host gave this machine's turns to others; 0 where nobody says."""
    try:
        return int(Path("/proc/stat").read_text().split()[8]) / os.sysconf("SC_CLK_TCK")
    except (OSError, ValueError, IndexError):
        return 0.0


def pulse_kit(folder: Path) -> Path:
    """A drum kit whose strokes are pulses of some milliseconds: each is told from the next at any density."""
    time_s = np.arange(round(PULSE_S * RATE_HZ)) / RATE_HZ
    pulse = (20_000 * np.cos(2 * np.pi * 3000 * time_s) * np.exp(-time_s / 0.0006)).astype("<i2")
    for piece in ("kick", "snare", "hihat_closed"):
        with wave.open(str(folder / f"{piece}.wav"), "wb") as file:
            file.setnchannels(1)
            file.setsampwidth(2)
            file.setframerate(RATE_HZ)
            file.writeframes(pulse.tobytes())
    return folder


def strokes(seconds: float, a_second: float) -> list[Stroke]:
    """Strokes that keep at least half their mean distance, at times that no period of any driver divides."""
    mean_ns = NS_PER_S / a_second
    gaps_ns = np.random.default_rng(1).uniform(0.5 * mean_ns, 1.5 * mean_ns, round(seconds * a_second))
    return [Stroke(int(at_ns), SNARE) for at_ns in np.cumsum(gaps_ns)]


@contextmanager
def drawing(wanted: bool) -> Iterator[None]:
    """A drummer is drawn meanwhile."""
    if not wanted:
        yield
        return
    with subprocess.Popen([sys.executable, "-c", _DRAW], stdout=subprocess.PIPE) as process:
        assert process.stdout is not None
        process.stdout.readline()
        try:
            yield
        finally:
            process.kill()


def onsets_ns(heard: Recording) -> NDArray[np.int64]:
    """When each pulse begins: the first frame above a hundredth after half a pulse's length of quiet."""
    loud = np.flatnonzero(np.abs(heard.sound[:, 0]) > 0.01)
    first = np.concatenate([[True], np.diff(loud) > round(PULSE_S * RATE_HZ)])
    found: NDArray[np.int64] = heard.at_ns[loud[first]]
    return found


def measure(period: int, plan: list[Stroke], draws: bool) -> None:
    """One run; prints a line a figure."""
    with tempfile.TemporaryDirectory() as name, JackServer(RATE_HZ, period) as server, joined(server):
        folder = Path(name)
        (folder / "kit").mkdir()
        config = EngineConfig(
            kits=(DeviceRequest(KIT),), midi_driver="jack", output="jack", drums=str(pulse_kit(folder / "kit"))
        )
        with (
            drawing(draws),
            KitPlayer(server, KIT, plan, folder) as kit,
            EngineProcess(config) as engine,
            JackRecorder(server, folder) as recorder,
            BareClient(period) as bare,
        ):
            listener = EngineListener(engine)
            listener.until(lambda event: isinstance(event, Ready))
            listener.until(lambda event: isinstance(event, DeviceFound))
            recorder.connect("PortAudio:.*")
            before = listener.until(lambda event: isinstance(event, Status))
            bare.begin()
            stolen_before_s = stolen_s()
            kit.play(time.monotonic_ns() + NS_PER_S // 2)
            sent_ns = np.array([stroke.at_ns for stroke in kit.truth()])
            listener.until_after(int(sent_ns[-1]) + NS_PER_S)
            beside = f"{bare.underflows()} of a client that does nothing, {stolen_s() - stolen_before_s:.1f} s stolen"
            heard = recorder.stop()
    assert isinstance(before, Status)
    status = [event for event in listener.events if isinstance(event, Status)][-1]
    underflows = f"{status.underflows - before.underflows} ({beside})"
    report(period, sent_ns, listener.hits(), onsets_ns(heard), underflows)


def report(
    period: int, sent_ns: NDArray[np.int64], hits: list[Hit], sounds_ns: NDArray[np.int64], underflows: str
) -> None:
    """Print what was measured."""
    place = np.minimum(np.searchsorted(sounds_ns, sent_ns), len(sounds_ns) - 1)
    wait_ns = sounds_ns[place] - sent_ns
    sounded = (wait_ns >= 0) & (wait_ns < MATCH_NS)
    wait_ms = wait_ns[sounded] / NS_PER_MS
    period_ms = 1000.0 * period / RATE_HZ
    print(f"{period} frames, a period of {period_ms:.2f} ms, {len(sent_ns)} strokes")
    print(f"  hit to sound   median {np.median(wait_ms):.2f} ms (≤ {period_ms + 0.7:.2f})")
    print(f"                 p99    {np.percentile(wait_ms, 99):.2f} ms (≤ {period_ms + 2.0:.2f})")
    print(f"  without sound  {np.count_nonzero(~sounded)}, strokes lost {len(sent_ns) - len(hits)}")
    minutes = (sent_ns[-1] - sent_ns[0]) / NS_PER_S / 60.0
    print(f"  underflows     in {minutes:.1f} min {underflows}")
    if len(hits) == len(sent_ns):
        stamp_ms = (np.array([hit.at_ns for hit in hits]) - sent_ns) / NS_PER_MS
        print(f"  stamps late    median {np.median(stamp_ms):.2f} ms, SD {stamp_ms.std():.2f}", end=" ")
        print(f"(the driver's own {period_ms / 12**0.5:.2f}), p99 {np.percentile(stamp_ms, 99):.2f} ms", flush=True)


def main() -> None:
    """Measure every period that is asked for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--periods", type=int, nargs="+", default=[32, 64, 128])
    parser.add_argument("--seconds", type=float, default=20.0)
    parser.add_argument("--a-second", type=float, default=10.0)
    parser.add_argument("--idle", action="store_true", help="draw nothing")
    arguments = parser.parse_args()
    for period in arguments.periods:
        measure(period, strokes(arguments.seconds, arguments.a_second), not arguments.idle)


if __name__ == "__main__":
    main()
