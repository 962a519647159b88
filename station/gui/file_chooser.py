"""The system's own dialog that chooses files, in a process of its own: it is asked each frame and never waited for.

On Linux portable-file-dialogs calls one of four programs; where none is installed there is no dialog.
"""

import shutil
import sys

from imgui_bundle import portable_file_dialogs as dialogs

_PROGRAMS = ("zenity", "matedialog", "qarma", "kdialog")
"""Those that portable-file-dialogs looks for (its README, "Linux")."""


def has_file_chooser() -> bool:
    """Whether the system has such a dialog."""
    return sys.platform in ("win32", "darwin") or any(map(shutil.which, _PROGRAMS))


class FileChooser:
    """One dialog at a time, which offers files that end in one of `endings`."""

    def __init__(self, title: str, kinds: str, endings: tuple[str, ...]) -> None:
        patterns = " ".join(f"*{ending}" for ending in endings)
        self._title, self._filters = title, [kinds, patterns, "All files", "*"]
        self._open: dialogs.open_file | None = None

    def ask(self) -> None:
        """Open the dialog, if it is not open."""
        if self._open is None:
            self._open = dialogs.open_file(self._title, "", self._filters, dialogs.opt.multiselect)

    def chosen(self) -> list[str]:
        """The files that were chosen since it was last asked."""
        if self._open is None or not self._open.ready(0):
            return []
        asked, self._open = self._open, None
        return list(asked.result())


class FolderChooser:
    """The same for a folder."""

    def __init__(self, title: str) -> None:
        self._title = title
        self._open: dialogs.select_folder | None = None

    def ask(self) -> None:
        """Open the dialog, if it is not open."""
        if self._open is None:
            self._open = dialogs.select_folder(self._title, "")

    def chosen(self) -> str:
        """The folder that was chosen since it was last asked, empty for none."""
        if self._open is None or not self._open.ready(0):
            return ""
        asked, self._open = self._open, None
        return str(asked.result())
