"""The part of the devices panel that measures how late devices are: what to do, what was found, whether to keep it."""

from collections.abc import Callable, Sequence

from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.equipment_actions import CancelMeasuring, ForgetMeasured, KeepMeasured, Measure
from station.app.equipment.calibration import CalibrationView
from station.core.measured_latency import LOOPBACK, REPORT, STRIKE, TAP
from station.gui import theme
from station.gui.widgets.flow_row import FlowRow

MEASURE_LABEL, CANCEL_LABEL = "Measure##calibrate", "Cancel##calibrate"
KEEP_LABEL, ANYWAY_LABEL = "Subtract it##keep", "Subtract it anyway##keep"
DROP_LABEL = "Forget it##drop"
_WAYS = {
    REPORT: ("Driver's word", "What the sound output reports, and how its clock runs: ten seconds, nothing to do"),
    LOOPBACK: ("Loopback", "A cable or a microphone from the output to the input: chirps are played and recorded"),
    STRIKE: ("Strike", "A microphone at the kit: strike each pad ten times; how late the kit stamps a stroke"),
    TAP: ("Tap", "Strike one pad with each of 36 clicks: devices and habit together; where there is no cable"),
}
_MOST_DISTANCE_M = 3.0
_LEAST_DISTANCE_WIDTH = 160.0


class CalibrationPart:
    """Draws it; what the user does goes to `dispatch`."""

    def __init__(self, dispatch: Callable[[Action], None]) -> None:
        self._dispatch = dispatch
        self._by = REPORT
        self._distance_m = 0.0

    def gui(self, view: CalibrationView, may_measure: bool) -> None:
        """Draw it; while somebody plays nothing can be measured."""
        if view.runs:
            self._running(view.lines)
            return
        self._ways()
        imgui.begin_disabled(not may_measure)
        if imgui.button(MEASURE_LABEL, imgui.ImVec2(theme.points(110), 0)):
            self._dispatch(Measure(self._by, self._distance_m))
        imgui.end_disabled()
        theme.tooltip(f"{_WAYS[self._by][1]}. The engine rests meanwhile; nothing is kept unless you say so")
        if view.fault:
            imgui.text_wrapped(view.fault)
        if view.found:
            self._found(view)

    def _ways(self) -> None:
        row = FlowRow()
        for by, (name, words) in _WAYS.items():
            row.place(imgui.get_frame_height() + imgui.get_style().item_inner_spacing.x + imgui.calc_text_size(name).x)
            if imgui.radio_button(f"{name}##by", self._by == by):
                self._by = by
            theme.tooltip(words)
        theme.soft(_WAYS[self._by][1] + ".")
        if self._by == STRIKE:
            imgui.set_next_item_width(theme.points(_LEAST_DISTANCE_WIDTH))
            _, metres = theme.slider_float("##distance", self._distance_m, 0.0, _MOST_DISTANCE_M, "microphone %.1f m")
            self._distance_m = min(max(metres, 0.0), _MOST_DISTANCE_M)
            theme.tooltip("From the pads to the microphone: sound takes 2.9 ms a metre")

    def _running(self, lines: Sequence[str]) -> None:
        """The lines of the measurement, the newest one large."""
        lines = lines or ["getting ready"]
        for line in lines[:-1]:
            theme.soft(line)
        theme.heading(lines[-1], 20)
        if imgui.button(CANCEL_LABEL, imgui.ImVec2(theme.points(110), 0)):
            self._dispatch(CancelMeasuring())
        theme.tooltip("End the measurement; nothing is kept")

    def _found(self, view: CalibrationView) -> None:
        for line in view.found:
            imgui.text_wrapped(line)
        row = FlowRow()
        if view.is_worth:
            if row.button(*((KEEP_LABEL, 110) if view.trusted else (ANYWAY_LABEL, 144))):
                self._dispatch(KeepMeasured())
            theme.tooltip("Judgement subtracts it from now on, in place of what it knew of these devices")
        if row.button(DROP_LABEL, 96):
            self._dispatch(ForgetMeasured())
        theme.tooltip("Nothing is kept")
