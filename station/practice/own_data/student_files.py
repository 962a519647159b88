"""The files in a student's folder: what lies there, never what a link leads to."""

import os
import stat
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path


@dataclass(slots=True)
class FolderFiles:
    """The plain files of a folder, by their paths; `others` are its links and what else is no file, which stay shut."""

    plain: list[Path] = field(default_factory=list)
    others: list[Path] = field(default_factory=list)

    @classmethod
    def of(cls, folder: Path) -> "FolderFiles":
        """All that lies under `folder`, in order; nothing where there is none. Raises `OSError`."""
        found = cls()
        if folder.is_dir():
            for path, mode in _below(folder):
                (found.plain if stat.S_ISREG(mode) else found.others).append(path)
        return found

    @property
    def count(self) -> int:
        """How many there are."""
        return len(self.plain) + len(self.others)


def _below(folder: Path) -> Iterator[tuple[Path, int]]:
    with os.scandir(folder) as entries:
        inside = sorted(entries, key=lambda entry: entry.name)
    for entry in inside:
        mode = entry.stat(follow_symlinks=False).st_mode
        if stat.S_ISDIR(mode):
            yield from _below(Path(entry.path))
        else:
            yield Path(entry.path), mode
