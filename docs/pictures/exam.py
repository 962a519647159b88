"""Draws the pictures of an exam anew, from the window itself: `python docs/pictures/exam.py [FOLDER]` on a screen.

Each size is a window of its own; without a screen run it under `xvfb-run -s "-screen 0 1920x1080x24 +extension GLX"`.
"""

import tempfile
from pathlib import Path

from imgui_bundle import imgui
from window_sizes import USUAL, main, run, shot

from tests.gui.drive import Drive
from tests.gui.exam_scenario import exam

KEPT = {"asked": "asked", "looked at": "look", "marked": "marks"}
"""What of an exam is kept, and what it is called; in other sizes than the usual one the look alone."""
STUDENT = "intermediate,seed=2"


def draw(folder: Path, size: tuple[int, int]) -> None:
    """The pictures of one size."""
    with tempfile.TemporaryDirectory() as sessions:
        drive = Drive(Path(sessions), STUDENT, size=size)

        def scenario(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
            def look(name: str) -> None:
                if name in KEPT and (size == USUAL or name == "looked at"):
                    ctx.mouse_move_to_pos(imgui.ImVec2(2.0, 2.0))
                    shot(drive, ctx, folder / f"exam-{KEPT[name]}-{size[0]}.png")

            exam(drive, ctx, look)

        run(drive, scenario)


if __name__ == "__main__":
    main(__file__, draw)
