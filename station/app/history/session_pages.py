"""Pages about sessions of the history, written as files and opened in the user's browser, beside what goes on.

Both are done in processes of their own: a page takes seconds, and a browser may take some to answer.
"""

import webbrowser
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from station.app.export import PAGE, take_along_folder
from station.app.worker_process import StartWork, Work
from station.core.disk.file_names import folder_name
from station.core.disk.files import write_whole
from station.core.errors import DeviceError, StationError
from station.core.settings import Settings


@dataclass(frozen=True, slots=True)
class PageFiles:
    """The session, by its id, whose page is being written (None: none), the pages that are there, by id.

    `opens` while the browser is being asked to show one.
    """

    writing: int | None = None
    written: Mapping[int, Path] = field(default_factory=dict)
    opens: bool = False


class SessionPages:
    """Writes one page at a time; `start` begins the work."""

    def __init__(self, start: StartWork) -> None:
        self._start = start
        self._writing: tuple[int, Work[Path]] | None = None
        self._opening: Work[Path] | None = None
        self._written: dict[int, Path] = {}

    def view(self) -> PageFiles:
        """What is shown."""
        writing = None if self._writing is None else self._writing[0]
        return PageFiles(writing, dict(self._written), self._opening is not None)

    def write(self, number: int, name: str, settings: Settings) -> None:
        """Begin the page about the session with that id, whose folder is or was `name`; raises `DeviceError`."""
        if self._writing is not None:
            raise DeviceError("one page at a time: another one is being written")
        out = take_along_folder(settings) / f"{folder_name(name)}{PAGE}"
        self._writing = number, self._start(write_page, number, settings, out)

    def open(self, number: int) -> None:
        """Ask the browser for the page that was written; raises `DeviceError` where it is not there any more."""
        path = self._written.get(number)
        if path is None or not path.is_file():
            self._written.pop(number, None)
            raise DeviceError("the page is not there any more: write it again")
        if self._opening is None:
            self._opening = self._start(open_in_browser, path)

    def advance(self) -> str:
        """A line where a page has come since the last call, else empty; raises the `StationError` that work met."""
        try:
            if self._opening is not None and self._opening.result() is not None:
                self._end_opening()
        except StationError:
            self._end_opening()
            raise
        return self._advance_writing()

    def _advance_writing(self) -> str:
        if self._writing is None:
            return ""
        number, work = self._writing
        try:
            path = work.result()
        except StationError:
            self._end_writing()
            raise
        if path is None:
            return ""
        self._end_writing()
        self._written[number] = path
        return f"kept in {path}"

    def close(self) -> None:
        """Give up what is being written."""
        self._end_opening()
        self._end_writing()

    def _end_writing(self) -> None:
        if self._writing is not None:
            self._writing[1].end()
        self._writing = None

    def _end_opening(self) -> None:
        if self._opening is not None:
            self._opening.end()
        self._opening = None


def write_page(number: int, settings: Settings, out: Path) -> Path:
    """Write the page about a session of the history, by its id, and return where it is; raises `StationError`."""
    from station.scenes.report.page_files import page_bytes

    write_whole(out, page_bytes(str(number), settings, PAGE))
    return out


def open_in_browser(path: Path) -> Path:
    """Show a page in the user's browser; raises `DeviceError` where there is none."""
    if not webbrowser.open(path.resolve().as_uri()):
        raise DeviceError(f"no browser was found: open {path} in one")
    return path
