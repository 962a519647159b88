"""Draws the pictures of the history anew, from the window itself: `python docs/pictures/history.py [FOLDER]`.

Each size is a window of its own; without a screen run it under `xvfb-run -s "-screen 0 1920x1080x24 +extension GLX"`.
The practice of the student who is shown is made up.
"""

import tempfile
from dataclasses import replace
from datetime import date
from functools import partial
from pathlib import Path

from imgui_bundle import imgui
from window_sizes import USUAL, main, run, shot

from station.app.actions.history_actions import HistorySection, ReadAgain
from station.app.window_state import State
from station.gui.panels.history.history_panel import HISTORY
from station.store.database_url import sqlite_url
from station.store.opening import history_of
from tests.fakes.made_history import made_sessions
from tests.gui.drive import Drive, open_panel

SETTLED = 30
"""Frames after which the drummer stands in the picture."""
SESSIONS = 260


def draw(folder: Path, size: tuple[int, int]) -> None:
    """The pictures of one size."""
    with tempfile.TemporaryDirectory() as sessions:
        drive = Drive(Path(sessions), None, 1, size)
        url = sqlite_url(Path(sessions) / "history.sqlite3")
        store = drive.station.parts.store
        store.update(lambda settings: replace(settings, history=url))
        history = history_of(store.now)
        for kept in made_sessions(SESSIONS, date.today(), store.now.student):
            history.keep(kept)

        def scenario(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
            open_panel(ctx, HISTORY)
            drive.station.dispatch(ReadAgain())
            drive.wait_until(ctx, lambda state: bool(state.history.pages and state.history.pages.sessions))
            ctx.yield_(SETTLED)
            for section in HistorySection:
                if size != USUAL and section is not HistorySection.CALENDAR:
                    continue
                drive.window.pages.history.section = section
                drive.wait_until(ctx, partial(_is_read, section))
                ctx.mouse_move_to_pos(imgui.ImVec2(2.0, 2.0))
                ctx.yield_(5)
                shot(drive, ctx, folder / f"history-{section.value.lower()}-{size[0]}.png")

        run(drive, scenario)


def _is_read(section: HistorySection, state: State) -> bool:
    """Whether a page is there."""
    view = state.history
    return view.asked.section is section and view.pages is not None and not view.reads


if __name__ == "__main__":
    main(__file__, draw)
