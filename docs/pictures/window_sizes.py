"""Pictures of the window in three sizes, a window of its own each: what the scripts that draw its pages share."""

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
from imgui_bundle import imgui

from station.render.files.png_file import write_png
from tests.gui.drive import Drive, Scenario

HERE = Path(__file__).parent
USUAL = (1280, 720)
SIZES = ((760, 480), USUAL, (1920, 1080))

Draw = Callable[[Path, tuple[int, int]], None]
"""Draws the pictures of one size into a folder."""


def shot(drive: Drive, ctx: imgui.test_engine.TestContext, path: Path) -> None:
    """The window as it stands, at `path`."""
    write_png(np.ascontiguousarray(drive.shot(ctx)), path)


def run(drive: Drive, scenario: Scenario) -> None:
    """Let the scenario draw; what goes wrong in it ends the script."""
    try:
        drive.run([scenario])
    finally:
        drive.station.close()
    assert not [seen["traceback"] for seen in drive.all_seen if "traceback" in seen], drive.all_seen


def main(script: str, draw: Draw) -> None:
    """`python SCRIPT [FOLDER]` draws all sizes, each in a process of its own; `SCRIPT FOLDER WIDTH HEIGHT` one."""
    words = sys.argv[1:]
    if len(words) > 1:
        draw(Path(words[0]).resolve(), (int(words[1]), int(words[2])))
        return
    folder = str(Path(*words or [HERE]).resolve())
    for width, height in SIZES:
        subprocess.run([sys.executable, script, folder, str(width), str(height)], check=True)
