"""Draws the pictures of the teacher's page anew: `python docs/pictures/teacher.py [FOLDER]` on a screen.

Each size is a window of its own; without a screen run it under `xvfb-run -s "-screen 0 1920x1080x24 +extension GLX"`.
"""

import os
import tempfile
from pathlib import Path

from imgui_bundle import imgui
from window_sizes import USUAL, main, run, shot

from tests.gui.drive import Drive
from tests.gui.teacher_scenario import ThereAndBack

KEPT = {"giving": "give", "the list": "list", "a take": "take", "returning": "return", "the note read": "note"}
"""What of the way there and back is kept, and what it is called; in other sizes than the usual one the take alone."""
STUDENT = "intermediate,seed=2"


def draw(folder: Path, size: tuple[int, int]) -> None:
    """The pictures of one size."""
    with tempfile.TemporaryDirectory() as home:
        os.chdir(home)
        os.environ["HOME"] = home
        drive = Drive(Path(home) / "sessions", STUDENT, size=size)

        def scenario(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
            def look(name: str) -> None:
                if name in KEPT and (size == USUAL or name == "a take"):
                    ctx.mouse_move_to_pos(imgui.ImVec2(2.0, 2.0))
                    shot(drive, ctx, folder / f"teacher-{KEPT[name]}-{size[0]}.png")

            ThereAndBack(drive, ctx, Path(), look).all()

        run(drive, scenario)


if __name__ == "__main__":
    main(__file__, draw)
