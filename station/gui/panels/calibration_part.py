"""The part of the devices panel that measures how late devices are: what to do, what was found, whether to keep it."""

from collections.abc import Callable
from typing import TYPE_CHECKING

from imgui_bundle import imgui

from station.app.calibration import Calibration
from station.core.measured_latency import LOOPBACK, REPORT, STRIKE, TAP, load_calibration
from station.gui import theme
from station.gui.widgets.flow_row import FlowRow

if TYPE_CHECKING:
    from station.app.calibration_results import CalibrationResults

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
    """It draws over one desk; `measure` begins a way at a distance, `kept` hears that something is now subtracted."""

    def __init__(
        self,
        desk: Calibration,
        measure: Callable[[str, float], None],
        tried: Callable[[Callable[[], object]], None],
        kept: Callable[[str], None],
    ) -> None:
        self._desk, self._measure, self._tried, self._kept = desk, measure, tried, kept
        self._by = REPORT
        self._distance_m = 0.0
        self._changed = False
        self._worded: CalibrationResults | None = None
        self._words: list[str] = []

    @property
    def runs(self) -> bool:
        """Whether something is being measured."""
        return self._desk.runs

    def has_changed(self) -> bool:
        """Whether something was kept since the last call."""
        changed, self._changed = self._changed, False
        return changed

    def gui(self, may_measure: bool) -> None:
        """Draw it; while somebody plays nothing can be measured."""
        desk = self._desk
        if desk.runs:
            self._running()
            return
        self._ways()
        imgui.begin_disabled(not may_measure)
        if imgui.button(MEASURE_LABEL, imgui.ImVec2(theme.points(110), 0)):
            self._tried(lambda: self._measure(self._by, self._distance_m))
        imgui.end_disabled()
        theme.tooltip(f"{_WAYS[self._by][1]}. The engine rests meanwhile; nothing is kept unless you say so")
        if desk.fault:
            imgui.text_wrapped(desk.fault)
        if desk.findings is not None:
            self._found()

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

    def _running(self) -> None:
        """What is told meanwhile, the newest line large."""
        lines = self._desk.lines or ["getting ready"]
        for line in lines[:-1]:
            theme.soft(line)
        theme.heading(lines[-1], 20)
        if imgui.button(CANCEL_LABEL, imgui.ImVec2(theme.points(110), 0)):
            self._tried(self._desk.cancel)
        theme.tooltip("End the measurement; nothing is kept")

    def _found(self) -> None:
        desk = self._desk
        if desk.findings is not self._worded:  # once: what is known of the devices is read from a file
            self._worded, self._words = desk.findings, []
            self._tried(self._put_into_words)
        for line in self._words:
            imgui.text_wrapped(line)
        row = FlowRow()
        if desk.worth:
            if row.button(*((KEEP_LABEL, 110) if desk.trusted else (ANYWAY_LABEL, 144))):
                self._tried(self._keep)
            theme.tooltip("Judgement subtracts it from now on, in place of what it knew of these devices")
        if row.button(DROP_LABEL, 96):
            desk.drop()
        theme.tooltip("Nothing is kept")

    def _put_into_words(self) -> None:
        from station.app.calibration_results import text

        if self._worded is not None:
            self._words = [line.strip() for line in text(self._worded, load_calibration()).splitlines()]

    def _keep(self) -> None:
        self._kept(self._desk.keep())
        self._changed = True
