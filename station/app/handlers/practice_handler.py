"""What is practised now, and who makes way for it: sessions, the editor, an exam, a block of the day's plan."""

from contextlib import suppress

from station.app.actions.battle_actions import BattleAction, BeginBattle, CloseBattle, OpenBattle
from station.app.actions.editor_actions import CloseEditor, EditorAction
from station.app.actions.exam_actions import BeginExam, ExamAction, LeaveExam, ReadyForExam
from station.app.actions.practice_actions import (
    Begin,
    ChoiceAction,
    ChooseBars,
    Dismiss,
    Drill,
    EndSession,
    Leave,
    Pause,
    PracticeAction,
    StrikeKey,
    TakeStep,
)
from station.app.actions.today_actions import StartBlock
from station.app.room_state import Stage
from station.app.station_parts import StationParts
from station.core.errors import DeviceError
from station.practice.records.report.next_steps import StepKind, block_step


def choose(parts: StationParts, action: ChoiceAction) -> None:
    """Choose a lesson, or bars of it, which are the editor's while it is open."""
    if isinstance(action, ChooseBars) and parts.editor.is_open:
        parts.editor.choose_played(action.bars)
    else:
        parts.chooser.act(action)


def practise(parts: StationParts, action: PracticeAction) -> None:
    """Begin, pause or end what is practised."""
    match action:
        case Begin() if parts.exam.looks:
            parts.exam.act(ReadyForExam())
        case Begin() if parts.battle.is_open:
            parts.battle.act(BeginBattle())
        case Begin() | Drill() if parts.exam.is_on:
            raise DeviceError("an exam is one take: go back to the lessons to practise")
        case Begin():
            _begin(parts)
        case Drill(bar):
            _begin(parts, bar)
        case TakeStep(place):
            _take_step(parts, place)
        case Pause(strokes):
            parts.pads.forget()
            parts.sessions.practice.turn(strokes)
        case Leave():
            _leave(parts)
        case Dismiss() if parts.battle.is_open:
            parts.battle.leave()
        case StrikeKey(hit):
            with suppress(DeviceError):  # a dead engine hears none, and has said so
                parts.engine.send(hit)
        case _:
            parts.sessions.act(action)


def begin_block(parts: StationParts, action: StartBlock) -> None:
    """Begin a block of the day's plan, where there is one."""
    item = parts.today.block(action.place)
    if item is not None:
        parts.chooser.take_block(item)
        _begin(parts)
        following = parts.today.block_behind(action.place)
        step = None if following is None else block_step(following.place, following.item.title, following.item.why)
        parts.sessions.practice.next_block = step


def battle(parts: StationParts, action: BattleAction) -> str | None:
    """What a battle is asked, whose place is the editor's or an exam's while one of them is open."""
    if isinstance(action, OpenBattle):
        if parts.editor.is_open:
            raise DeviceError("close the editor first: a battle takes its place")
        parts.who.ask(on=False)
        _leave_look(parts)
    return parts.battle.act(action)


def sit_exam(parts: StationParts, action: ExamAction) -> None:
    """What an exam is asked, whose place is the editor's while that is open."""
    if parts.editor.is_open:
        raise DeviceError("close the editor first: an exam takes its place")
    if isinstance(action, BeginExam) and not parts.sessions.practice.is_playing:
        parts.battle.leave()
    parts.exam.act(action)


def edit(parts: StationParts, action: EditorAction) -> None:
    """What the editor is asked; it takes the place of a session, and gives it back with what was saved."""
    was_open = parts.editor.is_open
    if not was_open and parts.sessions.practice.stage is not Stage.IDLE:
        raise DeviceError("end the session first: the editor takes its place")
    if not was_open:
        parts.who.ask(on=False)
        _leave_look(parts)
        parts.battle.leave()
    parts.editor.act(action)
    if was_open and not parts.editor.is_open:
        _turn_back(parts)


def _turn_back(parts: StationParts) -> None:
    """The editor is left: the lessons again, with what was saved."""
    if parts.drafts.kept is not None:
        parts.chooser.open(parts.drafts.kept)
        parts.drafts.kept = None
    parts.chooser.show_anew()


def _take_step(parts: StationParts, place: int) -> None:
    """Begin what comes next, where a result is shown that has it; raises `StationError`."""
    sessions = parts.sessions
    steps, begun = sessions.practice.last_result.steps, sessions.begun
    if sessions.practice.stage is not Stage.RESULT or place >= len(steps) or begun is None:
        return
    step = steps[place]
    if step.kind is StepKind.BLOCK and step.place is not None:
        begin_block(parts, StartBlock(step.place))
    elif step.kind is StepKind.LESSON:
        parts.chooser.take_up(step.lesson, step.bars)
        _begin(parts)
    else:
        parts.make_ready()
        sessions.start(begun if step.kind is StepKind.AGAIN else parts.chooser.for_step(begun, step))


def _begin(parts: StationParts, bar: int | None = None) -> None:
    parts.make_ready()
    _leave_look(parts)
    if bar is None:
        parts.sessions.practice.next_block = None
    parts.chooser.begin(bar)


def _leave_look(parts: StationParts) -> None:
    """Whoever begins something else takes no exam."""
    if parts.exam.looks:
        parts.exam.act(LeaveExam())


def _leave(parts: StationParts) -> None:
    stage = parts.sessions.practice.stage
    if parts.mapping.learns or parts.sticks.learns:
        parts.mapping.give_up()
        parts.sticks.give_up()
    elif stage is Stage.PLAYING:
        parts.sessions.practice.end()
    elif parts.battle.is_open:
        parts.battle.act(CloseBattle())
    elif stage is Stage.RESULT and parts.sessions.practice.last_result.is_asking:
        parts.sessions.practice.last_result.leave()
    elif stage is Stage.RESULT:
        parts.sessions.dismiss()
    elif parts.exam.looks:
        parts.exam.act(LeaveExam())
    elif parts.editor.is_open and not parts.sessions.player.player.playing:
        edit(parts, CloseEditor())
    else:
        parts.sessions.act(EndSession())  # one that waits for its track
        parts.sessions.player.halt()
