"""Where benchmarks open the window: on the screen that is there, or else on one of Xvfb's."""

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager


def installed(home: str) -> dict[str, str]:
    """The environment of a program that may keep its bytecode, here in `home`, as an installed one has it."""
    kept = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    return {**kept, "PYTHONPYCACHEPREFIX": home}


@contextmanager
def a_screen() -> Iterator[dict[str, str] | None]:
    """What the environment needs for a screen; None where there can be none."""
    if os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY") or sys.platform != "linux":
        yield {}
        return
    if shutil.which("Xvfb") is None:
        yield None
        return
    read, write = os.pipe()
    words = ["Xvfb", "-displayfd", str(write), "-screen", "0", "1400x900x24", "+extension", "GLX", "-nolisten", "tcp"]
    server = subprocess.Popen(words, pass_fds=[write], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(write)
    try:
        with os.fdopen(read) as said:
            display = said.readline().strip()
        yield {"DISPLAY": f":{display}"} if display else None
    finally:
        server.terminate()
        server.wait()
