"""A drummer with a kit and a sensor on each stick, in a process of its own: three ptys that speak bytes on time.

As a program: `python -m tests.fakes.virtual_drummer FOLDER PLAN`. PLAN is a JSON list of [at_ns, port, hex bytes],
times from the start of playing; for the word `unplug` or `plug` instead of bytes the port's cable is pulled or put in.
It says `ready` once its ports are there, FOLDER/kit, FOLDER/right and FOLDER/left, waits for `play START_NS`
(monotonic; what was due long before is left out), plays, says `done`, and keeps its ports until its input ends.
"""

import json
import sys
import time
from collections.abc import Iterable
from contextlib import ExitStack
from pathlib import Path
from typing import NamedTuple

from station.bench.rigs.devices.serial_kit import SerialKit
from station.core.units import NS_PER_MS, NS_PER_S
from station.simulation.sticks.stick_swing import SimulatedSticks
from station.simulation.sticks.swing_sensor import SimulatedStick
from tests.fakes.child import Child, say
from tests.fakes.imu_speech import Measured

PORTS = ("kit", "right", "left")
PLUG, UNPLUG = "plug", "unplug"
_TOO_LATE_NS = 100 * NS_PER_MS
G_M_S2 = 9.80665
DEGREE_RAD = 0.017453292519943295


class Deed(NamedTuple):
    """What happens at a port, `at_ns` from the start of playing: bytes in hex, `PLUG` or `UNPLUG`."""

    at_ns: int
    port: str
    what: str


class VirtualDrummer:
    """The drummer as the test sees them."""

    def __init__(self, folder: Path, plan: Iterable[Deed]) -> None:
        self._folder, path = folder, folder / "plan.json"
        path.write_text(json.dumps(sorted(plan, key=lambda deed: deed.at_ns)))
        self._child = Child(__name__, [str(folder), str(path)], {})

    def port(self, name: str) -> str:
        """What names one of `PORTS` on the command line."""
        return f"serial:{self._folder / name}"

    def play(self, start_ns: int) -> None:
        """Begin to play with the plan's time 0 at monotonic `start_ns`."""
        self._child.tell(f"play {start_ns}")

    def __enter__(self) -> "VirtualDrummer":
        return self

    def __exit__(self, *_: object) -> None:
        self._child.stop()


def measured(stick: SimulatedStick, row: int, rate_hz: float) -> Measured:
    """A sample as the sensor itself has it: by its own clock, in g and degrees a second."""
    g = tuple((stick.acceleration[row] / G_M_S2).tolist())
    rate = tuple((stick.rate[row] / DEGREE_RAD).tolist()) if stick.rate is not None else (0.0, 0.0, 0.0)
    return Measured(float(stick.number[row]) / rate_hz + 100.0, g, rate)


def pads(played: SimulatedSticks, start_s: float) -> list[Deed]:
    """The kit's strokes as General MIDI's note on."""
    return [
        Deed(hit.at_ns - round(start_s * NS_PER_S), "kit", bytes((0x99, 38, hit.velocity)).hex())
        for hit in played.pad_hits
    ]


# --- the child --------------------------------------------------------------------------------------------------------


def _play(ports: dict[str, SerialKit], plan: list[Deed], start_ns: int) -> None:
    for deed in plan:
        due_ns = start_ns + deed.at_ns
        left_ns = due_ns - time.monotonic_ns()
        if left_ns < -_TOO_LATE_NS and deed.at_ns < 0:
            continue
        if left_ns > 0:
            time.sleep(left_ns / NS_PER_S)
        port = ports[deed.port]
        if deed.what == UNPLUG:
            port.unplug()
        elif deed.what == PLUG:
            port.plug()
        else:
            port.play(bytes.fromhex(deed.what))


def _main(folder: Path, plan: Path) -> None:
    deeds = [Deed(*row) for row in json.loads(plan.read_text())]
    with ExitStack() as until_the_end:
        ports = {name: until_the_end.enter_context(SerialKit(folder / name)) for name in PORTS}
        say("ready")
        for line in sys.stdin:
            word, _, start = line.partition(" ")
            if word == "play":
                _play(ports, deeds, int(start))
                say("done")


if __name__ == "__main__":
    _main(Path(sys.argv[1]), Path(sys.argv[2]))
