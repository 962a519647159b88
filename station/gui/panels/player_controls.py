"""The controls of the demonstration's player, as SMED's transport has them (thesis, 4.1.1).

They take one line; what has no room there is in a popup.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

from imgui_bundle import icons_fontawesome_4 as icons
from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.player_actions import (
    GoToFlag,
    KeepFlag,
    PlayOrStop,
    Seek,
    SetCountIn,
    SetDemoClick,
    SetReverse,
    SetSpeed,
    SetStep,
    StepOnce,
    Wind,
)
from station.app.actions.practice_actions import ChooseBars
from station.app.sessions.demo_picture import PlayerView
from station.core.units import NS_PER_S
from station.gui import theme
from station.gui.widgets.flow_row import LINE_HEIGHT, FlowRow
from station.gui.widgets.slots import Use, popup_grid, slot_rows
from station.practice.demonstration.song_player import FLAGS, MAX_SPEED_PERCENT, MIN_SPEED_PERCENT, SongStep

COUNT_IN_LABEL = "count-in##demo"
FLAGS_LABEL = "Flags##flags"
MORE_LABEL = "More##player"
_POPUP, _MORE_POPUP = "##flags-popup", "##player-popup"
_SILENT = "silent, as drums cannot sound backwards or by steps"
BUTTON = (36.0, LINE_HEIGHT)
_GAP = 4.0
_SPEED, _BARS, _STEP, _FLAGS, _MORE = 118.0, 96.0, 92.0, 64.0, 64.0
"""Widths in design pixels."""


@dataclass(frozen=True, slots=True)
class _Part:
    """One of the controls, and how much of the line it takes, in pixels."""

    width: float
    draw: Callable[[], None]


class PlayerControls:
    """The buttons; what the user does goes to `dispatch`.

    `key_wind` is 1 or −1 while a key winds: the window says so every frame.
    """

    def __init__(self, dispatch: Callable[[Action], None]) -> None:
        self._dispatch = dispatch
        self.key_wind = 0
        self._bars: list[int] = []

    def gui(self, view: PlayerView, row: FlowRow) -> None:
        """Draw them into `row`, one line; where it is short the less needed are in a popup. Do what the user does."""
        left_out: list[_Part] = []
        for part in (parts := self._parts(view)):
            more = 0.0 if part is parts[-1] else theme.points(_MORE) + imgui.get_style().item_spacing.x
            if left_out or not row.fits(part.width + more):
                left_out.append(part)
            else:
                row.place(part.width)
                part.draw()
        if left_out:
            row.place(theme.points(_MORE))
            if imgui.button(MORE_LABEL, imgui.ImVec2(theme.points(_MORE), theme.points(BUTTON[1]))):
                imgui.open_popup(_MORE_POPUP)
            theme.tooltip("What else the player can do: its keys are on F1's page")
        if imgui.begin_popup(_MORE_POPUP):
            for part in left_out:
                part.draw()
            imgui.end_popup()

    def _parts(self, view: PlayerView) -> "list[_Part]":
        """The most needed first."""
        bars = imgui.calc_text_size("bars").x + imgui.get_style().item_spacing.x
        return [
            _Part(theme.points(8 * BUTTON[0] + 7 * _GAP), lambda: self._buttons(view)),
            _Part(theme.points(150), lambda: _counter(view)),
            _Part(theme.points(_SPEED), lambda: self._speed(view)),
            _Part(_box_width("click"), lambda: self._click(view)),
            _Part(theme.points(_BARS) + bars, lambda: self._loop(view)),
            _Part(_box_width(COUNT_IN_LABEL), lambda: self._count_in(view)),
            _Part(theme.points(_STEP), lambda: self._step(view)),
            _Part(theme.points(_FLAGS), lambda: self._flags(view)),
        ]

    def _buttons(self, view: PlayerView) -> None:
        imgui.begin_group()
        imgui.push_style_var(imgui.StyleVar_.item_spacing, imgui.ImVec2(theme.points(_GAP), 0))
        player, step = view.player, view.step
        self._button(f"{icons.ICON_FA_FAST_BACKWARD}###start", Seek(0), "To the start (Home)")
        back = self._wind_button(f"{icons.ICON_FA_BACKWARD}###rewind", f"Rewind while it is held ([); {_SILENT}")
        words = f"{step.words} {{}} ({{}}); {_SILENT}"
        self._button(f"{icons.ICON_FA_STEP_BACKWARD}###back", StepOnce(-1), words.format("back", ","))
        stop, play = (icons.ICON_FA_STOP, "Stop here (W)"), (icons.ICON_FA_PLAY, "Watch the demonstration (W)")
        icon, tip = stop if player.playing else play
        self._button(f"{icon}###play", PlayOrStop(), tip)
        self._button(f"{icons.ICON_FA_STEP_FORWARD}###step", StepOnce(1), words.format("on", "."))
        on = self._wind_button(f"{icons.ICON_FA_FORWARD}###forward", f"Forward while it is held (]); {_SILENT}")
        self._button(f"{icons.ICON_FA_FAST_FORWARD}###end", Seek(player.song.length_ns), "To the end (End)")
        tip = f"Backwards (R); {_SILENT}"
        self._button(
            f"{icons.ICON_FA_ARROW_LEFT}###reverse", SetReverse(not player.reverse), tip, highlighted=player.reverse
        )
        imgui.pop_style_var()
        imgui.end_group()
        wind = self.key_wind or on - back
        if wind != player.wind:
            self._dispatch(Wind(wind))

    @staticmethod
    def _wind_button(label: str, tip: str) -> int:
        """Whether it is held."""
        theme.icon_button(label, (theme.points(BUTTON[0]), theme.points(BUTTON[1])))
        held = imgui.is_item_active()
        theme.tooltip(tip)
        imgui.same_line()
        return int(held)

    def _loop(self, view: PlayerView) -> None:
        """The bars that are repeated and practised, as two numbers."""
        player = view.player
        count = player.song.bar_count
        first, last = player.loop or (0, count - 1)
        imgui.align_text_to_frame_padding()
        imgui.text_disabled("bars") if player.loop is None else imgui.text("bars")
        imgui.same_line()
        imgui.set_next_item_width(theme.points(_BARS))
        shown = self._bars or [first + 1, last + 1]
        moved, bars = imgui.drag_int2("##bars", shown, 0.1, 1, count)
        if moved:
            self._bars = bars
        if imgui.is_item_deactivated_after_edit() and self._bars:
            low, high = sorted(min(max(bar, 1), count) - 1 for bar in self._bars)
            self._dispatch(ChooseBars(None if (low, high) == (0, count - 1) and count > 1 else (low, high)))
        if not imgui.is_item_active():
            self._bars = []
        theme.tooltip("The bars that are repeated and that Start practises (I, O; U for all). Ctrl+click to type")

    def _speed(self, view: PlayerView) -> None:
        imgui.set_next_item_width(theme.points(_SPEED))
        moved, percent = theme.slider_int(
            "##speed", view.player.speed_percent, MIN_SPEED_PERCENT, MAX_SPEED_PERCENT, "speed %d %%"
        )
        if moved:
            self._dispatch(SetSpeed(percent, held=True))
        if imgui.is_item_deactivated_after_edit():
            self._dispatch(SetSpeed(percent))
        theme.tooltip("How fast the demonstration goes, of the lesson's own tempo (- and =). Ctrl+click to type")

    def _step(self, view: PlayerView) -> None:
        imgui.set_next_item_width(theme.points(_STEP))
        steps = list(SongStep)
        changed, index = imgui.combo("##step size", steps.index(view.step), [step.words for step in steps])
        if changed:
            self._dispatch(SetStep(steps[index]))
        theme.tooltip("How far a step goes (X for the next)")

    def _click(self, view: PlayerView) -> None:
        changed, click = imgui.checkbox("click##demo", view.click)
        if changed:
            self._dispatch(SetDemoClick(click))
        theme.tooltip("Whether the click sounds with the demonstration (C)")

    def _count_in(self, view: PlayerView) -> None:
        changed, counts_in = imgui.checkbox(COUNT_IN_LABEL, view.counts_in)
        if changed:
            self._dispatch(SetCountIn(counts_in))
        theme.tooltip("A bar of clicks before the demonstration plays (Q)")

    def _flags(self, view: PlayerView) -> None:
        if imgui.button(FLAGS_LABEL, imgui.ImVec2(theme.points(_FLAGS), theme.points(BUTTON[1]))):
            imgui.open_popup(_POPUP)
        theme.tooltip(f"Up to {FLAGS} places to come back to (Shift+1 to {FLAGS}; Ctrl+Shift+1 to {FLAGS} keeps one)")
        self._flags_popup(view)

    def _flags_popup(self, view: PlayerView) -> None:
        """Go to and keep, for each flag."""
        if not imgui.begin_popup(_POPUP):
            return
        theme.heading("Flags", 20)
        player = view.player
        uses = (
            Use(
                "Go to",
                "go",
                lambda slot: self._dispatch(GoToFlag(slot)),
                partial(_flag_tip, player.flags),
                needs_filled=True,
            ),
            Use("Keep as", "keep", lambda slot: self._dispatch(KeepFlag(slot)), _keep_tip),
        )
        slot_rows(uses, [at_ns is not None for at_ns in player.flags], popup_grid(len(player.flags)))
        imgui.end_popup()

    def _button(self, label: str, action: Action, tip: str, *, highlighted: bool = False) -> None:
        if theme.icon_button(label, (theme.points(BUTTON[0]), theme.points(BUTTON[1])), highlighted):
            self._dispatch(action)
        theme.tooltip(tip)
        imgui.same_line()


def _box_width(label: str) -> float:
    """What a checkbox and its words take."""
    words = imgui.calc_text_size(label, True).x
    return float(imgui.get_frame_height() + imgui.get_style().item_inner_spacing.x + words)


def time_words(seconds: float) -> str:
    """Minutes and seconds as a counter shows them: 1:04.3."""
    tenths = int(seconds * 10)
    return f"{tenths // 600}:{tenths // 10 % 60:02d}.{tenths % 10}"


def counter(seconds: float, bar: int | None, beat: int | None) -> None:
    """Time, bar and beat in large figures."""
    place = "–" if bar is None else f"{bar}" if beat is None else f"{bar}.{beat}"
    imgui.push_font(None, theme.LARGE_FONT_SIZE)
    imgui.text(f"{time_words(seconds)}  {place}")
    imgui.pop_font()
    theme.tooltip("Time; bar and beat")


def _counter(view: PlayerView) -> None:
    place = view.player.place(view.now_ns)
    counter(view.position_ns / NS_PER_S, place.bar + 1, place.beat + 1)


def _flag_tip(flags: Sequence[int | None], slot: int) -> str:
    return f"Flag {slot + 1} (Shift+{slot + 1})" if flags[slot] is not None else f"Flag {slot + 1} is not kept yet"


def _keep_tip(slot: int) -> str:
    return f"Keeps this place as flag {slot + 1} (Ctrl+Shift+{slot + 1})"
