"""The part of the devices panel that sets how loud a pad's strokes count: its curve, with the last strokes on it.

Right is how hard the pad says it was struck, up what that counts as; both 1 to 127.
"""

from collections.abc import Callable, Iterable

import numpy as np
from imgui_bundle import imgui, implot

from station.app.actions.action import Action
from station.app.actions.equipment_actions import LearnVelocity, SetCurve
from station.app.equipment.mapping_view import MappingView, PadStroke
from station.core.labels import piece_name
from station.core.pieces import Piece, word
from station.devices.mapping.device_map import Pad
from station.devices.mapping.velocity_curve import (
    ACCENT_COUNTS,
    GHOST_COUNTS,
    HARDEST,
    LEAST_SPAN,
    MOST_BEND,
    SHAPES,
    VelocityCurve,
)
from station.gui import theme
from station.gui.widgets import plots
from station.gui.widgets.flow_row import FlowRow
from station.render import palette

LEARN_LABEL = "Learn ghosts and accents##touch"
_HIGH, _MOST_WIDE = 150.0, 300.0
_DOT, _LINE = 4.0, 2.0
_MOST_SOFTEST, _MOST_LOUDEST = 60, 200
"""The sliders' ends; our choice: what a file may say lies further out."""
_HELP = {
    "as_sent": "Strokes count as the pad sends them",
    "light": "Soft strokes count for more: for a light touch, or a pad that answers late",
    "very_light": "Soft strokes count for much more",
    "firm": "Soft strokes count for less: for a heavy touch, or a pad that is soon at its loudest",
    "very_firm": "Soft strokes count for much less",
}


class VelocityPart:
    """`piece` is the pad that is shown, None for none; what the user does goes to `dispatch`."""

    def __init__(self, dispatch: Callable[[Action], None]) -> None:
        self._dispatch = dispatch
        self.piece: Piece | None = None
        self._is_new = False

    def turn(self, piece: Piece) -> None:
        """Show a pad, or hide it where it is shown."""
        self._is_new = self.piece is not piece
        self.piece = piece if self._is_new else None

    def gui(self, view: MappingView, may_learn: bool) -> None:
        """Draw the pad that is shown and do what the user does with it; its strokes teach while nobody plays."""
        if self.piece not in view.pads or view.kit is None:
            if view.pads:
                theme.soft("A pad's name opens how loud its strokes count.")
            return
        piece, pad = self.piece, view.kit.pad(self.piece)
        imgui.separator_text(f"How loud it counts: {piece_name(piece)}")
        if self._is_new:
            imgui.set_scroll_here_y(0.0)
            self._is_new = False
        _plot(pad, view.strokes.get(piece, ()))
        theme.tooltip(
            "Right: how hard the pad says it was struck; up: what that counts as. The dots are your last strokes"
        )
        curve = self._shapes(pad.curve)
        curve = _numbers(piece, curve)
        if curve != pad.curve:
            self._dispatch(SetCurve(piece, curve))
        imgui.begin_disabled(not may_learn)
        if imgui.button(LEARN_LABEL, imgui.ImVec2(-1, theme.points(38))):
            self._dispatch(LearnVelocity(piece))
        imgui.end_disabled()
        theme.tooltip("Play five ghost strokes, then five accents: they will count as lessons write them; kept at once")

    @staticmethod
    def _shapes(curve: VelocityCurve) -> VelocityCurve:
        row = FlowRow()
        for name, shape in SHAPES.items():
            label = name.replace("_", " ")
            row.place(imgui.get_frame_height() + imgui.get_style().item_inner_spacing.x + imgui.calc_text_size(label).x)
            if imgui.radio_button(f"{label}##shape", curve == shape):
                curve = shape
            theme.tooltip(_HELP[name])
        return curve


def _numbers(piece: Piece, curve: VelocityCurve) -> VelocityCurve:
    """The curve by its three numbers."""
    name = word(piece)
    imgui.set_next_item_width(-1)
    moved, bend = theme.slider_float(f"##bend-{name}", curve.bend, -MOST_BEND, MOST_BEND, "bend %.2f")
    theme.tooltip("Below 0 soft strokes count for less, above 0 for more")
    half = (imgui.get_content_region_avail().x - imgui.get_style().item_spacing.x) / 2
    imgui.set_next_item_width(half)
    begun, softest = theme.slider_int(f"##softest-{name}", round(curve.softest), 1, _MOST_SOFTEST, "softest %d")
    theme.tooltip("What the pad sends up to here counts as 1")
    imgui.same_line()
    imgui.set_next_item_width(half)
    least = round(_MOST_SOFTEST + LEAST_SPAN)
    ended, loudest = theme.slider_int(f"##loudest-{name}", round(curve.loudest), least, _MOST_LOUDEST, "loudest %d")
    theme.tooltip("What the pad sends from here on counts as 127; beyond 127 its hardest stroke counts for less")
    if not (moved or begun or ended):
        return curve  # the sliders round what a file may say to the finest
    return VelocityCurve.nearest(
        float(softest) if begun else curve.softest,
        float(loudest) if ended else curve.loudest,
        bend if moved else curve.bend,
    )


def _plot(pad: Pad, strokes: Iterable[PadStroke]) -> None:
    """The curve, what ghosts and accents count as, the threshold, and the strokes as dots, the newest the brightest."""
    wide = min(imgui.get_content_region_avail().x, theme.points(_MOST_WIDE))
    if not implot.begin_plot("##touch", imgui.ImVec2(wide, theme.points(_HIGH)), plots.SEEN):
        return
    plots.fixed(implot.ImAxis_.x1, 0, HARDEST, plots.BARE)
    plots.fixed(implot.ImAxis_.y1, 0, HARDEST)
    implot.setup_axis_ticks(implot.ImAxis_.y1, [*map(float, (GHOST_COUNTS, ACCENT_COUNTS))], ["ghost", "accent"])
    threshold = np.array([pad.threshold], np.float64)
    implot.plot_inf_lines("##threshold", threshold, plots.spec(palette.with_opacity(palette.BRAND, 0.5), 1.5))
    table, shown = np.array(pad.curve.table, np.float64), list(strokes)
    implot.plot_line("##curve", np.arange(1.0, HARDEST + 1), table[1:], plots.spec(palette.INK, _LINE))
    for k, stroke in enumerate(shown):
        colour = palette.GOOD if stroke.why is None else palette.MISSED
        colour = palette.with_opacity(colour, 0.25 + 0.75 * (k + 1) / len(shown))
        at = np.array([stroke.velocity, table[stroke.velocity]])
        implot.plot_scatter("##strokes", at[:1], at[1:], plots.spec(colour, 1.0, _DOT, implot.Marker_.circle))
    implot.end_plot()
