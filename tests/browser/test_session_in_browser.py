"""The page about a session in a browser: every part there, quiet, alone, and its bars follow the take."""

from pathlib import Path

import pytest

from station.cli.command_line import main
from station.render.report.page.html_page import session_html
from tests.fakes.browser import Browser
from tests.unit.render.test_session_html import HOSTILE, hostile_page

PARTS = ("score", "next", "take", "bars", "charts", "figures")
AT = "document.querySelector('.take audio')"
SEEN_LINES = "[...document.querySelectorAll('.play-line')].filter((line) => line.checkVisibility())"


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A session whose bars have more than one line, with its take."""
    folder, out = tmp_path_factory.mktemp("session"), tmp_path_factory.mktemp("page") / "page.html"
    words = ("practice", "rock-song-1", "--loops", "1", "--headless", "--virtual-student", "beginner,seed=3")
    assert main([*words, "--no-pictures", "--report", str(folder)]) == 0
    assert main(["report", str(folder), "--out", str(out)]) == 0
    return out


@pytest.mark.parametrize(("width", "dark"), [(1000, False), (500, True)])
def test_every_part_is_there_and_nothing_is_asked_of_anybody(
    page: Path, browser: Browser, width: int, dark: bool, tmp_path: Path
) -> None:
    browser.open(page, dark=dark, size=(width, 600))
    browser.until("return document.querySelector('.take').dataset.ready")
    assert browser.faults() == []
    assert browser.requests() == []
    for part in PARTS:
        assert browser.run("return document.getElementById(arguments[0]).getBoundingClientRect().height", part) > 30
    assert browser.run("return document.documentElement.scrollWidth <= window.innerWidth")
    browser.picture(tmp_path / "page.png")
    assert (tmp_path / "page.png").stat().st_size > 10_000
    ground, ink = browser.run(
        "const s = getComputedStyle(document.body); return [s.backgroundColor, s.color].map((c) => "
        "c.match(/\\d+/g).slice(0, 3).reduce((sum, each) => sum + Number(each), 0))"
    )
    assert (ground < ink) == dark


def test_the_line_goes_through_the_bars_and_notes_take_their_colours(page: Path, browser: Browser) -> None:
    """92 beats a minute, four counted in: bar 2 begins after 8 of them, and stands on another line than bar 8."""
    browser.open(page, size=(600, 600))
    browser.until("return document.querySelector('.take').dataset.ready")
    assert browser.run(f"return {SEEN_LINES}.length") == 0
    on_line = []
    for beats in (9.0, 33.0):
        browser.run(f"{AT}.currentTime = arguments[0]", beats * 60 / 92)
        browser.until(f"return !{AT}.seeking && {SEEN_LINES}.length === 1")
        on_line.append(
            browser.run(f"return [...document.querySelectorAll('svg.bars')].indexOf({SEEN_LINES}[0].closest('svg'))")
        )
    assert on_line[0] == 0
    assert on_line[1] > 0
    shown = browser.run(
        "const fill = (state) => { const g = document.querySelector(`.bars .note.${state} .head g`);"
        " return g && getComputedStyle(g).fill }; return ['match', 'early', 'late'].map(fill)"
    )
    told = [fill for fill in shown if fill is not None]
    assert len(told) > 1
    assert len(set(told)) == len(told), "states differ in colour"
    signs = browser.run(
        "return [...document.querySelectorAll('.bars .note .sign')].every((sign) => "
        "(getComputedStyle(sign).visibility === 'visible') === "
        "sign.closest('.note').classList.contains(sign.classList[1]))"
    )
    assert signs, "and in the sign that is seen"
    assert browser.faults() == []


@pytest.mark.parametrize("word", [*HOSTILE[:3], "W" * 200], ids=["script", "image", "end of a picture", "long"])
def test_hostile_words_do_nothing(word: str, browser: Browser, tmp_path: Path) -> None:
    path = tmp_path / "hostile.html"
    path.write_text(session_html(hostile_page(word)), encoding="utf-8")
    browser.open(path, size=(500, 600))
    assert browser.run("return document.documentElement.scrollWidth <= window.innerWidth"), "no sideways scrolling"
    assert browser.run("return document.querySelector('h1').textContent") == word
    assert browser.run("return document.scripts.length + document.images.length") == 0
    assert browser.faults() == []
    assert browser.requests() == []
