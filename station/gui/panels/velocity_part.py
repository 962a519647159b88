"""The part of the devices panel that sets how loud a pad's strokes count: its curve, with the last strokes on it.

Right is how hard the pad says it was struck, up what that counts as; both 1 to 127.
"""

from collections.abc import Callable, Iterable

from imgui_bundle import imgui

from station.app.actions import Action, LearnVelocity, SetCurve
from station.app.kit_seen import MappingView, PadStroke
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
from station.gui.widgets.flow_row import FlowRow
from station.render import palette
from station.render.text.draw_list import Colour

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
    high = theme.points(_HIGH)
    left, top = imgui.get_cursor_screen_pos()
    imgui.dummy(imgui.ImVec2(max(wide, 1.0), high))
    ink, table = imgui.get_window_draw_list(), pad.curve.table

    def at(sent: float, counts: float) -> tuple[float, float]:
        return left + wide * sent / HARDEST, top + high * (1 - counts / HARDEST)

    ink.add_rect_filled((left, top), (left + wide, top + high), _u32(palette.INK, 0.06))
    beside, under = theme.points(6), imgui.get_text_line_height()
    for counts, name, is_right in ((GHOST_COUNTS, "ghost", True), (ACCENT_COUNTS, "accent", False)):  # off the curve
        ink.add_line(at(0, counts), at(HARDEST, counts), _u32(palette.INK, 0.25), theme.points(1))
        x, y = at(HARDEST if is_right else 0, counts)
        x += -beside - imgui.calc_text_size(name).x if is_right else beside
        ink.add_text((x, y - under if is_right else y), _u32(palette.INK, 0.6), name)
    ink.add_line(at(pad.threshold, 0), at(pad.threshold, HARDEST), _u32(palette.BRAND, 0.5), theme.points(1.5))
    points: list[imgui.ImVec2Like] = [imgui.ImVec2(*at(sent, table[sent])) for sent in range(1, HARDEST + 1)]
    ink.add_polyline(points, _u32(palette.INK), theme.points(_LINE), 0)
    shown = list(strokes)
    for k, stroke in enumerate(shown):
        colour = palette.GOOD if stroke.why is None else palette.MISSED
        opacity = 0.25 + 0.75 * (k + 1) / len(shown)
        ink.add_circle_filled(at(stroke.velocity, table[stroke.velocity]), theme.points(_DOT), _u32(colour, opacity))


def _u32(colour: Colour, opacity: float = 1.0) -> int:
    return int(imgui.color_convert_float4_to_u32(imgui.ImVec4(*palette.with_opacity(theme.dyed(colour), opacity))))
