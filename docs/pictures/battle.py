"""Draws the pictures of a battle anew, from the window itself: `python docs/pictures/battle.py [FOLDER]` on a screen.

Each size is a window of its own; without a screen run it under `xvfb-run -s "-screen 0 1920x1080x24 +extension GLX"`.
A whole battle is played in each, in both modes, by a scripted player at a fake kit.
"""

import tempfile
from pathlib import Path

from imgui_bundle import imgui
from window_sizes import USUAL, main, run, shot

from tests.gui.battle_scenario import battle
from tests.gui.drive import Drive
from tests.gui.friend_scenario import friend

KEPT = {
    "chosen": "chosen",
    "repeat board": "repeat",
    "replay": "replay",
    "improvised": "improvised",
    "join chosen": "join",
}
"""What of a battle is kept, and what it is called; in other sizes than the usual one the page of the choice alone."""


def draw(folder: Path, size: tuple[int, int]) -> None:
    """The pictures of one size."""
    with tempfile.TemporaryDirectory() as sessions:
        drive = Drive(Path(sessions), None, size=size)

        def scenario(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
            def look(name: str) -> None:
                if name in KEPT and (size == USUAL or name == "chosen"):
                    ctx.mouse_move_to_pos(imgui.ImVec2(2.0, 2.0))
                    shot(drive, ctx, folder / f"battle-{KEPT[name]}-{size[0]}.png")

            battle(drive, ctx, look)
            if size == USUAL:
                friend(drive, ctx, look)

        run(drive, scenario)


if __name__ == "__main__":
    main(__file__, draw)
