"""Draws the pictures of a session's page anew, in Chromium: `python docs/pictures/session_page.py [FOLDER]`.

A virtual student whose kick is late and whose ghosts are loud practises a groove; the page of that is opened by night
at its top, and by day at its bars and charts.
"""

import os
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))  # tests.fakes, which are no part of what is installed

from station.cli.command_line import main
from tests.fakes.browser import Browser, chromium

STUDENT = "intermediate,seed=9,fault=late_kick:45,fault=loud_ghosts:9"
AT_S = 8.3
_READY = "return document.querySelector('.take').dataset.ready"


def draw(browser: Browser, page: Path, folder: Path) -> None:
    """Both pictures."""
    for name, dark, size, top in (("night", True, (900, 1130), "header"), ("day", False, (900, 960), "#bars")):
        browser.open(page, dark=dark, size=size)
        browser.until(_READY)
        browser.run("document.querySelector('.take audio').currentTime = arguments[0]", AT_S)
        browser.until("return !document.querySelector('.take audio').seeking")
        browser.run("document.querySelector(arguments[0]).scrollIntoView(); window.scrollBy(0, -12)", top)
        browser.driver.execute_async_script("const f = arguments[0]; setTimeout(f, 500)")
        browser.picture(folder / f"session-page-{name}.png")


if __name__ == "__main__":
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent
    with tempfile.TemporaryDirectory() as made:
        for kind in ("CONFIG", "DATA"):
            os.environ[f"XDG_{kind}_HOME"] = made
        session, page = Path(made) / "session", Path(made) / "page.html"
        asked = ("practice", "funk-1", "--headless", "--no-pictures", "--loops", "8", "--virtual-student", STUDENT)
        assert main([*asked, "--report", str(session)]) == 0
        assert main(["report", str(session), "--out", str(page)]) == 0
        with chromium(Path(made) / "browser") as browser:
            draw(browser, page, folder)
