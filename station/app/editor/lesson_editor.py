"""The editor: one draft at a time, where one is in it, what is selected; the demonstration plays what stands there.

Every change of the text goes through `OpenDraft`, whoever asks for it; what one sees is `EditorView`.
"""

from collections.abc import Callable
from dataclasses import replace
from typing import assert_never

from station.app.actions.editor_actions import (
    ChooseLetter,
    CloseEditor,
    CopySelection,
    CutSelection,
    DropDraft,
    DuplicateBars,
    Edit,
    EditorAction,
    EraseHere,
    MoveCursor,
    NewLesson,
    OpenEditor,
    PasteBars,
    PutCursor,
    RecordTake,
    Redo,
    RemoveSelection,
    ResumeDraft,
    SaveLesson,
    SelectBars,
    SetGridStep,
    SetStepEntry,
    SetTakeOptions,
    Undo,
    WriteLetter,
)
from station.app.editor.draft_files import DraftFiles
from station.app.editor.editor_position import EditorPosition
from station.app.editor.editor_view import EditorView
from station.app.editor.kit_entry import KitEntry
from station.app.editor.open_draft import OpenDraft
from station.app.editor.read_draft import NEW_LESSON, place_of_played, played_bars
from station.app.editor.take_recorder import TakeView
from station.app.sessions.session_control import SessionControl
from station.core.errors import BadInput
from station.core.events import Hit
from station.drills.editing.grid_cursor import (
    BarRange,
    Place,
    letter_at,
    usual_step,
    writing,
)
from station.drills.editing.lesson_edits import REST, CopyBars, LessonEdit, RemoveBars
from station.drills.editing.letter_palette import typed_letter
from station.drills.lesson import Lesson
from station.engine.messages import EngineEvent


class LessonEditor:
    """Edits what `files` open and keep; `sessions` demonstrate it. Lines for the user go to `notify`."""

    def __init__(self, files: DraftFiles, sessions: SessionControl, notify: Callable[[str], None]) -> None:
        self._files, self._sessions, self._notify = files, sessions, notify
        self._draft: OpenDraft | None = None
        self._position = EditorPosition()
        self._copied: tuple[BarRange, str] | None = None
        self._step_entry = False
        self._shown: tuple[Lesson | None, tuple[int, int] | None] = (None, None)
        self._kit = KitEntry(sessions)

    @property
    def is_open(self) -> bool:
        """Whether a lesson is edited."""
        return self._draft is not None

    # --- what is shown -----------------------------------------------------------------------------------------------

    def view(self) -> EditorView | None:
        """What the window shows; None while nothing is edited."""
        draft = self._draft
        if draft is None:
            return None
        player, take = self._sessions.player.view(), self._kit.view()
        return EditorView(
            name=draft.file.name,
            text=draft.history.text,
            page=draft.now.page,
            lesson=draft.lesson,
            faults=draft.now.faults,
            fault_cells=draft.now.fault_cells,
            cursor=self._position.cursor,
            bars=self._position.bars,
            step=self._position.step,
            letter=self._position.letter,
            playhead=self._playhead(draft, take) if player.is_shown or take is not None else None,
            plays=player.player.playing or take is not None,
            undo=draft.history.undo_name or "",
            redo=draft.history.redo_name or "",
            is_saved=draft.is_saved,
            step_entry=self._step_entry,
            options=self._kit.options,
            take=take,
            is_blank=draft.history.text == NEW_LESSON,
        )

    def _playhead(self, draft: OpenDraft, take: TakeView | None) -> Place | None:
        if take is not None:
            return take.place
        if draft.lesson is None:
            return None
        player, now_ns = self._sessions.player.player, self._sessions.player.now_ns
        tick = player.song.tick_at(player.position_ns(now_ns))
        bar = int(player.song.tempo_map.bars_at(tick))
        return place_of_played(draft.lesson, draft.now.page, bar, tick - player.song.tempo_map.bar_start(bar))

    # --- what the user does ------------------------------------------------------------------------------------------

    def act(self, action: EditorAction) -> None:
        """Do what the user asks; raises `StationError`, and then the draft stays as it was."""
        if isinstance(action, OpenEditor | NewLesson | ResumeDraft):
            self._open(action)
        elif isinstance(action, DropDraft):
            self._files.drop(action.path)
        elif self._draft is not None:
            self._do(self._draft, action)
            self._settle()

    def _open(self, action: OpenEditor | NewLesson | ResumeDraft) -> None:
        draft = self._opened(action)
        self._leave()
        self._draft, self._step_entry = draft, False
        self._position = EditorPosition(step=usual_step(draft.now.page))
        self._shown = (None, None)
        self._settle()

    def _opened(self, action: OpenEditor | NewLesson | ResumeDraft) -> OpenDraft:
        match action:
            case OpenEditor(lesson):
                return self._files.open(lesson)
            case NewLesson():
                return self._files.new()
            case ResumeDraft(path):
                return self._files.resume(path)
            case _:
                assert_never(action)

    def _do(self, draft: OpenDraft, action: EditorAction) -> None:
        match action:
            case Edit(edit, joins):
                draft.change(edit, joins)
            case Undo():
                draft.undo()
            case Redo():
                draft.redo()
            case SaveLesson(name):
                self._notify(self._files.save(draft, name))
            case CloseEditor():
                self._leave()
            case WriteLetter(letter):
                self._type(draft, letter)
            case EraseHere():
                draft.change(writing(draft.now.page, self._position.cursor, REST))
            case CopySelection():
                self._copied = self._position.selected, draft.history.text
                self._notify(f"{_words(self._position.selected)} copied")
            case CutSelection():
                self._copied = self._position.selected, draft.history.text
                self._change_bars(draft, RemoveSelection())
            case PasteBars() | DuplicateBars() | RemoveSelection():
                self._change_bars(draft, action)
            case RecordTake():
                self._record(draft)
            case _:
                self._go(draft, action)

    def _go(self, draft: OpenDraft, action: EditorAction) -> None:
        """What changes no text."""
        match action:
            case PutCursor(cursor):
                self._position = self._position.at(cursor)
            case MoveCursor(way, selects):
                self._position = self._position.moved(draft.now.page, way, selects)
            case SelectBars(bars):
                self._position = replace(self._position, bars=bars)
            case SetGridStep(step):
                self._position = replace(self._position, step=step)
            case ChooseLetter(letter):
                self._position = replace(self._position, letter=letter)
            case SetStepEntry(on):
                self._step_entry = on
                self._kit.begin_steps()
            case SetTakeOptions(options):
                self._kit.options = options
            case _:
                raise AssertionError("every action is done in one of these places")

    def _type(self, draft: OpenDraft, typed: str) -> None:
        """Write what was typed, if it is a letter of the cursor's line, and go on."""
        page, cursor = draft.now.page, self._position.cursor
        if cursor.grid >= len(page.grids):
            return
        letter = typed_letter(cursor.line, typed, letter_at(page.grids[cursor.grid], cursor))
        if letter is None:
            raise BadInput(typed, "", "no letter of this line: a right click shows those that are")
        draft.change(writing(page, cursor, letter))
        self._position = self._position.onward(draft.now.page)

    # --- the kit -----------------------------------------------------------------------------------------------------

    def handle(self, event: EngineEvent) -> None:
        """Take one event of the engine: a stroke is written or recorded, where that is asked for."""
        if self._kit.records:
            self._kit.handle(event)
        elif isinstance(event, Hit) and self._step_entry and self._draft is not None:
            if self._kit.write(self._draft, self._position.cursor, event):
                self._position = self._position.onward(self._draft.now.page)
            self._settle()

    def _record(self, draft: OpenDraft) -> None:
        """Begin a recording, or end the one that runs; raises `StationError`."""
        if self._kit.records:
            self._kit.end(draft)
        else:
            self._kit.record(draft, self._position.cursor, self._position.bars)

    def advance(self, now_ns: int) -> None:
        """Move on: what was read is taken, passes that were recorded are written.

        Raises `StationError` for one that cannot be.
        """
        draft = self._draft
        if draft is None:
            return
        if draft.advance():
            self._settle()
        if self._kit.advance(draft, now_ns):
            self._kit.end(draft)
            self._settle()

    def died(self) -> None:
        """The engine has ended, and a recording with it."""
        self._kit.died()

    # --- bars --------------------------------------------------------------------------------------------------------

    def _change_bars(self, draft: OpenDraft, action: PasteBars | DuplicateBars | RemoveSelection) -> None:
        chosen = self._position.selected
        match action:
            case PasteBars(inserts):
                draft.change(self._pasting(inserts))
            case DuplicateBars():
                draft.change(CopyBars(chosen.grid, chosen.first, chosen.last, chosen.grid, chosen.last + 1))
                self._position = self._position.at_bar(chosen.grid, chosen.last + 1)
            case RemoveSelection():
                draft.change(RemoveBars(chosen.grid, chosen.first, chosen.last))
                self._position = replace(self._position, bars=None)

    def _pasting(self, inserts: bool) -> LessonEdit:
        if self._copied is None:
            raise BadInput("paste", "", "nothing is copied: select bars and press Ctrl+C first")
        (copied, text), cursor = self._copied, self._position.cursor
        return CopyBars(copied.grid, copied.first, copied.last, cursor.grid, cursor.bar, not inserts, text)

    # --- what follows ------------------------------------------------------------------------------------------------

    def _settle(self) -> None:
        """After anything was done: cursor and selection are where they can be, and what is there can be heard."""
        draft = self._draft
        if draft is None:
            return
        self._position = self._position.within(draft.now.page)
        lesson, bars = draft.lesson, self._position.bars
        played = None if lesson is None or bars is None else played_bars(lesson, bars)
        loop = None if played is None else (played[0] + 1, played[1] + 1)
        if (lesson, loop) != self._shown and not self._kit.records:
            self._shown = lesson, loop
            self._sessions.rehearse(lesson, loop)

    def choose_played(self, bars: tuple[int, int] | None) -> None:
        """Select the bars of the text that are played as bars `first` to `last`, from 0; None selects none."""
        draft = self._draft
        if draft is None or draft.lesson is None:
            return
        lesson, page = draft.lesson, draft.now.page
        first, last = (None, None) if bars is None else (place_of_played(lesson, page, bar, 0) for bar in bars)
        self._position = self._position.selecting(first, last)
        self._settle()

    def _leave(self) -> None:
        if self._draft is not None:
            self._kit.end(self._draft)
            if self._draft.is_touched:
                self._notify("what is not saved is kept: the lessons page offers it again")
            self._draft.close()
            self._draft = None

    def close(self) -> None:
        """Keep what is not saved, where the program ends."""
        self._leave()


def _words(bars: BarRange) -> str:
    return f"bar {bars.first + 1}" if bars.first == bars.last else f"bars {bars.first + 1} to {bars.last + 1}"
