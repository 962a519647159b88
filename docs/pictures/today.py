"""Draws the pictures of Today anew, from the window itself: `python docs/pictures/today.py [FOLDER]` on a screen.

Each size is a window of its own; without a screen run it under `xvfb-run -s "-screen 0 1920x1080x24 +extension GLX"`.
"""

import tempfile
from dataclasses import replace
from datetime import date, timedelta
from pathlib import Path

from imgui_bundle import imgui
from window_sizes import main, run, shot

from station.app.actions.today_actions import LookAtDay
from station.core.settings import Settings
from station.drills.library import find_lesson
from station.drills.mastery.next_pass import new_item
from station.drills.mastery.practice_steps import item_of
from station.drills.mastery.reviews import Review
from station.gui.panels.today_panel import TODAY
from station.practice.history.old_mastery import mastery_row
from station.store.opening import history_of
from tests.gui.drive import Drive, open_panel
from tests.gui.planned_day import practised

SETTLED = 30
"""Frames after which the drummer stands in the picture."""


def draw(folder: Path, size: tuple[int, int]) -> None:
    """The pictures of one size."""
    with tempfile.TemporaryDirectory() as sessions:
        drive = Drive(Path(sessions), None, 1, size)

        def scenario(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
            _practised_before(drive.state.settings)
            open_panel(ctx, TODAY)
            drive.wait_until(ctx, lambda state: state.today.today is not None)
            ctx.mouse_move_to_pos(imgui.ImVec2(2.0, 2.0))
            ctx.yield_(SETTLED)
            shot(drive, ctx, folder / f"today-{size[0]}.png")
            drive.station.dispatch(LookAtDay(date.today() - timedelta(days=1)))
            drive.wait_until(ctx, lambda state: state.today.looked_at is not None)
            ctx.scroll_to_bottom(f"//{TODAY}")
            ctx.yield_(3)
            shot(drive, ctx, folder / f"today-book-{size[0]}.png")

        run(drive, scenario)


def _practised_before(settings: Settings) -> None:
    """Three days in the book, a lesson that was begun and one whose review is due."""
    practised(settings)
    yesterday = date.today() - timedelta(days=1)
    for name, review in (("rock-1", Review()), ("rock-2", Review(yesterday, 0, date.today()))):
        item = item_of(find_lesson(name))
        state = replace(new_item(item, yesterday), review=review)
        history_of(settings).remember("student", [mastery_row(state)])


if __name__ == "__main__":
    main(__file__, draw)
