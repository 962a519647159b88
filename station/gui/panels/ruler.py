"""The ruler: bars and beats of the lesson, the bars that are repeated, flags, and where the player is."""

from collections.abc import Callable

from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.player_actions import GoToFlag, Seek
from station.app.actions.practice_actions import Bars, ChooseBars
from station.gui import theme
from station.gui.widgets.flow_row import LINE_HEIGHT
from station.gui.widgets.ruler_scale import RulerScale
from station.practice.demonstration.song_player import SongPlayer
from station.render import palette
from station.render.text.draw_list import Colour

RULER = "##ruler"
_DRAG_PX = 5.0
"""A press that moves less is a click (our choice)."""
_FLAG_PX, _FLAG_WIDTH = 7.0, 13.0
_HELP = (
    "Click to go there. Drag over bars to repeat them: Start practises these bars too (I, O). Double click for all bars"
    " (U). A flag that is clicked brings you to it"
)


class Ruler:
    """Draws the ruler; what the user does on it goes to `dispatch`."""

    def __init__(self, dispatch: Callable[[Action], None]) -> None:
        self._dispatch = dispatch
        self._from: float | None = None

    def gui(self, player: SongPlayer, now_ns: int, width: float) -> None:
        """Draw it `width` pixels wide and do what the user does."""
        height = theme.points(LINE_HEIGHT)
        corner = imgui.get_cursor_screen_pos()
        imgui.invisible_button(RULER, imgui.ImVec2(max(width, 1.0), height))
        scale = RulerScale(player.song, corner.x, max(width, 1.0), theme.points(1.0))
        dragged = self._mouse(player, scale)
        if imgui.is_item_focused() and imgui.get_io().nav_visible:
            imgui.get_window_draw_list().add_rect(corner, _under(corner, width, height), _packed(palette.BRAND), 6.0)
        theme.tooltip(_HELP)
        self._paint(player, now_ns, scale, (corner.y, height), dragged)

    def _mouse(self, player: SongPlayer, scale: RulerScale) -> Bars:
        """Take in presses; returns the bars that a drag covers."""
        x = imgui.get_io().mouse_pos.x
        if imgui.is_item_activated() and imgui.is_mouse_clicked(imgui.MouseButton_.left):
            self._from = x
        begun = self._from
        if begun is None:
            return None
        is_drag = abs(x - begun) > _DRAG_PX * scale.scale
        low, high = sorted((scale.bar_of(begun), scale.bar_of(x)))
        if not imgui.is_item_deactivated():
            return (low, high) if is_drag else None
        self._from = None
        if is_drag:
            self._dispatch(ChooseBars((low, high)))
        elif imgui.get_io().mouse_clicked_last_count[0] > 1:
            self._dispatch(ChooseBars(None))
        else:
            self._click(player, scale, x)
        return None

    def _click(self, player: SongPlayer, scale: RulerScale, x: float) -> None:
        for slot, at_ns in enumerate(player.flags):
            if at_ns is not None and -_FLAG_PX <= (x - scale.x_of(at_ns)) / scale.scale <= _FLAG_WIDTH:
                self._dispatch(GoToFlag(slot))
                return
        self._dispatch(Seek(scale.at_of(x)))

    @staticmethod
    def _paint(player: SongPlayer, now_ns: int, scale: RulerScale, across: tuple[float, float], dragged: Bars) -> None:
        (top, height), unit, brush = across, scale.scale, imgui.get_window_draw_list()
        left, right, bottom = scale.left, scale.left + scale.width, top + height
        size = imgui.get_font_size() * 0.8
        brush.push_clip_rect(imgui.ImVec2(left, top), imgui.ImVec2(right, bottom), True)
        brush.add_rect_filled(
            imgui.ImVec2(left, top),
            imgui.ImVec2(right, bottom),
            _packed(palette.with_opacity(palette.INK, 0.07)),
            6 * unit,
        )
        bars = dragged or player.loop
        if bars is not None:
            low, high = (scale.x_of(at_ns) for at_ns in player.song.span_ns(bars))
            band = _packed(palette.with_opacity(palette.BRAND, 0.34 if dragged else 0.24))
            brush.add_rect_filled(imgui.ImVec2(low, top), imgui.ImVec2(high, bottom), band, 6 * unit)
        for line in scale.lines():
            begins = top + height * (0.72 if line.number is None else 0.0)
            ink = _packed(palette.INK_FAINT if line.number is None else palette.INK_SOFT)
            brush.add_line(imgui.ImVec2(line.x, begins), imgui.ImVec2(line.x, bottom), ink, unit)
            if line.number:
                where = imgui.ImVec2(line.x + 5 * unit, top + 2 * unit)
                brush.add_text(imgui.get_font(), size, where, _packed(palette.INK_SOFT), str(line.number))
        for slot, at_ns in enumerate(player.flags):
            if at_ns is not None:
                x = min(scale.x_of(at_ns), right - _FLAG_WIDTH * unit)
                _paint_flag(brush, x, (top, bottom), unit, str(slot + 1))
        x = scale.x_of(player.position_ns(now_ns))
        x = min(max(x, left + unit), right - unit)
        brush.add_line(imgui.ImVec2(x, top), imgui.ImVec2(x, bottom), _packed(palette.BRAND), 2.5 * unit)
        brush.pop_clip_rect()


def _paint_flag(brush: imgui.ImDrawList, x: float, across: tuple[float, float], unit: float, name: str) -> None:
    top, bottom = across
    good, size = _packed(palette.GOOD), imgui.get_font_size() * 0.72
    low = bottom - 17 * unit
    brush.add_line(imgui.ImVec2(x, top), imgui.ImVec2(x, bottom), good, 1.5 * unit)
    brush.add_rect_filled(imgui.ImVec2(x, low), imgui.ImVec2(x + _FLAG_WIDTH * unit, bottom), good, 3 * unit)
    brush.add_text(imgui.get_font(), size, imgui.ImVec2(x + 3 * unit, low + 1.5 * unit), _packed(palette.NIGHT), name)


def _under(corner: imgui.ImVec2, width: float, height: float) -> imgui.ImVec2:
    return imgui.ImVec2(corner.x + width, corner.y + height)


def _packed(colour: Colour) -> int:
    return int(imgui.color_convert_float4_to_u32(imgui.ImVec4(*theme.themed(colour))))
