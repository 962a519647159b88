"""The output devices as they are at this moment, however long a stream has been playing.

PortAudio looks for devices only when it starts, and while a stream plays it cannot be started anew: in the process that
sounds, a device plugged in since, or another default, stays unknown. So a short-lived process of its own looks. Who
plays on the system's default compares it with what it plays on, and moves.
"""

import json
import os
import subprocess
import sys
from dataclasses import asdict

from station.core.errors import DeviceError
from station.sound.output.card_stream import SoundDevice
from station.sound.output.sound_output import list_outputs

TIMEOUT_S = 10.0
"""A driver that lists its devices for longer hangs (our choice: a cold start on a busy computer takes two)."""


def outputs_now(timeout_s: float = TIMEOUT_S) -> list[SoundDevice]:
    """Every device that can play, the system's default first; takes some tenths of a second, never in real time.

    Raises `DeviceError` where the devices cannot be listed.
    """
    command = [sys.executable, "-m", "station.sound.output.list_outputs"]
    try:
        listed = subprocess.run(command, capture_output=True, text=True, timeout=timeout_s, check=False, env=_alone())
        found = json.loads(listed.stdout)
    except (OSError, subprocess.TimeoutExpired, json.JSONDecodeError) as fault:
        raise DeviceError(f"the sound devices cannot be listed: {fault}") from fault
    if isinstance(found, str):
        raise DeviceError(found)
    return [SoundDevice(**device) for device in found]


def _alone() -> dict[str, str]:
    """The environment of a look that starts no JACK server: who looks wants to know what there is."""
    return {**os.environ, "JACK_NO_START_SERVER": "1"}


def _write_list() -> None:
    try:
        listed: object = [asdict(device) for device in list_outputs()]
    except DeviceError as fault:
        listed = str(fault)
    sys.stdout.write(json.dumps(listed))


if __name__ == "__main__":
    _write_list()
