"""The panel that brings music in: a file, a song's folder or a link becomes a lesson of the user's own."""

from collections.abc import Callable
from pathlib import Path
from urllib.parse import unquote, urlsplit

from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.file_actions import CancelImport, Import
from station.app.importer import ImportView, Kept
from station.app.teacher_desk.incoming import KeptParcel
from station.gui import theme
from station.gui.file_chooser import FileChooser, has_file_chooser
from station.gui.widgets.flow_row import FlowRow
from station.music.formats.format_table import FORMATS
from station.practice.exchange.parcel import Kind

IMPORT = "Import"
ABOUT = "A music file, a song's folder, a link or a take becomes a lesson of your own"
HELP = (
    "Drop files on the window, choose them, or type or paste a path or the link of a GrooveScribe groove. What is read"
    " becomes a lesson among your own: swing is named, flams and rolls are found again, patterns are written once. The"
    " page says what was done to the strokes and what the file has that a lesson has no place for. The lesson lies in"
    " the folder lessons beside your sessions, as a text that you can change. A lesson file is kept as it is."
    " Assignments and notes from your teacher come the same way; a teacher takes in returns."
)
SOURCE_LABEL, IMPORT_LABEL, PASTE_LABEL = "##import-source", "Import##import", "Paste##import"
CHOOSE_LABEL, CANCEL_LABEL = "Choose files…##import", "Cancel##import"
_KINDS = (
    "MIDI, MusicXML, Guitar Pro, Hydrogen, GrooveScribe, Clone Hero, DTX, drum tabs, takes, lesson files"
    " and assignments"
)
_HINT = "a file, a folder or a link"
_ENDINGS = (
    *dict.fromkeys(ending for form in FORMATS for ending in form.endings),
    ".capture",
    ".toml",
    *(kind.ending for kind in Kind),
)
_FILE_LINK = "file"
_WIDE = 120.0
"""Design pixels of a button."""


class ImportPanel:
    """Keeps what is typed; what the user does goes to `dispatch`."""

    def __init__(self, dispatch: Callable[[Action], None]) -> None:
        self._dispatch = dispatch
        self.source = ""
        self._chooser = FileChooser("Music to make lessons of", "Music", _ENDINGS) if has_file_chooser() else None

    def gui(self, view: ImportView) -> None:
        """Draw the panel and do what the user does in it."""
        theme.heading("Make a lesson of", 20)
        theme.soft(f"{_KINDS}. Drop them on the window, or:")
        self._ask()
        if view.source:
            self._reading(view)
        elif view.fault:
            imgui.separator()
            theme.warning(view.fault)
        if view.kept is not None:
            imgui.separator()
            _told(view.kept)

    def poll(self) -> None:
        """Import what the system's dialog has brought, whether or not the panel is seen."""
        for path in [] if self._chooser is None else self._chooser.chosen():
            self._dispatch(Import(path))

    def _ask(self) -> None:
        imgui.set_next_item_width(-1)
        flags = imgui.InputTextFlags_.enter_returns_true
        is_entered, self.source = imgui.input_text_with_hint(SOURCE_LABEL, _HINT, self.source, flags)
        theme.tooltip("Type or paste it, then press Enter")
        row = FlowRow()
        if row.button(IMPORT_LABEL, _WIDE) or is_entered:
            self._import()
        theme.tooltip("Read it, keep it among your own lessons, and show it")
        if row.button(PASTE_LABEL, _WIDE):
            self.source = imgui.get_clipboard_text() or ""
            self._import()
        theme.tooltip("The link or path that you have copied elsewhere")
        if self._chooser is not None and row.button(CHOOSE_LABEL, _WIDE):
            self._chooser.ask()

    def _import(self) -> None:
        source = source_of(self.source)
        if source:
            self._dispatch(Import(source))
            self.source = ""

    def _reading(self, view: ImportView) -> None:
        imgui.separator()
        others = f", then {view.waiting} more" if view.waiting else ""
        theme.soft(f"Reading {view.source}{others}…")
        if imgui.button(CANCEL_LABEL):
            self._dispatch(CancelImport())


def source_of(typed: str) -> str:
    """What is meant by a path or a link as people paste it: in quotes, with ~, as a `file:` link."""
    text = typed.strip().strip("\"'")
    if urlsplit(text).scheme == _FILE_LINK:
        text = unquote(urlsplit(text).path)
    return str(Path(text).expanduser()) if text.startswith("~") else text


def _told(kept: Kept) -> None:
    """What was kept last: a lesson with where, what was done and what is lost, a parcel with what it says."""
    theme.heading(kept.title, 20)
    if isinstance(kept, KeptParcel):
        for line in kept.lines:
            _point(line)
        return
    theme.soft(f"{kept.bars} bar{'' if kept.bars == 1 else 's'}, kept in {kept.path}")
    for line in kept.remarks:
        _point(line)
    if kept.lost:
        theme.part("Lost")
    for line in kept.lost:
        _point(line)


def _point(line: str) -> None:
    imgui.bullet()
    imgui.same_line()
    imgui.text_wrapped(line)
