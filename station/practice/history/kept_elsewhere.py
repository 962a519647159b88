"""Where a student's sessions lie that are in no folder of theirs, and that the history could not be told of.

`kept-elsewhere.json` in the student's folder lists them until they are taken in; there is none where the history could
be reached at the end of every session.
"""

from contextlib import suppress
from pathlib import Path

from station.core.errors import BadInput, DeviceError
from station.practice.history.kept_json import kept_document
from station.practice.history.session_files import write_document

FILE_NAME = "kept-elsewhere.json"
SCHEMA = "drum-station/kept-elsewhere/1"
_MOST = 1000
"""Our choice: more are no sessions of somebody whose history is away for a while."""


def sessions_elsewhere(ours: Path) -> list[Path]:
    """The folders that are listed in a student's; none where the list cannot be read."""
    try:
        said = kept_document(ours / FILE_NAME)
    except BadInput:
        return []
    listed = said.get("folders") if isinstance(said, dict) and said.get("schema") == SCHEMA else None
    return [Path(each) for each in listed[:_MOST] if isinstance(each, str)] if isinstance(listed, list) else []


def remember_elsewhere(ours: Path, folder: Path) -> None:
    """List a session's folder, unless it is one of the student's own; where the disk refuses it is not listed."""
    there = folder.absolute()
    if ours.absolute() not in there.parents:
        _write(ours, list(dict.fromkeys([*sessions_elsewhere(ours), there])))


def forget_elsewhere(ours: Path, taken: list[Path]) -> None:
    """List these folders no more."""
    listed = sessions_elsewhere(ours)
    if set(listed) & set(taken):
        _write(ours, [path for path in listed if path not in taken])


def _write(ours: Path, folders: list[Path]) -> None:
    with suppress(DeviceError, OSError):
        if folders:
            write_document(ours / FILE_NAME, {"schema": SCHEMA, "folders": [str(path) for path in folders]})
        else:
            (ours / FILE_NAME).unlink(missing_ok=True)
