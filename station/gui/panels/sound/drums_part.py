"""The drum kits that there are: to look at one plays it for a groove, a click chooses it."""

from collections.abc import Callable

from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.sound_actions import ChooseDrums, HearDrums, LookForSounds
from station.app.sound.kit_shelf import KitCard
from station.app.sound.sound_page import SoundView
from station.gui import theme
from station.gui.file_chooser import FolderChooser, has_file_chooser
from station.gui.panels.sound.hover_trial import HoverTrial
from station.gui.widgets.flow_row import FlowRow

FOLDER_LABEL, USE_LABEL, CHOOSE_LABEL, AGAIN_LABEL = (
    "##kit-folder",
    "Use it##kit",
    "Choose a folder…##kit",
    "Look again##kit",
)
_BUTTON, _WIDE = 96.0, 150.0
"""Design pixels."""


class DrumsPart:
    """Keeps the folder that is typed; what the user does goes to `dispatch`."""

    def __init__(self, dispatch: Callable[[Action], None], trial: HoverTrial) -> None:
        self._dispatch, self._trial = dispatch, trial
        self.folder = ""
        self._chooser = FolderChooser("A folder of drum sounds") if has_file_chooser() else None

    def poll(self) -> None:
        """Take what the system's dialog has brought."""
        folder = None if self._chooser is None else self._chooser.chosen()
        if folder:
            self.folder = folder
            self._dispatch(ChooseDrums(folder))

    def gui(self, view: SoundView, drums: str) -> None:
        """Draw it; `drums` is what was chosen."""
        theme.soft("Rest on a kit to hear it, strike your pads to try it; a click chooses it.")
        if view.shelf is None:
            theme.soft("Looking what there is…")
            return
        cards = view.shelf.kits
        if drums not in {card.name for card in cards}:
            cards = (*cards, KitCard(drums, "A folder or file of your own"))
        for card in cards:
            self._kit(card, drums, view.is_awaited and view.tried == card.name)
        theme.part("A kit of your own")
        imgui.set_next_item_width(-1)
        flags = imgui.InputTextFlags_.enter_returns_true
        hint = "a folder of sounds, or a .h2drumkit"
        entered, self.folder = imgui.input_text_with_hint(FOLDER_LABEL, hint, self.folder, flags)
        theme.tooltip("Files named after what they are: kick, snare_v40_r2, hihat_open … F1 says where to read more")
        row = FlowRow()
        imgui.begin_disabled(not self.folder.strip())
        if row.button(USE_LABEL, _BUTTON) or (entered and self.folder.strip()):
            self._dispatch(ChooseDrums(self.folder.strip()))
        imgui.end_disabled()
        theme.tooltip("Let this kit sound")
        if self._chooser is not None:
            if row.button(CHOOSE_LABEL, _WIDE):
                self._chooser.ask()
            theme.tooltip("Choose the folder in the system's own dialog")
        if row.button(AGAIN_LABEL, _WIDE):
            self._dispatch(LookForSounds())
        theme.tooltip("Kits that were put into the folder kits of the station's data are listed by their names")

    def _kit(self, card: KitCard, drums: str, is_awaited: bool) -> None:
        if theme.radio_button(f"{card.name}##kit-{card.name}", card.name == drums):
            self._dispatch(ChooseDrums(card.name))
        self._trial.item(f"drums {card.name}", HearDrums(card.name))
        if card.place:
            theme.tooltip(card.place)
        theme.soft("Getting it ready…" if is_awaited else card.about)
