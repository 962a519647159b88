"""What the browser of the tests tells of a page: its console, what it asked a network for, and whether WebGL draws."""

from pathlib import Path

from tests.fakes.browser import Browser

_HEAD = "<!doctype html><meta charset=utf-8><title>A page</title><link rel=icon href=data:,>"


def _page(folder: Path, body: str) -> Path:
    path = folder / "page.html"
    path.write_text(_HEAD + body, encoding="utf-8")
    return path


def test_a_page_at_peace_tells_nothing(browser: Browser, tmp_path: Path) -> None:
    browser.open(_page(tmp_path, "<p id=it>Peace</p>"))
    assert browser.run("return document.getElementById('it').textContent") == "Peace"
    assert browser.faults() == []
    assert browser.requests() == []


def test_errors_are_told_once_and_not_of_the_next_page(browser: Browser, tmp_path: Path) -> None:
    broken = _page(tmp_path, "<script>console.error('a complaint'); missing()</script>")
    browser.open(broken)
    told = browser.faults()
    assert len(told) == 2
    assert "a complaint" in told[0]
    assert "missing is not defined" in told[1]
    assert browser.faults() == []
    browser.open(broken)
    browser.open(_page(tmp_path, "<p>Peace"))
    assert browser.faults() == []


def test_what_a_page_wants_of_a_network_is_refused_and_told(browser: Browser, tmp_path: Path) -> None:
    wants = "<img src='http://station.example/a.png' onerror='window.refused = true'><img src='beside.png'>"
    browser.open(_page(tmp_path, wants))
    browser.until("return window.refused")
    assert browser.requests() == ["http://station.example/a.png", (tmp_path / "beside.png").as_uri()]
    assert "ERR_NAME_NOT_RESOLVED" in "".join(browser.faults())


def test_webgl_draws_and_the_readers_theme_is_followed(browser: Browser, tmp_path: Path) -> None:
    page = _page(tmp_path, "<canvas></canvas>")
    drawn = """
        const gl = document.querySelector("canvas").getContext("webgl2");
        gl.clearColor(1, 0, 0, 1);
        gl.clear(gl.COLOR_BUFFER_BIT);
        const pixel = new Uint8Array(4);
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
        return [...pixel];
    """
    dark = "return matchMedia('(prefers-color-scheme: dark)').matches"
    browser.open(page, dark=True)
    assert browser.run(drawn) == [255, 0, 0, 255]
    assert browser.run(dark)
    browser.open(page)
    assert not browser.run(dark)
