"""Which program opens the station's files by double click: said to the system for this user alone, and taken back.

Linux and its like: an entry of the menu and kinds of files in the user's folder of data (freedesktop.org, Desktop Entry
Specification 1.5 and Shared MIME-info Database 0.21); Windows: keys below HKEY_CURRENT_USER (Microsoft, "File Types").
macOS takes such word from an application's bundle alone, which the station is not.
"""

import os
import subprocess
import sys
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from shutil import which
from xml.sax.saxutils import escape

from platformdirs import user_data_path

from station.core.disk.files import write_whole
from station.core.errors import DeviceError

COMMAND = (sys.executable, "-m", "station.cli.command_line")
"""How a file is opened; its path follows."""
KINDS = (
    ("assignment", "drum-assignment", "Assignment of the drum station"),
    ("return", "drum-return", "Return to a teacher of the drum station"),
    ("note", "drum-note", "Teacher's note of the drum station"),
    ("capture", "capture", "Take of the drum station"),
)
"""Our word, the ending and what people read. Lessons (`.toml`) stay with the user's text editor."""
_ENTRY, _TYPES = Path("applications/drum-station.desktop"), Path("mime/packages/drum-station.xml")
_UPDATES = (("update-mime-database", "mime"), ("update-desktop-database", "applications"))
"""What makes a system look anew, each with its folder; a desktop that lacks one looks by itself when it starts."""
_MAC = "on a Mac, Finder is told by hand: in a file's Info, Open with, choose the station, then Change All"


def register(command: Sequence[str] = COMMAND) -> list[str]:
    """Have double clicks open the station's files with `command`; lines on what was done. Raises `DeviceError`."""
    if sys.platform == "darwin":
        return [_MAC]
    if sys.platform == "win32":
        return _registered_on_windows(command)
    files = {_ENTRY: desktop_entry(command), _TYPES: mime_types()}
    for path, text in files.items():
        write_whole(_data() / path, text.encode())
    return [f"written  {_data() / path}" for path in files] + _updated()


def unregister() -> list[str]:
    """Take back what `register` did; lines on what was done. Raises `DeviceError`."""
    if sys.platform == "darwin":
        return [_MAC]
    if sys.platform == "win32":
        return _removed_on_windows()
    there = [_data() / path for path in (_ENTRY, _TYPES) if (_data() / path).exists()]
    for path in there:
        try:
            path.unlink()
        except OSError as fault:
            raise DeviceError(f"{path}: cannot be removed: {fault.strerror or fault}") from fault
    return [f"removed  {path}" for path in there] + (_updated() if there else ["nothing was registered"])


# --- Linux and its like -----------------------------------------------------------------------------------------------


def desktop_entry(command: Sequence[str]) -> str:
    """The entry of the menu, whose command gets the path of the file that was clicked."""
    run = " ".join(map(_quoted, command))
    types = "".join(f"{_mime(word)};" for word, _, _ in KINDS)
    return (
        "[Desktop Entry]\nType=Application\nName=Drum station\nComment=Practise the drums\n"
        f"Exec={run} %f\nTerminal=false\nCategories=AudioVideo;Audio;Education;\nMimeType={types}\n"
    )


def mime_types() -> str:
    """The kinds of files and how their names end."""
    kinds = "".join(
        f'  <mime-type type="{_mime(word)}">\n    <comment>{escape(words)}</comment>\n'
        f'    <glob pattern="*.{ending}"/>\n  </mime-type>\n'
        for word, ending, words in KINDS
    )
    head = '<?xml version="1.0" encoding="UTF-8"?>\n'
    return f'{head}<mime-info xmlns="http://www.freedesktop.org/standards/shared-mime-info">\n{kinds}</mime-info>\n'


def _mime(word: str) -> str:
    return f"application/x-drum-station-{word}"


def _quoted(word: str) -> str:
    """A word of Exec: in quotes, with a backslash before what a shell would read, % doubled, backslashes again."""
    inside = "".join(f"\\{letter}" if letter in '"`$\\' else letter for letter in word)
    return f'"{inside}"'.replace("\\", "\\\\").replace("%", "%%")


def _data() -> Path:
    """The user's folder of data, where the system looks for entries and kinds of all programs."""
    return user_data_path()


def _updated() -> list[str]:
    """Have the system look anew, where it has programs for that."""
    for program, folder in _UPDATES:
        path = which(program)
        if path is not None and (_data() / folder).is_dir():
            with suppress(OSError, subprocess.SubprocessError):
                subprocess.run([path, os.fspath(_data() / folder)], check=False, capture_output=True, timeout=20)
    missing = [program for program, _ in _UPDATES if which(program) is None]
    return [f"{program} is not here: log out and in again" for program in missing[:1]]


# --- Windows ----------------------------------------------------------------------------------------------------------


def registry_rows(command: Sequence[str]) -> list[tuple[str, str]]:
    """Keys below the user's Software, Classes, and their default values."""
    run = subprocess.list2cmdline([*command, "%1"]).replace("%1", '"%1"')
    rows = []
    for word, ending, words in KINDS:
        program = f"DrumStation.{word}"
        rows += [(f".{ending}", program), (program, words), (f"{program}\\shell\\open\\command", run)]
    return rows


def _registered_on_windows(command: Sequence[str]) -> list[str]:  # pragma: no cover - only there
    import winreg

    for key, value in registry_rows(command):
        with winreg.CreateKey(winreg.HKEY_CURRENT_USER, f"Software\\Classes\\{key}") as made:  # type: ignore[attr-defined]
            winreg.SetValueEx(made, "", 0, winreg.REG_SZ, value)  # type: ignore[attr-defined]
    return [f"registered  .{ending}" for _, ending, _ in KINDS]


def _removed_on_windows() -> list[str]:  # pragma: no cover - only there
    import winreg

    for word, ending, _ in KINDS:
        program = f"DrumStation.{word}"
        for key in (
            f".{ending}",
            *(program + below for below in ("\\shell\\open\\command", "\\shell\\open", "\\shell", "")),
        ):
            with suppress(OSError):
                winreg.DeleteKey(winreg.HKEY_CURRENT_USER, f"Software\\Classes\\{key}")  # type: ignore[attr-defined]
    return [f"removed  .{ending}" for _, ending, _ in KINDS]
