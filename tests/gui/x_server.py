"""A screen of the test's own: Xvfb on a free display number, ended with the test."""

import os
import shutil
import subprocess
from collections.abc import Iterator

import pytest

START_WITHIN_S = 20.0


def screen(size: str = "1400x900") -> Iterator[dict[str, str]]:
    """The environment of a child that shall draw on a new screen of so many pixels."""
    if shutil.which("Xvfb") is None:
        pytest.skip("Xvfb is not installed")
    read, write = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(write), "-screen", "0", f"{size}x24", "+extension", "GLX", "-nolisten", "tcp"],
        pass_fds=[write],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    os.close(write)
    try:
        with os.fdopen(read) as told:
            display = told.readline().strip()  # the server writes it when it is ready, or dies and closes the pipe
        if not display:
            pytest.fail("Xvfb did not start")
        yield {**os.environ, "DISPLAY": f":{display}"}
    finally:
        server.terminate()
        server.wait(START_WITHIN_S)
