"""The phase panel: a recorded motion, its phase and E max as plots, a body that walks, drums at thresholds."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
from imgui_bundle import imgui, implot

from station.app.actions.action import Action
from station.app.actions.phase_actions import ChooseTriggers, OpenMotion, PlayMotion, SeekMotion
from station.app.phase_page import PhaseView
from station.gui import theme
from station.gui.widgets import plots
from station.gui.widgets.flow_row import FlowRow
from station.gui.widgets.walker_drawing import draw_body
from station.render import palette
from station.render.phase.phase_plot import LIMB_COLOURS, PLAIN, QUALITY_RANGE, PhaseTrace
from station.sync.sonification.trigger_table import PRESETS

PHASE = "Phase"
ABOUT = "A recorded motion, where in its cycle it is, and drums that its phase triggers"
HELP = (
    "Open a motion (.amc with its .asf, or .bvh) and a model of it: a file of 'station sync fit', or another motion,"
    " whose first cycle is then the model. The upper plot shows where in its cycle the motion is, the lower one how"
    " well it fits the model. Lines are thresholds: each time the phase passes one, its drum sounds and the foot lights"
    " up. Triangles show where the heel came down. Drag the line to go elsewhere."
)
OPEN_LABEL, PLAY_LABEL, STOP_LABEL = "Open##phase", "Play##phase", "Stop##phase"
MODEL_LABEL, MOTION_LABEL = "##phase-model", "##phase-motion"
PHASE_PLOT, QUALITY_PLOT = "##phase-plot", "##quality-plot"
_PATH_WIDTH, _LEAST, _BODY = 190.0, 130.0, 0.75
"""Design pixels of a path and of the least height of the plots; the body's width as a share of its height."""
_QUALITY_SHARE = 0.36
_PHASES = ([0.0, 0.5, 1.0], ["−π", "0", "π"])
_QUALITIES, _NAME = ([-1.0, 0.0, 1.0], ["−1", "E max", "1"]), ([0.0], ["E max"])
"""The lower axis, and where it has no room for numbers."""
_QUALITY_AXIS = (QUALITY_RANGE[0] - 0.3, QUALITY_RANGE[1] + 0.3)
"""Beyond the range: a good match lies along its end, where half of the line, or all of it, would be cut off."""
_TIP = "Drag the orange line to go there. Wheel: nearer"


class PhasePanel:
    """Keeps the paths that are typed; what the user does goes to `dispatch`."""

    def __init__(self, dispatch: Callable[[Action], None]) -> None:
        self._dispatch = dispatch
        self.model = self.motion = ""
        self._drawn: PhaseTrace | None = None
        self._curves: tuple[np.ndarray, np.ndarray] = np.empty(0), np.empty(0)

    def gui(self, view: PhaseView, can_play: bool) -> None:
        """Draw the panel and do what the user does in it."""
        row = FlowRow()
        self._files(view, row)
        if view.is_reading:
            theme.soft("Reading…")
            return
        if view.scene is None:
            theme.soft("A motion's phase stands here, with the body that moves and the drums that it triggers.")
            return
        self._controls(view, can_play, row)
        room = imgui.get_content_region_avail()
        high = max(room.y, theme.points(_LEAST))
        draw_body(view.scene, view.at_s, (_BODY * high, high))
        imgui.same_line()
        self._plots(view, view.scene.trace, high)

    def _files(self, view: PhaseView, row: FlowRow) -> None:
        for label, hint, name in ((MOTION_LABEL, "motion: .amc, .bvh", "motion"), (MODEL_LABEL, "model", "model")):
            row.place(theme.points(_PATH_WIDTH))
            imgui.set_next_item_width(theme.points(_PATH_WIDTH))
            _, typed = imgui.input_text_with_hint(label, hint, getattr(self, name))
            setattr(self, name, typed)
        row.place(theme.points(80))
        imgui.begin_disabled(not (self.model and self.motion) or view.is_reading)
        if imgui.button(OPEN_LABEL):
            self._dispatch(OpenMotion(Path(self.model).expanduser(), Path(self.motion).expanduser()))
        imgui.end_disabled()
        theme.tooltip("Track the motion by the model; a motion as its own model is the plainest test")

    def _controls(self, view: PhaseView, can_play: bool, row: FlowRow) -> None:
        row.place(theme.points(80))
        imgui.begin_disabled(not can_play)
        if imgui.button(STOP_LABEL if view.plays else PLAY_LABEL):
            self._dispatch(PlayMotion(not view.plays))
        imgui.end_disabled()
        for preset in PRESETS:
            row.place(imgui.calc_text_size(preset).x + theme.points(40))
            if imgui.radio_button(f"{preset}##triggers", view.preset == preset) and view.preset != preset:
                self._dispatch(ChooseTriggers(preset))
            theme.tooltip("Where the right foot's kick and the left foot's snare sound in the cycle")
        text = f"{view.motion} by {view.model}"
        row.place(imgui.calc_text_size(text).x)
        theme.soft(text)

    # --- the plots ----------------------------------------------------------------------------------------------------

    def _plots(self, view: PhaseView, trace: PhaseTrace, high: float) -> None:
        if trace is not self._drawn:
            self._drawn, self._curves = trace, _broken(trace)
        gap = imgui.get_style().item_spacing.y
        low = _QUALITY_SHARE * (high - gap)
        imgui.begin_group()
        if implot.begin_aligned_plots("##phases"):
            if implot.begin_plot(PHASE_PLOT, imgui.ImVec2(-1, high - gap - low), plots.FIXED):
                _axes(trace, (0.0, 1.0), bare=True)
                implot.setup_axis_ticks(implot.ImAxis_.y1, *_PHASES)
                self._phase(trace)
                self._line(view)
                implot.end_plot()
            theme.tooltip(_TIP)
            if implot.begin_plot(QUALITY_PLOT, imgui.ImVec2(-1, low), plots.FIXED):
                _axes(trace, _QUALITY_AXIS, bare=False)
                implot.setup_axis_ticks(implot.ImAxis_.y1, *(_QUALITIES if low > theme.points(_LEAST) / 2 else _NAME))
                self._quality(trace)
                self._line(view)
                implot.end_plot()
            implot.end_aligned_plots()
        imgui.end_group()

    def _phase(self, trace: PhaseTrace) -> None:
        locked, all_of_it = self._curves
        for share, limb in trace.thresholds:
            colour = palette.with_opacity(LIMB_COLOURS.get(limb, PLAIN), 0.5)
            plots.across(f"##threshold-{limb.name}", [share], plots.spec(colour, 1.2))
        implot.plot_line("##phase", trace.time_s, all_of_it, plots.spec(palette.with_opacity(palette.GOOD, 0.5), 1.5))
        implot.plot_line("##locked", trace.time_s, locked, plots.spec(palette.GOOD, 2.0))
        for limb in dict.fromkeys(mark.limb for mark in trace.marks):
            colour = LIMB_COLOURS.get(limb, PLAIN)
            sounds = [(mark.at_s, mark.share) for mark in trace.marks if mark.limb is limb and mark.share is not None]
            feet = [(mark.at_s, 0.03) for mark in trace.marks if mark.limb is limb and mark.share is None]
            for name, places, marker in (("sound", sounds, implot.Marker_.circle), ("foot", feet, implot.Marker_.up)):
                if places:
                    x, y = (np.array(column, np.float64) for column in zip(*places, strict=True))
                    implot.plot_scatter(f"##{name}-{limb.name}", x, y, plots.spec(colour, 1.0, 4.5, marker))

    def _quality(self, trace: PhaseTrace) -> None:
        quality = np.clip(trace.quality, *QUALITY_RANGE)
        implot.plot_line("##quality", trace.time_s, quality, plots.spec(palette.GOOD, 1.5))

    def _line(self, view: PhaseView) -> None:
        moved, to_s, *_ = implot.drag_line_x(0, view.at_s, plots.vec(palette.BRAND), theme.points(2.0))
        if moved:
            self._dispatch(SeekMotion(to_s))


def _axes(trace: PhaseTrace, high: tuple[float, float], bare: bool) -> None:
    plots.fixed(implot.ImAxis_.x1, *trace.span_s, implot.AxisFlags_.no_tick_labels if bare else 0)
    plots.fixed(implot.ImAxis_.y1, *high)


def _broken(trace: PhaseTrace) -> tuple[np.ndarray, np.ndarray]:
    """The phase where it is locked, and all of it; NaN breaks the line where it wraps or is not meant."""
    whole = trace.share.copy()
    whole[1:][np.abs(np.diff(trace.share)) > 0.5] = np.nan
    return np.where(trace.sure, whole, np.nan), whole
