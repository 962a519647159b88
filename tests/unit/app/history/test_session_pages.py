"""Pages of sessions: one is written at a time, it is said where it is, and the user's browser is asked for it."""

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from station.app.history.session_pages import PageFiles, SessionPages, open_in_browser, write_page
from station.core.errors import DeviceError, StationError
from station.core.settings import Settings

NAME = "2026-03-01T18-30-05_rock-1"
ASK = "import pathlib, sys; from station.app.history.session_pages import open_in_browser as show"
BROWSER = "#!{python}\nimport pathlib, sys\npathlib.Path({seen!r}).write_text(sys.argv[1])\n"


class Held:
    """Work that goes on until it is given its `found`."""

    def __init__(self, do: Callable[..., Any], *words: object) -> None:
        self.do, self.words = do, words
        self.found: object = None
        self.was_ended = False

    def result(self) -> Any:  # noqa: ANN401 - whatever the work gives
        if isinstance(self.found, StationError):
            raise self.found
        return self.found

    def end(self) -> None:
        self.was_ended = True


class Desk:
    """The pages of a student, whose work is the test's own."""

    def __init__(self, folder: Path) -> None:
        self.settings = Settings(sessions=str(folder), student="Ada")
        self.begun: list[Held] = []
        self.pages = SessionPages(self.start)

    def start(self, do: Callable[..., Any], *words: object) -> Held:
        self.begun.append(Held(do, *words))
        return self.begun[-1]

    def written(self) -> Path:
        """Write a page; where it is."""
        self.pages.write(7, NAME, self.settings)
        path = self.begun[-1].words[-1]
        assert isinstance(path, Path)
        path.write_text("page")
        self.begun[-1].found = path
        assert self.pages.advance() == f"kept in {path}"
        return path


@pytest.fixture
def desk(tmp_path: Path) -> Desk:
    return Desk(tmp_path)


def test_it_is_busy_until_the_page_is_there_and_says_where(desk: Desk) -> None:
    desk.pages.write(7, NAME, desk.settings)
    assert desk.pages.advance() == ""
    assert desk.pages.view() == PageFiles(writing=7)
    with pytest.raises(DeviceError, match="one page at a time"):
        desk.pages.write(8, NAME, desk.settings)
    (work,) = desk.begun
    assert (work.do, work.words[0]) == (write_page, 7)
    path = work.words[-1]
    assert isinstance(path, Path)
    assert path.name == f"{NAME}.html"
    work.found = path
    assert desk.pages.advance() == f"kept in {path}"
    assert desk.pages.view() == PageFiles(written={7: path})
    assert desk.pages.advance() == ""
    assert work.was_ended


def test_a_page_that_cannot_be_written_is_said_and_may_be_tried_again(desk: Desk) -> None:
    desk.pages.write(7, NAME, desk.settings)
    desk.begun[0].found = DeviceError("the disk is full")
    with pytest.raises(DeviceError, match="the disk is full"):
        desk.pages.advance()
    assert desk.pages.view() == PageFiles()
    assert desk.written().exists()


def test_the_browser_is_asked_once_for_the_page(desk: Desk) -> None:
    path = desk.written()
    desk.pages.open(7)
    desk.pages.open(7)
    assert [work.do for work in desk.begun] == [write_page, open_in_browser]
    assert desk.begun[-1].words == (path,)
    assert desk.pages.view().opens
    desk.begun[-1].found = path
    assert desk.pages.advance() == ""
    assert desk.pages.view() == PageFiles(written={7: path})


def test_a_page_that_was_deleted_is_to_be_written_again(desk: Desk) -> None:
    desk.written().unlink()
    with pytest.raises(DeviceError, match="write it again"):
        desk.pages.open(7)
    assert desk.pages.view() == PageFiles()


def test_a_browser_that_is_not_there_is_one_line(desk: Desk) -> None:
    desk.written()
    desk.pages.open(7)
    desk.begun[-1].found = DeviceError("no browser was found")
    with pytest.raises(DeviceError, match="no browser"):
        desk.pages.advance()
    assert not desk.pages.view().opens


@pytest.mark.skipif(os.name != "posix", reason="a script stands in for the browser")
def test_the_user_s_browser_gets_the_file_s_address(tmp_path: Path) -> None:
    page, seen, browser = tmp_path / "a page.html", tmp_path / "seen", tmp_path / "browser"
    browser.write_text(BROWSER.format(python=sys.executable, seen=str(seen)))
    browser.chmod(0o755)
    command = [sys.executable, "-c", f"{ASK}; show(pathlib.Path(sys.argv[1]))", str(page)]
    subprocess.run(command, env={**os.environ, "BROWSER": str(browser)}, check=True)
    assert seen.read_text() == f"file://{tmp_path}/a%20page.html"
