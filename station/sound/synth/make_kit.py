"""A synthesised kit made in a process of its own, where sound must not wait for it; what it leaves is on disk.

Making one takes seconds of numpy on long arrays; in the engine's own process a block of sound in two would come late.
"""

import os
import subprocess
import sys

from station.sound.synth.synth_cache import cached_kit, is_made
from station.sound.synth.synth_kits import MODELS

TIMEOUT_S = 120.0
"""Two seconds of a processor, on a computer however busy (our choice)."""


def make_kit_apart(model: str, rate_hz: int) -> None:
    """Have the kit `model` on disk at `rate_hz`, if it can be; a name that is no synthesised kit's is none of ours.

    Where no process can be had nothing is made, and whoever reads the kit makes it.
    """
    if model not in MODELS or is_made(model, rate_hz):
        return
    command = [sys.executable, "-m", "station.sound.synth.make_kit", model, str(rate_hz)]
    try:
        subprocess.run(command, timeout=TIMEOUT_S, check=False, capture_output=True, env=dict(os.environ))
    except (OSError, subprocess.TimeoutExpired):
        return


if __name__ == "__main__":
    cached_kit(sys.argv[1], int(sys.argv[2]))
