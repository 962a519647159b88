"""The page about a week in a browser: quiet, alone, and as wide as the screen, whatever people are called."""

from datetime import datetime, timedelta
from pathlib import Path

import pytest

from station.cli.command_line import main
from tests.fakes.browser import Browser
from tests.fakes.kept_sessions import kept, users_history

_MONDAY = datetime(2026, 11, 23, 17)


@pytest.mark.parametrize("width", [360, 794])
def test_it_opens_in_peace_and_needs_no_sideways_scrolling(
    width: int, browser: Browser, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for kind in ("DATA", "CONFIG"):
        monkeypatch.setenv(f"XDG_{kind}_HOME", str(tmp_path / kind))
    name = "<script>alert(1)</script>" + "W" * 40
    for day in range(0, 7, 2):
        users_history().keep(kept(name, _MONDAY + timedelta(days=day), title="Rock" * 40, played_s=600.0))
    out = tmp_path / "week.html"
    assert main(["report", "--week", "2026-11-23", "--student", name, "--out", str(out)]) == 0
    browser.open(out, size=(width, 900))
    assert browser.faults() == []
    assert browser.requests() == []
    assert browser.run("return document.scripts.length") == 0
    assert browser.run("return document.querySelectorAll('svg title').length") == 7
    assert browser.run("return document.documentElement.scrollWidth <= window.innerWidth")
    assert name in browser.run("return document.querySelector('h1').textContent")
