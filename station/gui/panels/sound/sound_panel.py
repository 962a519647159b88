"""The panel of sounds: how much is heard, then a leaf each for the click, the levels, the drums, the output."""

from collections.abc import Callable, Mapping

from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.sound_actions import SetHeard
from station.app.window_state import State
from station.core.settings import CLICK_ALONE, EVERYTHING, NOTHING
from station.gui import theme
from station.gui.panels.sound.click_part import ClickPart
from station.gui.panels.sound.drums_part import DrumsPart
from station.gui.panels.sound.hover_trial import HoverTrial
from station.gui.panels.sound.levels_part import LevelsPart
from station.gui.panels.sound.output_part import OutputPart
from station.gui.panels.sound.track_part import TrackPart
from station.gui.widgets.flow_row import FlowRow

SOUND = "Sound"
ABOUT = "The click, who is how loud, the drums, where the sound goes, a track to play along to, silent practice"
HELP = (
    "What you set is heard at once, and kept. Levels, drums and the click's voice change in mid-session too; what"
    " clicks where holds from the next session on, and so does the track. Rest on a voice or a drum kit to hear it,"
    " click to choose it. For a night beside others let the click alone be heard, in your headphones, or nothing:"
    " then the picture flashes with the beat. A sound file that is dropped while this page is seen becomes the track;"
    " elsewhere it becomes a song's. Another output starts the engine anew; where it does not sound, the sound goes"
    " back to where it was."
)
TABS, IMPORT_LABEL = "##sound", "Import a score…##sound"
CLICK_TAB, LEVELS_TAB, DRUMS_TAB, TRACK_TAB, OUTPUT_TAB = "Click", "Levels", "Drums", "Track", "Output"
_IMPORT_TIP = "A music file, a song's folder or a link becomes a lesson: the page Import"
_HEARD = {
    EVERYTHING: ("everything", "All that has a level"),
    CLICK_ALONE: ("click alone", "Neither your strokes nor the drummer nor a track; for headphones at night"),
    NOTHING: ("nothing", "Not even the click: the picture flashes on the beats"),
}


class SoundPanel:
    """The panel; what the user does goes to `dispatch`, the import's page is opened by `open_import`."""

    def __init__(self, dispatch: Callable[[Action], None], open_import: Callable[[], None]) -> None:
        self._dispatch, self._open_import = dispatch, open_import
        self._trial = HoverTrial(dispatch)
        self._click, self._levels = ClickPart(dispatch, self._trial), LevelsPart(dispatch)
        self._drums, self._output = DrumsPart(dispatch, self._trial), OutputPart(dispatch)
        self._track = TrackPart(dispatch)
        self.leaf = CLICK_TAB
        """Which is in front."""
        self._front = ""
        self._seen_in = -1
        self._leaves: Mapping[str, Callable[[State], None]] = {
            CLICK_TAB: lambda state: self._click.gui(state.sound, state.settings.click, state.selection),
            LEVELS_TAB: lambda state: self._levels.gui(state.sound, state.settings),
            DRUMS_TAB: lambda state: self._drums.gui(state.sound, state.settings.drums),
            TRACK_TAB: lambda state: self._track.gui(state.sound, state.settings),
            OUTPUT_TAB: lambda state: self._output.gui(state.sound),
        }

    def poll(self) -> None:
        """Take what the system's dialogs have brought."""
        self._drums.poll()
        self._track.poll()

    @property
    def is_seen(self) -> bool:
        """Whether it was drawn in this frame or the one before: a sound that is dropped then is the track."""
        return 0 <= imgui.get_frame_count() - self._seen_in <= 1

    def gui(self, state: State) -> None:
        """Draw the panel and do what the user does in it."""
        self._seen_in = imgui.get_frame_count()
        self._trial.begin()
        self._heard(state.settings.heard)
        if theme.is_narrow():
            self._one_of(state)
        else:
            self._tabs(state)
        self._trial.end()

    def _one_of(self, state: State) -> None:
        """The leaves in a panel that has no room for tabs."""
        names = list(self._leaves)
        imgui.set_next_item_width(-1)
        _, index = imgui.combo(TABS, names.index(self.leaf), names)
        self.leaf = names[index]
        self._leaves[self.leaf](state)

    def _tabs(self, state: State) -> None:
        imgui.push_style_var(imgui.StyleVar_.frame_padding, imgui.ImVec2(theme.points(6), theme.points(7)))
        is_seen = imgui.begin_tab_bar(TABS, imgui.TabBarFlags_.fitting_policy_shrink)
        imgui.pop_style_var()
        if not is_seen:
            return
        opens = self.leaf if self.leaf != self._front else ""
        for name, draw in self._leaves.items():
            imgui.push_style_var(imgui.StyleVar_.frame_padding, imgui.ImVec2(theme.points(6), theme.points(7)))
            is_front = imgui.begin_tab_item(name, None, imgui.TabItemFlags_.set_selected if name == opens else 0)[0]
            imgui.pop_style_var()
            if is_front:
                if not opens or name == opens:
                    self.leaf = self._front = name
                draw(state)
                imgui.end_tab_item()
        imgui.end_tab_bar()

    def _heard(self, heard: str) -> None:
        """How much is heard at all, and where scores come in."""
        theme.part("What is heard")
        if theme.is_narrow():
            self._heard_of_list(heard)
            return
        row = FlowRow()
        for word, (name, tip) in _HEARD.items():
            row.place(imgui.get_frame_height() + imgui.get_style().item_inner_spacing.x + imgui.calc_text_size(name).x)
            if imgui.radio_button(f"{name}##heard", heard == word):
                self._dispatch(SetHeard(word))
            theme.tooltip(tip)
        if row.button(IMPORT_LABEL, 140.0):
            self._open_import()
        theme.tooltip(_IMPORT_TIP)

    def _heard_of_list(self, heard: str) -> None:
        """The same in a panel that has no room for it."""
        words = list(_HEARD)
        imgui.set_next_item_width(-1)
        changed, index = imgui.combo("##heard", words.index(heard), [name for name, _ in _HEARD.values()])
        if changed:
            self._dispatch(SetHeard(words[index]))
        theme.tooltip(_HEARD[heard][1])
        if imgui.button(IMPORT_LABEL):
            self._open_import()
        theme.tooltip(_IMPORT_TIP)
