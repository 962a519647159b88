"""Draws the pictures of the editor anew, from the window itself: `python docs/pictures/editor.py [FOLDER]` on a screen.

Each size is a window of its own; without a screen run it under `xvfb-run -s "-screen 0 1920x1080x24 +extension GLX"`.
"""

import tempfile
from pathlib import Path

from imgui_bundle import imgui
from window_sizes import SIZES, main, run, shot

from station.app.actions.editor_actions import OpenEditor, PutCursor, SelectBars
from station.core.pieces import Piece
from station.core.units import PPQ
from station.drills.editing.grid_cursor import BarRange, Cursor
from station.drills.editing.lesson_edits import LineAt
from station.gui.panels.editor.editor_panel import EDITOR
from tests.gui.drive import Drive

LESSON = "rock-endings-1"
SETTLED = 60
"""Frames after which the drummer stands in the picture."""


def draw(folder: Path, size: tuple[int, int]) -> None:
    """The pictures of one size."""
    with tempfile.TemporaryDirectory() as sessions:
        drive = Drive(Path(sessions), None, 1, size)

        def scenario(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
            drive.station.dispatch(OpenEditor(LESSON))
            drive.station.dispatch(SelectBars(BarRange(0, 1, 1)))
            drive.station.dispatch(PutCursor(Cursor(0, 0, PPQ, LineAt(0, Piece.SNARE))))
            ctx.yield_(SETTLED)
            shot(drive, ctx, folder / f"editor-{size[0]}.png")
            leaves = ["Words"] if size[0] > SIZES[0][0] else ["Notation", "Words"]
            for leaf in leaves:
                ctx.item_click(f"//{EDITOR}/**/{leaf}##leaf")
                ctx.mouse_move_to_pos(imgui.ImVec2(2.0, 2.0))
                shot(drive, ctx, folder / f"editor-{leaf.lower()}-{size[0]}.png")

        run(drive, scenario)


if __name__ == "__main__":
    main(__file__, draw)
