"""A session's page in Chromium, opened from its file: its take plays, the line follows, notes are lit, all moves.

rock-1 at 80 beats a minute has two bars of four; four beats are counted in, so that bar 1 begins at 3 s and pass 2 at
9 s.
"""

import hashlib
import json
from pathlib import Path

import numpy as np
import pytest

from station.cli.command_line import main
from station.core.units import PPQ
from tests.fakes.browser import Browser

AT = "document.querySelector('.take audio')"
LINES = """[...document.querySelectorAll('.bars .play-line')]
    .filter((l) => l.checkVisibility({ visibilityProperty: true })).map((l) => Number(l.getAttribute('x1')))"""
LIT = "document.querySelectorAll('.bars .note:is(.match, .early, .late)').length"
STATES = """Object.fromEntries([...document.querySelectorAll('.bars .note')].map(
    (n) => [n.dataset.note, [...n.classList].filter((name) => name !== 'note').join()]))"""


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("take")
    words = ("practice", "rock-1", "--headless", "--virtual-student", "intermediate,seed=4", "--loops", "2")
    assert main([*words, "--no-pictures", "--no-demonstration", "--report", str(folder / "session")]) == 0
    out = folder / "page.html"
    assert main(["report", str(folder / "session"), "--out", str(out)]) == 0
    return out


def opened(browser: Browser, page: Path, ready: str = "picture") -> None:
    browser.open(page, size=(560, 620))  # few pixels, for they are drawn without a graphics card
    assert browser.until("return document.querySelector('.take').dataset.ready") == ready


def sought(browser: Browser, time_s: float) -> None:
    """Stand at a time, all that shows it drawn."""
    browser.run(f"{AT}.pause(); {AT}.currentTime = arguments[0]", time_s)
    browser.until(f"return !{AT}.seeking && {AT}.readyState >= 2")
    browser.driver.execute_async_script("const f = arguments[0]; requestAnimationFrame(() => requestAnimationFrame(f))")


def drummer(browser: Browser) -> str:
    """What the canvas shows, as a digest."""
    return hashlib.sha256(browser.driver.find_element("css selector", "canvas").screenshot_as_png).hexdigest()


def test_a_take_plays_and_everything_follows_its_sound(browser: Browser, page: Path) -> None:
    opened(browser, page)
    assert browser.until(f"return {AT}.duration") == pytest.approx(15 + 1.5, abs=1.0), "and what rings"
    assert browser.run(f"return {LINES}") == []
    before = drummer(browser)
    browser.run(f"{AT}.currentTime = 3.0; return {AT}.play()")
    browser.until(f"return {AT}.currentTime > 4.0 && {LIT} >= 4")
    (first,) = browser.until(f"const lines = {LINES}; return lines.length ? lines : null")
    browser.until(f"return {LINES}[0] > arguments[0] + 2", first)
    browser.run(f"{AT}.pause()")
    assert drummer(browser) != before
    assert browser.faults() == []
    assert browser.requests() == []
    assert (
        browser.run("return performance.getEntriesByType('resource').filter((r) => !/^(data|blob):/.test(r.name))")
        == []
    )


def test_line_and_notes_are_those_of_the_moment(browser: Browser, page: Path) -> None:
    opened(browser, page)
    over_all = browser.run(f"return {STATES}")
    times = json.loads(browser.run("return document.querySelector('.take-times').textContent"))
    places = json.loads(browser.run("return document.querySelector('svg.bars').dataset.line"))
    ticks, xs = np.array(places).T
    for time_s, beats in ((3.75, 1), (5.25, 3), (10.5, 2)):
        sought(browser, time_s)
        assert browser.run(f"return {LINES}[0]") == pytest.approx(np.interp(beats * PPQ, ticks, xs), abs=0.1)
        notes = times["passes"][time_s >= 9]["notes"]
        expected = {str(note): state for note, at_s, state in notes if at_s <= time_s}
        shown = browser.run(f"return {STATES}")
        assert {note: state for note, state in shown.items() if state} == expected
    assert browser.run("return document.querySelector('.take-pass').textContent") == "Pass 2 of 2"
    sought(browser, 0.0)
    assert browser.run(f"return {STATES}") == over_all, "as the page has them"


def test_views_keys_and_speed(browser: Browser, page: Path) -> None:
    opened(browser, page)
    sought(browser, 4.0)
    seen = {drummer(browser)}
    for view in range(1, 4):
        browser.click(f"[data-view='{view}']")
        sought(browser, 4.0)
        seen.add(drummer(browser))
    browser.press("canvas", "\ue012")  # the arrow to the left
    sought(browser, 4.0)
    assert len({*seen, drummer(browser)}) == 5
    assert browser.run("return document.querySelectorAll('[aria-pressed=true]').length") == 1
    for playing in (True, False):
        browser.press("canvas", " ")
        browser.until(f"return {AT}.paused !== arguments[0]", playing)
    browser.run(
        "const s = document.querySelector('.take-speed'); s.value = '0.5'; s.dispatchEvent(new Event('change'))"
    )
    assert browser.run(f"return {AT}.playbackRate") == 0.5
    assert browser.faults() == []


def test_without_webgl_the_sound_plays_and_a_sentence_says_why(browser: Browser, page: Path, tmp_path: Path) -> None:
    without = "<script>HTMLCanvasElement.prototype.getContext = () => null</script><main>"
    bare = tmp_path / "bare.html"
    bare.write_text(page.read_text(encoding="utf-8").replace("<main>", without, 1), encoding="utf-8")
    opened(browser, bare, ready="sound")
    assert "no WebGL" in browser.run("return document.querySelector('.take-no-picture').innerText")
    browser.run(f"{AT}.currentTime = 3.0; return {AT}.play()")
    browser.until(f"return {LINES}[0] > 4 && {LIT} > 0")
    assert browser.faults() == []
