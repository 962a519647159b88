"""The styles that a user can take: those that ship with the station, and those in a folder of the user's own.

The folder holds a style file for each style that was saved, `slots.toml` with the eight slots, and `latest.toml`: what
was set last and never saved under a name. All but the slots are files that `station animate --style` reads.
"""

from dataclasses import dataclass
from pathlib import Path

from station.core.errors import BadInput
from station.motion.style.style import Style
from station.motion.style.style_file import Slots, load_style, save_style, style_names

_SLOTS, _LATEST = "slots", "latest"
_NOT_IN_NAMES = '/\\:*?"<>|'
"""What some system's file names cannot hold."""


@dataclass(frozen=True, slots=True)
class StyleEntry:
    """A style in the list: its `label`, and `source`, the shipped name or the file that it is loaded from."""

    label: str
    source: str
    is_own: bool


@dataclass(frozen=True, slots=True)
class StyleLibrary:
    """The styles that there are; `folder` is the user's, made when something is first put there."""

    folder: Path

    def entries(self) -> list[StyleEntry]:
        """Shipped styles by name, then the user's."""
        own = sorted(path for path in self.folder.glob("*.toml") if path.stem != _SLOTS)
        return [
            *(StyleEntry(name, name, is_own=False) for name in style_names()),
            *(StyleEntry(path.stem, str(path), is_own=True) for path in own),
        ]

    def load(self, source: str) -> Style:
        """The style of an entry's source; raises `BadInput` with the place of the first fault."""
        return load_style(source)

    def save(self, style: Style, name: str) -> StyleEntry:
        """Put `style` into the user's folder; raises `BadInput` for what is no name, `DeviceError` from the disk."""
        name = name.strip()
        if not name or name.startswith(".") or set(name) & set(_NOT_IN_NAMES) or name in (_SLOTS, _LATEST):
            raise BadInput(name or "style", "", f"expected a name for a file, other than {_SLOTS} and {_LATEST}")
        path = self.folder / f"{name}.toml"
        save_style(style, path)
        return StyleEntry(name, str(path), is_own=True)

    def keep(self, style: Style) -> str:
        """Put what was never saved into `latest.toml`; returns its source. Raises `DeviceError` from the disk."""
        save_style(style, self._latest)
        return str(self._latest)

    def slots(self) -> Slots:
        """The eight slots; raises `BadInput` with the place of the first fault."""
        return Slots.load(self._slots)

    def keep_slots(self, slots: Slots) -> None:
        """Write the eight slots; raises `DeviceError` from the disk."""
        slots.save(self._slots)

    @property
    def _latest(self) -> Path:
        return self.folder / f"{_LATEST}.toml"

    @property
    def _slots(self) -> Path:
        return self.folder / f"{_SLOTS}.toml"
