"""Where the sound goes: the outputs that there are, the size of a block with its milliseconds, the rate."""

from collections.abc import Callable
from dataclasses import replace

from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.sound_actions import LookForSounds, OutputChoice, UseOutput
from station.app.sound.sound_page import SoundView
from station.gui import theme
from station.gui.widgets.flow_row import FlowRow

USE_LABEL, AGAIN_LABEL, BLOCK_LABEL, RATE_LABEL = "Use it##output", "Look again##output", "##block", "##rate"
_BLOCKS = (0, 16, 32, 64, 128, 256, 512, 1024, 2048)
_RATES = (44_100, 48_000, 88_200, 96_000)
_BUTTON = 110.0


class OutputPart:
    """Keeps what is chosen until it is used; what the user does goes to `dispatch`."""

    def __init__(self, dispatch: Callable[[Action], None]) -> None:
        self._dispatch = dispatch
        self._wanted: OutputChoice | None = None
        self._used: OutputChoice | None = None

    def gui(self, view: SoundView) -> None:
        """Draw it."""
        if view.output != self._used:  # taken, or gone back to
            self._used, self._wanted = view.output, view.output
        wanted = self._wanted or view.output
        theme.soft(f"The sound goes to {view.sounding}." if not view.changing else "Opening the output…")
        if view.shelf is None:
            theme.soft("Looking what there is…")
            return
        if view.shelf.fault:
            theme.warning(view.shelf.fault)
        wanted = replace(wanted, output=self._outputs(view, wanted.output))
        wanted = self._sizes(wanted)
        self._wanted = wanted
        row = FlowRow()
        imgui.begin_disabled(wanted == view.output or view.is_playing or view.changing)
        if row.button(USE_LABEL, _BUTTON):
            self._dispatch(UseOutput(wanted))
        imgui.end_disabled()
        theme.tooltip("The engine starts anew, in about a second; where this does not sound, it goes back")
        if row.button(AGAIN_LABEL, _BUTTON):
            self._dispatch(LookForSounds())
        theme.tooltip("Look anew which outputs there are")
        if view.is_playing:
            theme.soft("While somebody plays the output stays.")

    @staticmethod
    def _outputs(view: SoundView, chosen: str) -> str:
        devices = () if view.shelf is None else view.shelf.outputs
        names = [f"{device.host}: {device.name}" for device in devices]
        default = f"the system's default ({devices[0].name})" if devices else "the system's default"
        if theme.radio_button(f"{default}##output-", not chosen):
            chosen = ""
        theme.tooltip("The sound moves with it, between sessions")
        for name in dict.fromkeys(names):
            if theme.radio_button(f"{name}##output-{name}", chosen == name):
                chosen = name
        if chosen and chosen not in names:
            theme.radio_button(f"{chosen}##output-else", True)
            theme.tooltip("What the settings say: any output whose name has it")
        return chosen

    @staticmethod
    def _sizes(wanted: OutputChoice) -> OutputChoice:
        is_narrow, room = theme.is_narrow(), imgui.get_content_region_avail().x
        half = room if is_narrow else (room - imgui.get_style().item_spacing.x) / 2
        blocks = sorted({*_BLOCKS, wanted.block_frames})
        imgui.set_next_item_width(half)
        words = [_block_words(frames, wanted.rate_hz) for frames in blocks]
        changed, index = imgui.combo(BLOCK_LABEL, blocks.index(wanted.block_frames), words)
        wanted = replace(wanted, block_frames=blocks[index]) if changed else wanted
        theme.tooltip("A smaller block sounds sooner and asks more of the computer; what crackles is too small")
        if not is_narrow:
            imgui.same_line()
        rates = sorted({*_RATES, wanted.rate_hz})
        imgui.set_next_item_width(half)
        changed, index = imgui.combo(RATE_LABEL, rates.index(wanted.rate_hz), [f"{rate} Hz" for rate in rates])
        theme.tooltip("One that the output does not have is replaced by its own")
        return replace(wanted, rate_hz=rates[index]) if changed else wanted


def _block_words(frames: int, rate_hz: int) -> str:
    return f"{frames} frames, {1e3 * frames / rate_hz:.1f} ms" if frames else "driver's block"
