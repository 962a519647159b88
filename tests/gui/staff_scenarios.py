"""The editor's notation and words: a groove by clicks on the staff, fields filled in and refused."""

from imgui_bundle import imgui

from station.app.actions.editor_actions import CloseEditor, Edit, EditorAction, NewLesson
from station.core.pieces import Piece
from station.core.units import PPQ
from station.drills.editing.grid_cursor import Place
from station.drills.editing.lesson_edits import SetText
from station.gui.panels.editor.editor_panel import EDITOR
from station.render.notation.staff import step_of
from tests.gui.drive import Drive

EIGHTH = PPQ // 2
BARE = 'title = "Groove"\ntempo_bpm = 90\n\n[grid]\nhihat = "| -------- | -------- |"\n'
GROOVE = {
    Piece.HIHAT: [(bar, k * EIGHTH) for bar in (0, 1) for k in range(8)],
    Piece.SNARE: [(bar, beat * PPQ) for bar in (0, 1) for beat in (1, 3)],
    Piece.KICK: [(0, 0), (0, 2 * PPQ), (1, 0), (1, 2 * PPQ), (1, 2 * PPQ + EIGHTH)],
}


def ask(drive: Drive, ctx: imgui.test_engine.TestContext, action: EditorAction) -> None:
    """What the pages of other tests press."""
    drive.station.dispatch(action)
    ctx.yield_(3)


def text_of(drive: Drive) -> str:
    editor = drive.state.editor
    assert editor is not None
    return editor.text


def go(drive: Drive, ctx: imgui.test_engine.TestContext, place: Place, piece: Piece) -> None:
    """Move the mouse to a place of the staff."""
    part = drive.window.pages.editor.notation
    assert part.pointer is not None
    spot = part.pointer.spot(place)
    assert spot is not None
    ctx.mouse_move_to_pos(imgui.ImVec2(*part.place_on_screen(spot[1], spot[0].y_of(step_of(piece)))))
    ctx.yield_(2)


def open_bare(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """Two empty bars in the editor."""
    ask(drive, ctx, NewLesson())
    ask(drive, ctx, Edit(SetText(BARE)))
    ctx.yield_(5)


def clicks(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """A groove of two bars by clicks on the staff; one stroke is taken away again, one becomes another."""
    open_bare(drive, ctx)
    for piece, places in GROOVE.items():
        for bar, tick in places:
            go(drive, ctx, Place(0, bar, tick), piece)
            ctx.mouse_click(imgui.MouseButton_.left)
            ctx.yield_(2)
    drive.seen["written"] = text_of(drive)
    go(drive, ctx, Place(0, 1, 2 * PPQ + EIGHTH), Piece.KICK)
    ctx.mouse_click(imgui.MouseButton_.left)
    ctx.yield_(2)
    drive.seen["erased"] = text_of(drive)
    go(drive, ctx, Place(0, 0, PPQ), Piece.SNARE)
    ctx.mouse_click(imgui.MouseButton_.right)
    ctx.yield_(3)
    ctx.item_click("//$FOCUSED/###letter g")
    ctx.yield_(3)
    drive.seen["ghost"] = text_of(drive)
    go(drive, ctx, Place(0, 0, PPQ), Piece.RIDE)
    ctx.mouse_down(imgui.MouseButton_.left)
    go(drive, ctx, Place(0, 1, PPQ), Piece.RIDE)
    ctx.mouse_up(imgui.MouseButton_.left)
    ctx.yield_(2)
    editor = drive.state.editor
    assert editor is not None
    assert editor.bars is not None
    drive.seen["selected"] = [editor.bars.first, editor.bars.last]
    drive.seen["after drag"] = text_of(drive)
    ask(drive, ctx, CloseEditor())


def words(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """Keys are filled in, one is emptied, one is refused, a fault stands beside its field."""
    open_bare(drive, ctx)
    ctx.set_ref(f"//{EDITOR}")
    ctx.item_click("**/Words##leaf")
    ctx.yield_(3)
    for name, typed in (("title", "Groove 2"), ("tempo_bpm", "104"), ("tags", "rock, two bars"), ("level", "2")):
        ctx.item_input_value(f"**/##{name}", typed)
        ctx.yield_(2)
    drive.seen["filled"] = text_of(drive)
    ctx.item_input_value("**/##level", "")
    ctx.yield_(2)
    drive.seen["emptied"] = text_of(drive)
    ctx.item_input_value("**/##passes", "many")
    ctx.yield_(2)
    drive.seen["refused"] = text_of(drive)
    ctx.item_input_value("**/##tempo_bpm", "5")
    ctx.yield_(2)
    editor = drive.state.editor
    assert editor is not None
    drive.seen["faults"] = [fault.text for fault in editor.faults]
    drive.seen["unread"] = drive.unread(ctx)
    ask(drive, ctx, CloseEditor())
