"""What keys do while a lesson is edited and no field is typed into: letters write, arrows go, Ctrl commands.

The table is all there is: the window asks it in place of the kit's and the player's keys. Function keys look from
elsewhere, as everywhere.
"""

from collections.abc import Callable

from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.editor_actions import (
    CopySelection,
    CutSelection,
    DuplicateBars,
    EraseHere,
    MoveCursor,
    PasteBars,
    Redo,
    RemoveSelection,
    SaveLesson,
    SelectBars,
    Undo,
    WriteLetter,
)
from station.app.actions.player_actions import PlayOrStop
from station.app.actions.practice_actions import Leave
from station.drills.editing.grid_cursor import Way

_CTRL, _SHIFT = int(imgui.Key.mod_ctrl), int(imgui.Key.mod_shift)

EDITOR_KEYS: tuple[tuple[int, Action, str], ...] = (
    (int(imgui.Key.left_arrow), MoveCursor(Way.LEFT), "Arrows"),
    (int(imgui.Key.right_arrow), MoveCursor(Way.RIGHT), "Arrows"),
    (int(imgui.Key.up_arrow), MoveCursor(Way.UP), "Arrows"),
    (int(imgui.Key.down_arrow), MoveCursor(Way.DOWN), "Arrows"),
    (int(imgui.Key.tab), MoveCursor(Way.BEAT_ON), "Tab"),
    (_SHIFT | int(imgui.Key.tab), MoveCursor(Way.BEAT_BACK), "Shift+Tab"),
    (_CTRL | int(imgui.Key.right_arrow), MoveCursor(Way.BAR_ON), "Ctrl+arrows"),
    (_CTRL | int(imgui.Key.left_arrow), MoveCursor(Way.BAR_BACK), "Ctrl+arrows"),
    (_SHIFT | int(imgui.Key.right_arrow), MoveCursor(Way.BAR_ON, selects=True), "Shift+arrows"),
    (_SHIFT | int(imgui.Key.left_arrow), MoveCursor(Way.BAR_BACK, selects=True), "Shift+arrows"),
    (int(imgui.Key.home), MoveCursor(Way.HOME), "Home, End"),
    (int(imgui.Key.end), MoveCursor(Way.END), "Home, End"),
    (int(imgui.Key.backspace), MoveCursor(Way.LEFT), "Backspace"),
    (int(imgui.Key.delete), EraseHere(), "Del"),
    (int(imgui.Key.space), PlayOrStop(), "Space"),
    (int(imgui.Key.escape), Leave(), "Esc"),
    (_CTRL | int(imgui.Key.z), Undo(), "Ctrl+Z"),
    (_CTRL | int(imgui.Key.y), Redo(), "Ctrl+Y"),
    (_CTRL | _SHIFT | int(imgui.Key.z), Redo(), "Ctrl+Y"),
    (_CTRL | int(imgui.Key.s), SaveLesson(), "Ctrl+S"),
    (_CTRL | int(imgui.Key.c), CopySelection(), "Ctrl+C"),
    (_CTRL | int(imgui.Key.x), CutSelection(), "Ctrl+X"),
    (_CTRL | int(imgui.Key.v), PasteBars(), "Ctrl+V"),
    (_CTRL | _SHIFT | int(imgui.Key.v), PasteBars(inserts=True), "Ctrl+Shift+V"),
    (_CTRL | int(imgui.Key.d), DuplicateBars(), "Ctrl+D"),
    (_CTRL | int(imgui.Key.delete), RemoveSelection(), "Ctrl+Del"),
    (_CTRL | int(imgui.Key.a), SelectBars(None), "Ctrl+A"),
)
"""A chord of imgui's, what it asks for, and what the help calls it."""

EDITOR_HELP: tuple[tuple[str, str], ...] = (
    ("x o g f …", "write that letter at the cursor and go on; a right click shows the letters of a line"),
    ("-", "write a rest and go on"),
    ("Arrows", "a cell on or back, a line up or down"),
    ("Tab, Shift+Tab", "a beat on or back"),
    ("Ctrl+arrows", "a bar on or back"),
    ("Shift+arrows", "select bars"),
    ("Home, End", "to the first bar, to the last"),
    ("Del", "erase at the cursor"),
    ("Backspace", "a cell back"),
    ("Space", "play from where the music is, or stop"),
    ("Ctrl+Z, Ctrl+Y", "take back, do again; without end"),
    ("Ctrl+S", "save"),
    ("Ctrl+C, Ctrl+X", "copy the selected bars, cut them; into another lesson, too"),
    ("Ctrl+V", "write what was copied over the bars from the cursor on"),
    ("Ctrl+Shift+V", "write them before the cursor's bar"),
    ("Ctrl+D", "the selected bars once more behind them"),
    ("Ctrl+Del", "take the selected bars away"),
    ("Ctrl+A", "select no bars: all are played"),
    ("F2 to F9", "the named views, in the list's order"),
    ("Esc", "stop, or back to the lessons"),
)
"""What the keys do, as F1 shows it."""

_REPEATED = {"Arrows", "Tab", "Shift+Tab", "Ctrl+arrows", "Backspace", "Del", "Ctrl+Z", "Ctrl+Y"}
_EVERYWHERE = {"Ctrl+S", "Ctrl+Z", "Ctrl+Y", "Space", "Esc"}
"""What holds on the other leaves of the editor too."""


def editor_keys(dispatch: Callable[[Action], None], is_writing: bool) -> None:
    """Do what the keys say that went down since the last frame; nobody types text.

    Letters and arrows are the grid's, where it is seen (`is_writing`).
    """
    for chord, action, words in EDITOR_KEYS:
        if (is_writing or words in _EVERYWHERE) and _is_pressed(chord, words in _REPEATED):
            dispatch(action)
    io = imgui.get_io()
    if is_writing and not (io.key_ctrl or io.key_alt or io.key_super):
        for letter in typed():
            dispatch(WriteLetter(letter))


def typed() -> list[str]:
    """The characters that were typed since the last frame, blanks left out."""
    queue = imgui.get_io().input_queue_characters
    letters = [chr(code) for code in queue]
    return [letter for letter in letters if letter.isprintable() and not letter.isspace()]


def _is_pressed(chord: int, repeats: bool) -> bool:
    """Whether a key went down with exactly these modifiers."""
    io = imgui.get_io()
    if (bool(chord & _CTRL), bool(chord & _SHIFT)) != (io.key_ctrl, io.key_shift) or io.key_alt or io.key_super:
        return False
    return bool(imgui.is_key_pressed(imgui.Key(chord & ~(_CTRL | _SHIFT)), repeat=repeats))
