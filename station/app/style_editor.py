"""Who demonstrates, and how: the style that is set, the styles and slots to take, the body; what was set last is kept.

A style of the user's own making that was never saved is kept as the file `latest.toml` (`style_library`).
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import assert_never

from station.app.actions.style_actions import (
    EditStyle,
    KeepSlot,
    ListStyles,
    LoadStyle,
    ProposeStyle,
    SaveStyle,
    StyleAction,
)
from station.app.settings.settings_store import SettingsStore
from station.app.style.style_library import StyleEntry, StyleLibrary
from station.app.style.style_options import StyleOptions
from station.core.errors import StationError
from station.motion.style.proposal import propose_style
from station.motion.style.style import Style
from station.music.score import Score
from station.scenes.demonstrator import Demonstrator, demonstrator_of, figure_for


@dataclass(frozen=True, slots=True)
class StyleView:
    """The `options` that are set, the styles to take (`source` is the one that is taken, None for none), the body.

    `folder` is where styles of the user's own lie.
    """

    options: StyleOptions
    entries: tuple[StyleEntry, ...]
    source: str | None
    figure: str
    folder: Path


class StyleEditor:
    """The style and the body of the settings `store`, from where they are changed; faults at first go to `notify`."""

    def __init__(self, store: SettingsStore, notify: Callable[[str], None]) -> None:
        self._store = store
        self._library = StyleLibrary(store.now.styles_dir)
        self.demonstrator = demonstrator_of(store.now, notify)
        self._options = StyleOptions.of(self.demonstrator.style)
        self._source: str | None = store.now.style
        self.figure = store.now.figure
        """Who is asked to demonstrate: a name or a file, empty for the style's own drummer."""
        self._entries: tuple[StyleEntry, ...] = ()
        self._kept = self.demonstrator.style
        self._is_held = False
        try:
            self._load_slots()
        except StationError as fault:
            notify(str(fault))

    def view(self) -> StyleView:
        """What the figure page shows now."""
        return StyleView(self._options, self._entries, self._source, self.figure, self._library.folder)

    def act(self, action: StyleAction, score: Score) -> None:
        """Do what the user asks; `score` is what a style is proposed for. Raises `StationError`."""
        match action:
            case EditStyle(options, held):
                self._source = self._source if options.base is self._options.base else None
                self._options, self._is_held = options, held
            case LoadStyle(source):
                self._choose(self._library.load(source), source)
            case ProposeStyle():
                self._choose(propose_style(score), None)
            case SaveStyle(name):
                entry = self._library.save(self._options.style, name)
                self._choose(replace(self._options.style, name=entry.label), entry.source)
            case KeepSlot(slot, name):
                self._load_slots()  # a file that cannot be read is reported, and not written over
                self._options = self._options.store(slot, name)
                self._library.keep_slots(self._options.slots)
            case ListStyles():
                self._entries = tuple(self._library.entries())
            case _:
                assert_never(action)
        style, before = self._options.style, self.demonstrator
        if style is not before.style:
            is_same = style.drummer == before.style.drummer
            self.demonstrator = Demonstrator(before.figure if is_same else figure_for(style, self.figure), style)

    def embody(self, figure: str) -> None:
        """Let another drummer demonstrate: a name or a file, empty for the style's own; raises `BadInput`."""
        style = self.demonstrator.style
        self.demonstrator = Demonstrator(figure_for(style, figure), style)
        self.figure = figure

    def keep(self) -> None:
        """Put into the settings what was changed, unless a control is being moved; raises `StationError`."""
        style = self._options.style
        if style is self._kept or self._is_held:
            return
        self._kept = style
        source = self._source
        if source is None or self._options.is_changed:
            source = self._library.keep(style)
        self._store.update(lambda settings: replace(settings, style=source))

    def _choose(self, style: Style, source: str | None) -> None:
        self._options, self._source = self._options.choose(style), source

    def _load_slots(self) -> None:
        self._options = replace(self._options, slots=self._library.slots())
