"""The part of the devices panel where pads are learnt: one hit says which note a pad sends.

While something is learnt it has the panel for itself, in letters that are read from the throne.
"""

from collections.abc import Callable

from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.equipment_actions import GiveUp, LearnPad, NameNote, UndoLearning
from station.app.equipment.mapping_view import MappingView
from station.core.labels import piece_name
from station.core.note_map import NoteMeaning
from station.core.pieces import Piece, word
from station.devices.mapping.device_map import Sent
from station.devices.wizard.pad_choices import PADS, pad_name
from station.gui import theme
from station.gui.widgets.flow_row import FlowRow

LEARN_LABEL, UNDO_LABEL, CANCEL_LABEL = "Learn a pad##learn-pad", "Undo##undo-pad", "Cancel##learn-pad"
_POPUP = "##pads-popup"
_LARGE = 40.0
"""Design pixels of the letters that say what to hit: read from two metres (our choice)."""
_NAME_WIDTH, _ZONES_WIDTH = 130.0, 300.0
_ZONE_PADDING = 20.0
_MOST_UNKNOWN = 4


class PadsPart:
    """Draws it; what the user does goes to `dispatch`."""

    def __init__(self, dispatch: Callable[[Action], None]) -> None:
        self._dispatch = dispatch

    def running(self, asks: str, may_learn: bool) -> None:
        """What to play now; nothing is learnt once it no longer `may`."""
        if not may_learn:
            self._dispatch(GiveUp())
            return
        theme.heading(asks.capitalize(), _LARGE)
        if imgui.button(CANCEL_LABEL, imgui.ImVec2(theme.points(140), theme.points(44))):
            self._dispatch(GiveUp())
        theme.tooltip("Learn nothing (Esc); your strokes mean what they meant before")

    def gui(self, view: MappingView, may_learn: bool) -> None:
        """What is not known, what was learnt, and the button; while somebody plays nothing `may` be learnt."""
        imgui.begin_disabled(not may_learn)
        for sent in view.unknown[-_MOST_UNKNOWN:]:
            self._unknown(sent)
        row = FlowRow()
        if row.button(LEARN_LABEL, 130):
            imgui.open_popup(_POPUP)
        theme.tooltip("Choose what it is to be, then hit it once; kept for this kit at once, and can be undone")
        pad = pads_popup(_POPUP)
        if pad is not None:
            self._dispatch(LearnPad(pad))
        if view.can_undo:
            if row.button(UNDO_LABEL, 84):
                self._dispatch(UndoLearning())
            theme.tooltip("The last thing that was learnt is as it was before")
        imgui.end_disabled()
        if view.learnt:
            imgui.text_wrapped(view.learnt)

    def _unknown(self, sent: Sent) -> None:
        channel, number = sent
        popup = f"##what-{channel}-{number}"
        if imgui.button(f"What is it?##{channel}-{number}"):
            imgui.open_popup(popup)
        theme.tooltip("Choose which pad sends it; kept for this kit at once, and can be undone")
        imgui.same_line()
        imgui.align_text_to_frame_padding()
        imgui.text_wrapped(f"note {number} (channel {channel}): not known")
        pad = pads_popup(popup)
        if pad is not None:
            self._dispatch(NameNote(sent, pad))


def pads_popup(name: str) -> NoteMeaning | None:
    """Draw the table of pads where it is open; returns the pad that was chosen."""
    room = imgui.get_main_viewport().work_size
    imgui.set_next_window_size_constraints(imgui.ImVec2(0, 0), imgui.ImVec2(0.96 * room.x, 0.94 * room.y))
    if not imgui.begin_popup(name, imgui.WindowFlags_.horizontal_scrollbar):
        return None
    theme.heading("Which pad is it?", 20)
    columns = 2 if room.x > theme.points(2.2 * (_NAME_WIDTH + _ZONES_WIDTH)) else 1
    chosen = None
    if imgui.begin_table("##pads", 2 * columns):
        for _ in range(columns):
            imgui.table_setup_column("", imgui.TableColumnFlags_.width_fixed, theme.points(_NAME_WIDTH))
            imgui.table_setup_column("", imgui.TableColumnFlags_.width_fixed, theme.points(_ZONES_WIDTH))
        chosen = _each_piece(columns)
        imgui.end_table()
    if chosen is not None:
        imgui.close_current_popup()
    imgui.end_popup()
    return chosen


def _each_piece(columns: int) -> NoteMeaning | None:
    """The pieces down the columns, in the table's order; returns the pad that was chosen."""
    chosen, pieces = None, list(PADS)
    rows = -(-len(pieces) // columns)
    for row in range(rows):
        imgui.table_next_row()
        for column in range(columns):
            at = column * rows + row
            if at < len(pieces):
                imgui.table_set_column_index(2 * column)
                chosen = _zones(pieces[at], column) or chosen
    return chosen


def _zones(piece: Piece, column: int) -> NoteMeaning | None:
    chosen = None
    imgui.align_text_to_frame_padding()
    imgui.text(piece_name(piece))
    imgui.table_set_column_index(2 * column + 1)
    line = FlowRow()
    for zone, pad in PADS[piece].items():
        label = zone.replace("_", " ")
        line.place(imgui.calc_text_size(label).x + theme.points(_ZONE_PADDING))
        if imgui.button(f"{label}##{word(piece)}/{zone}"):
            chosen = pad
        theme.tooltip(pad_name(pad))
    return chosen
