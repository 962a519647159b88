"""A take in Chromium, opened from its file: it plays, the line follows, notes are lit, and the drummer moves."""

import hashlib
import json
from pathlib import Path

import pytest

from station.core.units import PPQ
from station.drills.library import find_lesson
from station.practice.headless.virtual_session import practise_virtually
from station.practice.session.plan import PlanOptions, plan_practice
from station.render.report.take.shown_take import ShownTake
from station.render.report.take.take_part import take_part
from station.scenes.demonstrator import Demonstrator
from station.scenes.report.take_media import shown_take
from station.scenes.soundtrack import Sounds
from station.simulation.student_spec import parse_spec
from station.sound.samples.load_kit import load_kit
from tests.fakes.browser import Browser
from tests.fakes.section_places import place_of

WIDTH = 600
"""Of the bars' line, in the units of their picture, both bars of the section on it."""
AT = "document.querySelector('.take audio')"
LINE = "Number(document.querySelector('.play-line').getAttribute('x1'))"
LIT = "document.querySelectorAll('.note.match, .note.early, .note.late').length"


@pytest.fixture(scope="module")
def take() -> ShownTake:
    plan = plan_practice(find_lesson("rock-1"), PlanOptions(loops=2, demonstrations=0))
    result = practise_virtually(plan, parse_spec("pro,seed=3")).result
    return shown_take(result, place_of(result), Demonstrator(), Sounds(load_kit("acoustic", 48_000)))


@pytest.fixture(scope="module")
def page(take: ShownTake, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The fragment in a page that holds to the contract: one system, a line that is hidden, a note each stroke."""
    notes = "".join(
        f'<g class="note miss" data-note="{k}"><circle cx="{25 * k + 12}" cy="40" r="8"/></g>' for k in range(24)
    )
    line = json.dumps([[0, 0], [8 * PPQ, WIDTH]])
    inside = f"{notes}<line class='play-line' y1='0' y2='80'/>"
    bars = f"<svg class='bars' viewBox='0 0 {WIDTH} 80' data-line='{line}'>{inside}</svg>"
    style = "<style>.play-line { display: none; stroke: red }</style>"
    head = "<!doctype html><html lang='en'><meta charset='utf-8'><title>A take</title>"
    path = tmp_path_factory.mktemp("take") / "page.html"
    path.write_text(f"{head}{style}<main>{take_part(take)}{bars}</main>", encoding="utf-8")
    return path


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


def test_a_take_plays_and_everything_follows_its_sound(browser: Browser, page: Path, take: ShownTake) -> None:
    opened(browser, page)
    assert browser.until(f"return {AT}.duration") == pytest.approx(take.length_s, abs=0.05)
    assert not browser.run("return document.querySelector('.play-line').checkVisibility()")
    assert browser.run("return document.querySelectorAll('.note.miss').length") == 24, "as the page has them"
    before = drummer(browser)
    browser.run(f"{AT}.currentTime = 3.0; return {AT}.play()")
    browser.until(f"return {AT}.currentTime > 4.5 && {LIT} >= 4")
    first, is_seen = browser.run(f"return [{LINE}, document.querySelector('.play-line').checkVisibility()]")
    assert is_seen
    browser.until(f"return {LINE} > arguments[0] + 20", first)
    browser.run(f"{AT}.pause()")
    assert browser.run("return document.querySelectorAll('.note.miss').length") == 0, "what is to come is plain"
    assert drummer(browser) != before
    assert browser.faults() == []
    assert browser.requests() == []


def test_line_and_notes_are_those_of_the_moment(browser: Browser, page: Path, take: ShownTake) -> None:
    """80 beats a minute, four counted in: bar 1 begins at 3 s, pass 2 at 9 s."""
    opened(browser, page)
    for time_s, share in ((3.75, 1 / 8), (6.0, 4 / 8), (10.5, 2 / 8)):
        sought(browser, time_s)
        assert browser.run(f"return {LINE}") == pytest.approx(share * WIDTH, abs=1)
        played = [note for one in take.passes if one.ticks[0][0] <= time_s for note in one.notes][24 * (time_s > 9) :]
        expected = {note: state for note, at_s, state in played if at_s <= time_s}
        shown = browser.run(
            "return [...document.querySelectorAll('.note')].map((n) => [Number(n.dataset.note), n.classList[1] ?? ''])"
        )
        assert {note: state for note, state in shown if state} == expected
    assert browser.run("return document.querySelector('.take-pass').textContent") == "Pass 2 of 2"
    sought(browser, 0.0)
    assert browser.run("return document.querySelectorAll('.note.miss').length") == 24, "as the page has them"


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
    browser.press("canvas", " ")
    browser.until(f"return !{AT}.paused")
    browser.press("canvas", " ")
    browser.until(f"return {AT}.paused")
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
    browser.until(f"return {LINE} > 20 && {LIT} > 0")
    assert browser.faults() == []
