"""The editor as a teacher has it: two bars by mouse, by keyboard and by kit; a draft that is killed and found."""

import json
import time
from pathlib import Path

from imgui_bundle import imgui

from station.app.actions.editor_actions import NewLesson, PutCursor, SetStepEntry
from station.core.pieces import Piece
from station.core.units import PPQ
from station.drills.editing.grid_cursor import Cursor, GridStep, Line
from station.drills.editing.lesson_edits import LineAt
from station.gui.panels.editor.editor_toolbar import (
    BACK_LABEL,
    BARS_LABEL,
    KEEP_LABEL,
    NAME_LABEL,
    SAVE_AS_LABEL,
    STEP_LABEL,
)
from station.gui.panels.lessons.lesson_list import RESUME_LABEL, UNSAVED
from station.gui.panels.lessons_panel import ADD_LABEL, EDIT_LABEL, NEW_LABEL
from tests.gui.drive import Drive, open_popup, to_edit
from tests.gui.key_chord import chord

Test = imgui.test_engine.TestContext
HIHAT, SNARE, KICK = (LineAt(0, piece) for piece in (Piece.HIHAT, Piece.SNARE, Piece.KICK))
SIXTEENTH = PPQ // 4
GROOVE: tuple[tuple[LineAt, int, int, str], ...] = (
    *((HIHAT, bar, eighth * 2, "x") for bar in (0, 1) for eighth in range(8)),
    *((SNARE, bar, sixteenth, "o") for bar in (0, 1) for sixteenth in (4, 12)),
    (SNARE, 0, 7, "g"),
    (SNARE, 1, 15, "g"),
    *((KICK, 0, sixteenth, "o") for sixteenth in (0, 10)),
    *((KICK, 1, sixteenth, "o") for sixteenth in (0, 8, 11)),
)
"""Line, bar, sixteenth and letter of each stroke."""
_NOTES = {Piece.HIHAT: 42, Piece.SNARE: 38, Piece.KICK: 36}
"""General MIDI's numbers."""
_VELOCITIES = {"x": 84, "o": 76, "g": 30}
_MS = 1_000_000
_SIXTEENTH_MS = 187.5
"""At 80 beats a minute, which a new lesson has."""
_COUNT_IN_MS = 3000.0
_LATE_MS = (9.0, -7.0, 4.0, -12.0, 0.0, 11.0, -3.0)
"""How a hand misses, stroke by stroke in turn."""


def played_groove() -> list[tuple[int, bytes]]:
    """The same as a kit sends it, in nanoseconds from the transport's start: a bar of count-in, then the two bars."""
    found = []
    for index, (line, bar, sixteenth, letter) in enumerate(GROOVE):
        at_ms = _COUNT_IN_MS + (16 * bar + sixteenth) * _SIXTEENTH_MS + _LATE_MS[index % len(_LATE_MS)]
        found.append((round(at_ms * _MS), bytes((0x99, _NOTES[line.piece], _VELOCITIES[letter]))))
    return sorted(found)


def choose_step(ctx: Test, step: GridStep) -> None:
    """Say how fine one writes; the slash in its words would lead the test engine astray."""
    words = step.words.replace("/", "\\/")
    ctx.combo_click(f"{STEP_LABEL}/{words}")


def two_empty_bars(drive: Drive, ctx: Test) -> None:
    """A new lesson from the list, with a second bar, written in sixteenths."""
    ctx.set_ref("//Lessons")
    open_popup(ctx, ADD_LABEL)
    ctx.item_click(f"//$FOCUSED/{NEW_LABEL}")
    ctx.yield_(3)
    ctx.set_ref("//Editor")
    choose_step(ctx, GridStep.SIXTEENTHS)
    open_popup(ctx, BARS_LABEL)
    ctx.item_click("//$FOCUSED/A bar behind this one")
    ctx.yield_(2)
    assert drive.state.editor is not None


def save_as(drive: Drive, ctx: Test, name: str) -> None:
    """Keep it under a name, tell what its file says, and go back to the lessons."""
    ctx.set_ref("//Editor")
    open_popup(ctx, SAVE_AS_LABEL)
    ctx.item_input_value(f"//$FOCUSED/{NAME_LABEL}", name)
    ctx.yield_(2)
    if drive.state.editor is not None and drive.state.editor.name != name:
        ctx.item_click(f"//$FOCUSED/{KEEP_LABEL}")
    ctx.yield_(3)
    drive.seen["told"] = drive.state.toast
    drive.seen["file"] = (drive.state.settings.own_lessons_dir / f"{name}.toml").read_text(encoding="utf-8")
    ctx.set_ref("//Editor")
    ctx.item_click(f"**/{BACK_LABEL}")
    ctx.yield_(5)
    drive.seen["back"] = drive.state.editor is None
    card = drive.state.selection.card
    drive.seen["chosen"] = "" if card is None else card.name


def point_at(drive: Drive, ctx: Test, line: Line, bar: int, tick: int) -> None:
    """Move the mouse to a cell of the grid."""
    part = drive.window.pages.editor.grid
    assert part.geometry is not None
    top = part.geometry.y_of(line)
    assert top is not None
    x, y = part.corner[0] + part.geometry.x_of(bar, tick), part.corner[1] + top
    ctx.mouse_move_to_pos(imgui.ImVec2(x + 4, y + part.geometry.sizes.row / 2))


def by_mouse(drive: Drive, ctx: Test) -> None:
    """Each stroke by a click, a run of the hi-hat by a drag, ghosts from the list of letters."""
    two_empty_bars(drive, ctx)
    choose_step(ctx, GridStep.EIGHTHS)
    for bar in (0, 1):
        point_at(drive, ctx, HIHAT, bar, 0)
        ctx.mouse_down(0)
        for eighth in range(8):
            point_at(drive, ctx, HIHAT, bar, eighth * 2 * SIXTEENTH)
            ctx.yield_()
        ctx.mouse_up(0)
        ctx.yield_(2)
    choose_step(ctx, GridStep.SIXTEENTHS)
    for line, bar, sixteenth, letter in GROOVE:
        if line is HIHAT:
            continue
        point_at(drive, ctx, line, bar, sixteenth * SIXTEENTH)
        if letter == "g":
            ctx.mouse_click(1)
            ctx.yield_(2)
            ctx.item_click("//$FOCUSED/###letter g")
        else:
            ctx.mouse_click(0)
        ctx.yield_(2)
    save_as(drive, ctx, "mouse")


def by_keyboard(drive: Drive, ctx: Test) -> None:
    """Letters and rests line by line, arrows between them; a slip is taken back."""
    two_empty_bars(drive, ctx)
    ctx.mouse_move_to_pos(imgui.ImVec2(2, 2))
    for line in (HIHAT, SNARE, KICK):
        ctx.key_press(imgui.Key.home)
        ctx.key_press(imgui.Key.up_arrow, 3)
        ctx.key_press(imgui.Key.down_arrow, (HIHAT, SNARE, KICK).index(line))
        letters = {(bar, at): letter for each, bar, at, letter in GROOVE if each is line}
        here = 0
        for bar, at in sorted(letters):
            ctx.key_press(imgui.Key.right_arrow, 16 * bar + at - here)
            ctx.key_chars(letters[bar, at])
            ctx.yield_(2)
            here = 16 * bar + at + 1
    ctx.key_chars("o")
    ctx.yield_(2)
    ctx.key_press(chord(imgui.Key.mod_ctrl, imgui.Key.z))
    ctx.yield_(2)
    save_as(drive, ctx, "keyboard")


def by_kit(drive: Drive, ctx: Test) -> None:
    """A pass over the click, as a hand plays it."""
    two_empty_bars(drive, ctx)
    drive.engine.strokes = played_groove()
    ctx.set_ref("//Editor")
    ctx.item_click("**/###record")
    ctx.yield_(2)
    drive.seen["records"] = drive.state.editor is not None and drive.state.editor.take is not None
    struck = 0
    for _ in range(1000):
        ctx.yield_()
        view = drive.state.editor
        assert view is not None
        if view.take is not None and view.take.pass_index >= 1:
            break
        struck = max(struck, 0 if view.take is None else len(view.take.strokes))
    drive.seen["struck"] = struck
    ctx.yield_(4)
    ctx.item_click("**/###record")
    ctx.yield_(2)
    drive.engine.strokes = []
    save_as(drive, ctx, "kit")


def by_steps(drive: Drive, ctx: Test) -> None:
    """The same stroke by stroke: the kit writes where the cursor is."""
    two_empty_bars(drive, ctx)
    drive.station.dispatch(SetStepEntry(on=True))
    places = sorted({(bar, at) for _, bar, at, _ in GROOVE})
    for bar, at in places:
        drive.station.dispatch(PutCursor(Cursor(0, bar, at * SIXTEENTH, SNARE)))
        for line, other_bar, other, letter in GROOVE:
            if (other_bar, other) == (bar, at):
                drive.engine.play_bytes(bytes((0x99, _NOTES[line.piece], _VELOCITIES[letter])).hex())
        ctx.yield_(2)
    drive.seen["cursor"] = [drive.state.editor.cursor.bar] if drive.state.editor is not None else []
    save_as(drive, ctx, "steps")


def edits_until_killed(drive: Drive, ctx: Test) -> None:
    """Edits without end, each told in a file when it has been made, until somebody ends the program."""
    told = Path(drive.settings).with_name("edits.jsonl")
    drive.station.dispatch(NewLesson())
    ctx.yield_(3)
    ctx.mouse_move_to_pos(imgui.ImVec2(2, 2))
    with told.open("a", encoding="utf-8") as file:
        for number in range(100_000):
            ctx.key_chars("xXghoe-"[(number + number // 8) % 7])  # no cell gets what it has
            ctx.yield_(2)
            if number % 8 == 7:
                ctx.key_press(imgui.Key.home)
            view = drive.state.editor
            assert view is not None
            file.write(json.dumps({"at": time.time(), "text": view.text}) + "\n")
            file.flush()


def finds_draft(drive: Drive, ctx: Test) -> None:
    """What a killed program left is offered, and gone on with; undo leads back to the beginning."""
    (left,) = drive.state.drafts
    ctx.set_ref("//Lessons")
    open_popup(ctx, f"**/{UNSAVED}a new lesson")
    ctx.item_click(f"//$FOCUSED/{RESUME_LABEL}")
    ctx.yield_(3)
    view = drive.state.editor
    assert view is not None, "the draft is open"
    drive.seen["text"], drive.seen["saved"] = view.text, view.is_saved
    ctx.key_press(chord(imgui.Key.mod_ctrl, imgui.Key.s))
    ctx.yield_(3)
    drive.seen["left"] = len(list(left.path.parent.iterdir()))
    drive.seen["kept"] = [path.name for path in drive.state.settings.own_lessons_dir.glob("*.toml")]


def closes_by_escape(drive: Drive, ctx: Test) -> None:
    """Escape closes a list, then the help, and only then the editor."""
    drive.station.dispatch(NewLesson())
    ctx.yield_(3)
    ctx.set_ref("//Editor")
    stages = drive.seen["open"] = []

    def tell() -> None:
        ctx.key_press(imgui.Key.escape)
        ctx.yield_(3)
        a_list = imgui.is_popup_open("", imgui.PopupFlags_.any_popup)
        stages.append([a_list, drive.window._show_help, drive.state.editor is not None])

    ctx.key_press(imgui.Key.f1)
    ctx.yield_(2)
    ctx.item_click(BARS_LABEL)
    ctx.yield_(2)
    drive.seen["before"] = [imgui.is_popup_open("", imgui.PopupFlags_.any_popup), drive.window._show_help]
    for _ in range(3):
        tell()


def changes_what_plays(drive: Drive, ctx: Test) -> None:
    """A copy of a lesson that ships plays on while it is changed; the drummer and the sound follow."""
    drive.choose(ctx, passes=1)
    to_edit(ctx)
    ctx.item_click(EDIT_LABEL)
    ctx.yield_(3)
    seen = drive.seen
    seen["told"] = drive.state.toast
    ctx.mouse_move_to_pos(imgui.ImVec2(2, 2))
    ctx.key_press(imgui.Key.space)
    ctx.yield_(8)
    before, notes = drive.state.player, len(drive.picture.score)
    seen["plays"] = before.player.playing
    point_at(drive, ctx, KICK, 0, 2 * SIXTEENTH)
    ctx.mouse_click(0)
    ctx.yield_(2)
    after = drive.state.player
    seen["goes on"] = after.player.playing and after.position_ns > before.position_ns
    seen["bars"] = after.player.song.bar_count
    deadline = time.monotonic() + 30
    while len(drive.picture.score) == notes and time.monotonic() < deadline:
        ctx.yield_()
    seen["more notes"] = len(drive.picture.score) - notes
    ctx.key_press(chord(imgui.Key.mod_shift, imgui.Key.right_arrow))
    ctx.yield_(2)
    ctx.key_press(imgui.Key.escape)
    ctx.yield_(2)
    seen["stands"] = not drive.state.player.player.playing
    ctx.key_press(imgui.Key.escape)
    ctx.yield_(5)
    seen["left"] = [drive.state.editor is None, len(drive.state.drafts)]
