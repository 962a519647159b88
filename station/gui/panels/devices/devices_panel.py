"""The devices panel: what the kit sends, live, and pad by pad what of it counts, set by looking.

The bars of a pad are its last strokes against its threshold; hollow ones are held back.
"""

from collections.abc import Callable, Iterable

import numpy as np
from imgui_bundle import imgui, implot

from station.app.actions.action import Action
from station.app.actions.equipment_actions import (
    HoldBack,
    RevertRules,
    SaveRules,
    SetMask,
    SetShare,
    SetThreshold,
    ShowKit,
)
from station.app.equipment.latency_lines import latency_lines
from station.app.equipment.mapping_view import STROKES_SHOWN, MappingView, PadStroke
from station.app.room_state import Stage
from station.app.window_state import State
from station.core.events import Choke, Hit, PedalMoved, Switched
from station.core.labels import piece_name
from station.core.pieces import Piece, word
from station.core.short_names import short_paths
from station.core.units import NS_PER_MS
from station.devices.mapping.device_map import DeviceMap
from station.devices.mapping.trigger_filter import HeldBack
from station.devices.monitor import MonitorLine, suspected
from station.gui import theme
from station.gui.panels.devices.calibration_part import CalibrationPart
from station.gui.panels.devices.pads_part import PadsPart
from station.gui.panels.devices.velocity_part import VelocityPart
from station.gui.widgets import plots
from station.render import palette

DEVICES = "Devices"
ABOUT = "The kits that were found, what they send, and what of it counts as a stroke"
HELP = (
    "Strike a pad: a line says what was understood, with the raw bytes, and a bar how hard. Raise a pad's threshold"
    " until bars that you did not play are hollow, and its mask until double triggers are. What looks like crosstalk is"
    " named with a button that holds it back. Learn a pad: choose what it is, hit it once. A pad's name shows how loud"
    " its strokes count; five ghosts and five accents teach that. Changes show here at once; Save keeps them for this"
    " kit, and from then on the station plays and judges by them."
)
SAVE_LABEL = "Save##save-kit"
BACK_LABEL = "As it was##back-kit"
_WHY = {
    HeldBack.TOO_SOFT: "too soft",
    HeldBack.DOUBLE: "double",
    HeldBack.CROSSTALK: "crosstalk",
    HeldBack.FALSE_STOMP: "false stomp",
    HeldBack.GRAB: "a grab",
}
_MOST_THRESHOLD, _MOST_MASK_MS = 60, 60
"""The sliders' ends; our choice, twice what any pad needed that was read of."""
_BAR_LEAST, _BAR_WIDE = 14.0, 0.7
"""Velocities that the softest stroke is high, so that it is seen; a bar's share of its place."""
_LOUDEST = 127
_LIVE_SHARES = (0.38, 0.10, 0.27, 0.25)
"""What each column of the live lines takes of the width."""
_NO_KIT = "No kit is here. Plug it in and switch it on: it is found within a second."
_GIVEN_UP = "Nothing comes from it? `station devices list` and `station doctor` in a terminal say what is there."


class DevicesPanel:
    """The panel; what the user does goes to `dispatch`."""

    def __init__(self, dispatch: Callable[[Action], None]) -> None:
        self._dispatch = dispatch
        self._calibration = CalibrationPart(dispatch)
        self._pads, self._velocity = PadsPart(dispatch), VelocityPart(dispatch)

    def gui(self, state: State) -> None:
        """Draw the panel and do what the user does in it; nothing is learnt or measured while somebody plays."""
        view, may_learn = state.mapping, state.room.stage is not Stage.PLAYING
        if state.calibration.runs:
            theme.heading("How late they are")
            self._calibration.gui(state.calibration, may_learn)
        elif view.kit is None:
            theme.heading(DEVICES)
            imgui.text_wrapped(_NO_KIT)
            theme.soft(_GIVEN_UP)
            self._latency(state, may_learn)
        elif view.learns:
            self._pads.running(view.asks, may_learn)
        else:
            self._kits(view, view.kit)
            imgui.separator_text("What it sends")
            _live(view.lines)
            imgui.separator_text("Pads")
            self._pads.gui(view, may_learn)
            self._table(view, view.kit)
            self._velocity.gui(view, may_learn)
            self._crosstalk(view, view.kit)
            self._keeping(view.is_changed)
            self._latency(state, may_learn)

    def _latency(self, state: State, may_measure: bool) -> None:
        """How late the devices are, as far as was measured, and what measures it."""
        imgui.separator_text("How late they are")
        for line in latency_lines(state.calibration.known, state.mapping.devices):
            imgui.text_wrapped(f"{line.what}: {line.words}")
            theme.soft(line.trust)
        theme.tooltip("Judgement subtracts these; what is not measured has the settings' word")
        self._calibration.gui(state.calibration, may_measure)

    def _kits(self, view: MappingView, kit: DeviceMap) -> None:
        for device in view.devices:
            if imgui.radio_button(f"{short_paths(device)}##kit", view.device == device):
                self._dispatch(ShowKit(device))
            theme.tooltip(f"Show this kit: {device}")
        theme.soft(f"understood as {kit.title}")
        if view.fault:
            imgui.text_wrapped(view.fault)

    def _table(self, view: MappingView, kit: DeviceMap) -> None:
        if not view.pads:
            theme.soft("Strike every pad once: each then has its line here.")
            return
        if theme.is_narrow():
            for piece in view.pads:
                self._pad(view, kit, piece, _below)
            return
        if not imgui.begin_table("##pads", 4, imgui.TableFlags_.sizing_stretch_prop):
            return
        for name, share in (("pad", 0.24), ("last strokes", 0.34), ("threshold", 0.21), ("mask", 0.21)):
            imgui.table_setup_column(name, imgui.TableColumnFlags_.width_stretch, share)
        imgui.table_headers_row()
        for piece in view.pads:
            imgui.table_next_row()
            self._pad(view, kit, piece, _next_cell)
        imgui.end_table()

    def _pad(self, view: MappingView, kit: DeviceMap, piece: Piece, place: Callable[[int], None]) -> None:
        """One pad's four controls; `place` goes to where one of them is, from 0."""
        pad = kit.pad(piece)
        place(0)
        imgui.align_text_to_frame_padding()
        if imgui.selectable(f"{piece_name(piece)}##pad-{word(piece)}", self._velocity.piece is piece)[0]:
            self._velocity.turn(piece)
        theme.tooltip("Show or hide how loud its strokes count")
        place(1)
        _bars(f"##strokes-{word(piece)}", view.strokes.get(piece, ()), pad.threshold)
        theme.tooltip("The last strokes, the newest on the right, and the threshold; hollow ones are held back")
        place(2)
        moved, threshold = theme.slider_int(f"##threshold-{word(piece)}", pad.threshold, 1, _MOST_THRESHOLD)
        if moved:
            self._dispatch(SetThreshold(piece, min(max(threshold, 1), _LOUDEST)))
        theme.tooltip(f"{piece_name(piece)}: softer than this velocity is no stroke")
        place(3)
        moved, mask = theme.slider_int(f"##mask-{word(piece)}", pad.mask_ns // NS_PER_MS, 0, _MOST_MASK_MS, "%d ms")
        if moved:
            self._dispatch(SetMask(piece, min(max(mask, 0), _MOST_MASK_MS)))
        theme.tooltip(f"{piece_name(piece)}: for so long after a stroke there is no other; 0 lets every one pass")

    def _crosstalk(self, view: MappingView, kit: DeviceMap) -> None:
        rules, suspicions = kit.crosstalk, view.suspicions
        if rules or suspicions:
            imgui.separator_text("Crosstalk")
        for rule in rules:
            pair = f"{word(rule.source)}-{word(rule.victim)}"
            imgui.set_next_item_width(theme.points(110))
            moved, percent = theme.slider_int(f"##share-{pair}", round(100 * rule.share), 0, 100, "%d %%")
            if moved:
                self._dispatch(SetShare(rule.source, rule.victim, min(max(percent, 0), 100) / 100))
            theme.tooltip("Up to so loud, beside its cause, it is a ghost; 0 takes the rule away")
            imgui.same_line()
            imgui.text_wrapped(f"{piece_name(rule.source)} makes {piece_name(rule.victim)} send")
        for index, suspicion in enumerate(reversed(suspicions)):
            if imgui.button(f"Hold back##suspicion{index}"):
                self._dispatch(HoldBack(suspicion))
            theme.tooltip("Take hits such as this one for no strokes")
            imgui.same_line()
            imgui.text_wrapped(suspected(suspicion))

    def _keeping(self, is_changed: bool) -> None:
        imgui.spacing()
        imgui.begin_disabled(not is_changed)
        if imgui.button(SAVE_LABEL, imgui.ImVec2(theme.points(110), 0)):
            self._dispatch(SaveRules())
        theme.tooltip("Keep these rules for this kit: from now on the station plays and judges by them")
        imgui.same_line()
        if imgui.button(BACK_LABEL, imgui.ImVec2(theme.points(110), 0)):
            self._dispatch(RevertRules())
        theme.tooltip("The rules as they were kept last")
        imgui.end_disabled()


def _next_cell(index: int) -> None:
    """The next control stands in the next column of the table."""
    del index
    imgui.table_next_column()
    imgui.set_next_item_width(-1)


def _below(index: int) -> None:
    """The next control stands below the last one, and the fourth beside the third."""
    if index == 3:
        imgui.same_line()
    half = (imgui.get_content_region_avail().x - imgui.get_style().item_spacing.x) / 2
    imgui.set_next_item_width(half if index == 2 else -1)


def _live(lines: Iterable[MonitorLine]) -> None:
    """The last lines, the newest first."""
    shown = list(lines)[::-1]
    if not shown:
        theme.soft("Strike a pad.")
        return
    if theme.is_narrow():
        for line in shown:
            words = ", ".join(filter(None, cells(line)))
            theme.soft(words) if _is_quiet(line) else imgui.text_wrapped(words)
        return
    if imgui.begin_table("##live", len(_LIVE_SHARES), imgui.TableFlags_.sizing_stretch_prop):
        for index, share in enumerate(_LIVE_SHARES):
            imgui.table_setup_column(f"live{index}", imgui.TableColumnFlags_.width_stretch, share)
        for line in shown:
            imgui.table_next_row()
            for text in cells(line):
                imgui.table_next_column()
                theme.soft(text) if _is_quiet(line) else imgui.text_wrapped(text)
        imgui.end_table()


def _is_quiet(line: MonitorLine) -> bool:
    """Whether it is no stroke and nothing else that the station plays by."""
    return line.false_trigger is not None or line.event is None


def cells(line: MonitorLine) -> tuple[str, str, str, str]:
    """A line in four cells: piece and zone; velocity; openness, position or why it is no stroke; raw bytes."""
    event = line.false_trigger.hit if line.false_trigger is not None else line.event
    match event:
        case Hit():
            notes = [_WHY[line.false_trigger.why]] if line.false_trigger is not None else []
            notes += [] if event.openness is None else [f"open {event.openness:.2f}"]
            notes += [] if event.position is None else [f"at {event.position:.2f}"]
            return f"{piece_name(event.piece)}, {word(event.zone)}", str(event.velocity), ", ".join(notes), line.raw
        case Choke():
            return f"{piece_name(event.piece)} choked", "", "", line.raw
        case PedalMoved():
            return "hi-hat pedal", "", f"open {event.openness:.2f}", line.raw
        case Switched():
            return "switch", "", event.switch, line.raw
        case None:
            return "no event", "", "", line.raw
        case _:
            return f"{short_paths(event.device)} is here", "", "", line.raw


def _bars(label: str, strokes: Iterable[PadStroke], threshold: int) -> None:
    """The strokes as bars, the newest on the right, hollow where they do not count, and the threshold across."""
    shown = list(strokes)
    newest = STROKES_SHOWN - np.arange(len(shown), 0.0, -1.0)
    loud = np.array([max(stroke.velocity, _BAR_LEAST) for stroke in shown], np.float64)
    counts = np.array([stroke.why is None for stroke in shown], np.bool_)
    if implot.begin_plot(label, imgui.ImVec2(-1, imgui.get_frame_height()), plots.SEEN):
        plots.fixed(implot.ImAxis_.x1, -0.5, STROKES_SHOWN - 0.5, plots.BARE)
        plots.fixed(implot.ImAxis_.y1, 0, _LOUDEST, plots.BARE)
        implot.plot_bars("##count", newest[counts], loud[counts], _BAR_WIDE, plots.spec(palette.GOOD))
        hollow = plots.spec(palette.MISSED)
        hollow.fill_alpha = 0.0
        implot.plot_bars("##ignored", newest[~counts], loud[~counts], _BAR_WIDE, hollow)
        plots.across("##threshold", [threshold], plots.spec(palette.BRAND, 1.5))
        implot.end_plot()
