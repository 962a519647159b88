"""Where a file goes: a line to type its place, the system's dialog where there is one, the button that writes it."""

from pathlib import Path

from imgui_bundle import imgui
from imgui_bundle import portable_file_dialogs as dialogs

from station.gui import theme
from station.gui.file_chooser import has_file_chooser
from station.gui.widgets.flow_row import FlowRow
from station.practice.exchange.parcel import Kind

_WRITE, _CHOOSE = 190.0, 100.0
"""Design pixels of the buttons; the one that writes fills its row."""


class SaveRow:
    """A file of that `kind` is written by the button `label`; `title` is the dialog's. `path` is where it goes."""

    def __init__(self, title: str, kind: Kind, label: str) -> None:
        self._title, self._kind, self._label = title, kind, label
        self._asked: dialogs.save_file | None = None
        self._has_dialog = has_file_chooser()
        self.path = ""

    @property
    def path_label(self) -> str:
        """The label of the line."""
        return f"##path-{self._label}"

    def propose(self, path: str) -> None:
        """Where it goes unless something else is said."""
        self.path = path

    def poll(self) -> None:
        """Take what the system's dialog has brought."""
        if self._asked is not None and self._asked.ready(0):
            asked, self._asked = self._asked, None
            self.path = asked.result() or self.path

    def gui(self) -> bool:
        """Draw it; whether the file is to be written."""
        imgui.set_next_item_width(-1)
        hint, flags = f"a file {self._kind.ending}", imgui.InputTextFlags_.elide_left
        _, self.path = imgui.input_text_with_hint(self.path_label, hint, self.path, flags)
        theme.tooltip(f"{self._title}: {self.path}")
        row = FlowRow()
        if self._has_dialog and row.button(f"Choose…{self.path_label}", _CHOOSE) and self._asked is None:
            filters = [f"*{self._kind.ending}", f"*{self._kind.ending}"]
            self._asked = dialogs.save_file(self._title, str(Path(self.path).expanduser()), filters)
        row.place(theme.points(_WRITE))
        return bool(theme.main_button(self._label, (-1, theme.points(38.0))))
