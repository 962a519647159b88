"""What an edit is called where it can be undone: "stroke on snare, bar 2"."""

from station.core.labels import limb_name, piece_name
from station.core.pieces import Limb
from station.drills.editing.lesson_edits import (
    REST,
    AddBars,
    AddGrid,
    AddLine,
    CopyBars,
    CutBeat,
    Fold,
    LessonEdit,
    LineAt,
    PlayIn,
    RemoveBars,
    RemoveGrid,
    RemoveLine,
    SetKey,
    SetSign,
    SetStroke,
    SetText,
    TextLine,
)


def edit_words(edit: LessonEdit) -> str:
    """The edit in a few words, its bars counted from 1."""
    match edit:
        case SetStroke() | SetSign() | CutBeat():
            return f"{_in_a_bar(edit)}, bar {edit.bar + 1}"
        case AddLine() | RemoveLine():
            return f"line of {line_words(edit.line)} {'added' if isinstance(edit, AddLine) else 'removed'}"
        case AddBars() | RemoveBars() | CopyBars() | PlayIn():
            return _of_bars(edit)
        case _:
            return _of_the_lesson(edit)


def _of_bars(edit: AddBars | RemoveBars | CopyBars | PlayIn) -> str:
    match edit:
        case AddBars(_, at, count):
            return f"{_bars(at, at + count - 1)} added"
        case CopyBars(text=text) if text:
            return f"{_bars(edit.at, edit.at + edit.last - edit.first)} pasted"
        case PlayIn():
            return f"played in, {_bars(edit.first, edit.last)}"
        case _:
            return f"{_bars(edit.first, edit.last)} {'copied' if isinstance(edit, CopyBars) else 'removed'}"


def _in_a_bar(edit: SetStroke | SetSign | CutBeat) -> str:
    match edit:
        case SetStroke(line, _, _, letter):
            return f"{'stroke erased' if letter == REST else 'stroke'} on {line_words(line)}"
        case SetSign(_, line, _, _, sign):
            return f"{line} {'erased' if sign == REST else sign}"
        case CutBeat(_, _, beat, cells):
            return f"{'all beats' if beat is None else f'beat {beat + 1}'} in {cells}"


def _of_the_lesson(edit: LessonEdit) -> str:
    match edit:
        case AddGrid(name):
            return f"grid {name} added"
        case RemoveGrid():
            return "grid removed"
        case SetKey(path, value):
            key = next((str(part) for part in reversed(path) if isinstance(part, str)), "key")
            return f"{key} {'removed' if value is None else 'set'}"
        case Fold():
            return "folded to a smaller kit"
        case SetText():
            return "typed"
        case _:
            raise AssertionError("every edit has its words")


def line_words(line: LineAt | TextLine) -> str:
    """A line as people call it: "snare, left hand"."""
    if isinstance(line, TextLine):
        return str(line)
    limb = "" if line.limb is Limb.UNKNOWN else f", {limb_name(line.limb)}"
    return f"{piece_name(line.piece)}{limb}"


def _bars(first: int, last: int) -> str:
    return f"bar {first + 1}" if first == last else f"bars {first + 1} to {last + 1}"
