"""Every panel of the window, in one table: what it is called, where it docks, who draws it.

A panel belongs to what goes on (`shown`), or it is a tool that the user opens from the strip's "Panels". Whoever adds
one writes a module in `panels` and a line here.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path

from imgui_bundle import hello_imgui

from station.app.deeds import Deeds
from station.app.model import Stage
from station.core.settings import load_settings, save_settings
from station.core.units import ns_from_s
from station.gui import theme
from station.gui.panels import (
    calibration_part,
    devices_panel,
    export_panel,
    graph_panel,
    hits_panel,
    practice_panel,
    style_panel,
)
from station.gui.panels.bars_panel import bars_panel
from station.gui.panels.lessons_panel import LessonActions, LessonsPanel
from station.gui.panels.panel import DockSide, Panel, panels_popup
from station.gui.panels.playback_row import PlaybackActions, PlaybackRow
from station.gui.panels.player_controls import PlayerControls
from station.gui.panels.ruler import Ruler
from station.gui.panels.transport_bar import TransportBar, TransportParts
from station.gui.panels.view_popup import ViewActions
from station.gui.view_keys import ViewKeys
from station.gui.viewport import Viewport
from station.practice.session.self_estimate import SelfEstimate

LESSONS, TRANSPORT, BARS, GRAPH = "Lessons", "Transport", "Bars", "Graph"


class Pages:
    """The panels over the model of `deeds`; `settings` keeps what is set in them, None for this user's file."""

    def __init__(self, deeds: Deeds, backdrop: Viewport, settings: Path | None) -> None:
        self._model, self._deeds, self._backdrop = deeds.model, deeds, backdrop
        self.view_keys = ViewKeys(backdrop, deeds.tell)
        model, tried, tell = deeds.model, deeds.tried, deeds.tell
        self._settings, self._course = settings, load_settings(settings).course
        self.take = export_panel.ExportPanel(
            export_panel.ExportActions(
                deeds.to_take, lambda: load_settings(settings), lambda: backdrop.look, tried, tell
            ),
            model.films,
        )
        actions = LessonActions(deeds.start, lambda: tried(model.listen), self.take.film_take, model.room)
        self._lessons = LessonsPanel(deeds.choice, actions)
        self._ear = PlaybackRow(
            PlaybackActions(
                lambda bar, whose: tried(lambda: model.hear_bar(bar, whose)),
                lambda: tried(model.listen),
                lambda: model.room().listening,
            )
        )
        self.hits = hits_panel.HitsPanel(self._ear)
        self.figure = style_panel.StylePanel(model, settings, tried, deeds.preview_anew)
        self.practice = practice_panel.PracticePanel(model.habits, settings, tried)
        measuring = calibration_part.CalibrationPart(model.calibration, model.measure, tried, self._measured)
        self._devices = devices_panel.DevicesPanel(model.desk, tried, tell, measuring)
        self.graph = graph_panel.GraphPanel(self._seek_s)
        self.controls = PlayerControls(deeds.choose_bars)
        self._transport = self._strip()
        self.table = self._table()
        self.docking: hello_imgui.DockingParams | None = None
        """Where they are docked, once the window is made."""

    def _table(self) -> tuple[Panel, ...]:
        """Every panel; those without `shown` are tools that the user opens."""
        beside, right, strip = DockSide.BESIDE, DockSide.RIGHT, DockSide.STRIP
        return (
            Panel(LESSONS, beside, self._lessons.gui, shown=lambda stage: stage is Stage.IDLE),
            Panel(BARS, beside, self._bars_gui, shown=lambda stage: self._deeds.shows_result),
            Panel(hits_panel.HITS, strip, self._hits_gui, hits_panel.ABOUT),
            Panel(style_panel.FIGURE, right, self.figure.gui, style_panel.ABOUT, help=style_panel.HELP),
            Panel(practice_panel.PRACTICE, right, self.practice.gui, practice_panel.ABOUT, help=practice_panel.HELP),
            Panel(devices_panel.DEVICES, right, self._devices_gui, devices_panel.ABOUT, help=devices_panel.HELP),
            Panel(export_panel.TAKE_ALONG, right, self.take.gui, export_panel.ABOUT, help=export_panel.HELP),
            Panel(GRAPH, strip, self._graph_gui, graph_panel.ABOUT, help=graph_panel.HELP),
            Panel(TRANSPORT, DockSide.BELOW, self._transport_gui, shown=lambda stage: True),
        )

    # --- which are open ----------------------------------------------------------------------------------------------

    @property
    def tools(self) -> list[Panel]:
        """Those that the user opens."""
        return [page for page in self.table if page.shown is None]

    def is_open(self, name: str) -> bool:
        """Whether a panel is there."""
        return self._docked(name).is_visible

    def _docked(self, name: str) -> hello_imgui.DockableWindow:
        assert self.docking is not None, "the window has been made"
        return self.docking.dockable_window_of_name(name)

    def show(self, stage: Stage | None) -> None:
        """Show what belongs to `stage`, nothing for None; a tool that nobody sees does not listen."""
        for page in self.table:
            if page.shown is not None:
                self._docked(page.name).is_visible = stage is not None and page.shown(stage)
        self._model.desk.listen(self.is_open(devices_panel.DEVICES))
        if not self.is_open(practice_panel.PRACTICE):
            self._model.habits.learn(on=False)

    def keep(self) -> None:
        """Write to the settings what was set in them."""
        self.figure.keep()
        self.practice.keep()
        followed = self._deeds.choice.course
        course = "" if followed is None else followed.name
        if self._deeds.choice.courses and course != self._course:
            self._course = course
            self._deeds.tried(
                lambda: save_settings(replace(load_settings(self._settings), course=course), self._settings)
            )

    # --- the strip below ---------------------------------------------------------------------------------------------

    def _strip(self) -> TransportBar:
        model, deck, tried = self._model, self._model.deck, self._deeds.tried
        ruler = Ruler(
            seek=lambda at_ns: deck.do(lambda player, now_ns: player.sought(now_ns, at_ns)),
            choose=self._deeds.choose_bars,
            flag=lambda slot: deck.do(lambda player, now_ns: player.at_flag(now_ns, slot)),
        )
        actions: dict[str, Callable[[], None]] = {
            "stop": lambda: tried(model.stop),
            "again": self._deeds.start,
            "pause": model.pause,
            "veto": lambda: tried(model.veto),
            "back": model.dismiss,
            **{guess.value: partial(model.answer, guess) for guess in SelfEstimate},
        }
        viewpoints = ViewActions(self.view_keys.keep, self.view_keys.go)
        return TransportBar(TransportParts(actions, viewpoints, self._open_tools, ruler, self.controls))

    def _transport_gui(self) -> None:
        look = self._transport.gui(self._model.room(), self._model.deck, self._backdrop.look)
        self._backdrop.look_from(look)
        theme.fit_height(self._transport.height)

    def _open_tools(self) -> None:
        assert self.docking is not None, "the window has been made"
        panels_popup(self.tools, self.docking)

    # --- the others --------------------------------------------------------------------------------------------------

    def _bars_gui(self) -> None:
        report = self._model.report()
        bar = None if report is None else bars_panel(report, self._ear)
        if bar is not None:
            self._deeds.drill(bar)

    def _hits_gui(self) -> None:
        self.hits.gui(self._model.report() if self._deeds.shows_result else None)

    def _graph_gui(self) -> None:
        self.graph.gui(self._model.graphed(), can_seek=self._model.room().stage is Stage.IDLE)

    def _seek_s(self, to_s: float) -> None:
        self._model.deck.do(lambda player, now_ns: player.sought(now_ns, ns_from_s(to_s)))

    def _devices_gui(self) -> None:
        self._devices.gui(self._model.room().stage is not Stage.PLAYING)

    def _measured(self, told: str) -> None:
        """Something that was measured is stored: judge by it."""
        self._model.trust_measured()
        self._deeds.tell(told)
