"""The settings of this run: what the file said, what this call says instead, what the user has changed since.

Everyone asks the store, and the store alone writes the file: it reads it afresh, changes the keys that the user has
changed, and puts it back whole, so that what another process has written meanwhile stays. What a call says
(command-line options) holds for this run and never reaches the file, unless the user changes that very setting. A file
that cannot be read or written costs nobody the practice: the defaults and all changes hold for this run.
"""

from collections.abc import Callable, Mapping
from dataclasses import fields, replace
from pathlib import Path
from types import MappingProxyType

from station.core.errors import StationError
from station.core.settings import Settings, load_settings, read_settings, save_settings, settings_path, with_said
from station.core.toml.toml_faults import refused

_NOTHING: Mapping[str, object] = MappingProxyType({})


class SettingsStore:
    """The settings `now`; the file is `path`, None for this user's, and `said` has what this call says by `source`.

    Raises `BadInput` for what is said out of range. `fault` is what was wrong with the file when it was read: what is
    sound in it holds, else the defaults, and the file is not written over.
    """

    def __init__(self, path: Path | None = None, said: Mapping[str, object] = _NOTHING, source: str = "") -> None:
        self._path = path
        self._unwritten: dict[str, object] = {}
        self._is_due = False
        self.fault: StationError | None
        try:
            kept, faults = read_settings(path)
            self.fault = refused(faults) if faults else None
        except StationError as fault:
            kept, self.fault = Settings(), fault
        if self.fault is not None:
            kept = replace(kept, welcomed=True)  # who has a file is no newcomer
        self.now = with_said(kept, said, source)

    def update(self, change: Callable[[Settings], Settings]) -> None:
        """Let `change` say what the settings are from now on; `write` puts what differs into the file."""
        before, self.now = self.now, change(self.now)
        changed = {field.name: getattr(self.now, field.name) for field in fields(Settings)}
        changed = {name: value for name, value in changed.items() if value != getattr(before, name)}
        if changed:
            self._unwritten |= changed
            self._is_due = True

    @property
    def is_due(self) -> bool:
        """Whether something was changed since `write` was called last."""
        return self._is_due

    def write(self) -> Path:
        """Put into the file what was changed, and nothing else; returns where that is. Raises `StationError`.

        What could not be written is tried again with the next change.
        """
        self._is_due = False
        if self._unwritten:
            kept = load_settings(self._path)
            save_settings(replace(kept, **self._unwritten), self._path)  # type: ignore[arg-type] # fields
            self._unwritten = {}
        return self._path or settings_path()
