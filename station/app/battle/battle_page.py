"""The battle's page in the window: what is chosen, the battle that runs, what came of it.

Closed → chosen → played → over → once more, or chosen again. A battle takes a session's place: whoever begins something
else ends it, and the battle that ran is kept.
"""

from collections.abc import Callable
from concurrent.futures import Executor, Future
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import assert_never

from station.app.actions.battle_actions import (
    BattleAction,
    BeginBattle,
    CallOff,
    ChooseBattle,
    CloseBattle,
    FilmBattle,
    JudgeBattle,
    OpenBattle,
    PractiseFailed,
    ReplayBest,
    TurnLeaf,
)
from station.app.battle.battle_choice import battle_choice
from station.app.battle.battle_shown import BattleResultShown, BattleShown, BattleStage
from station.app.battle.best_moment import best_moment, moment_words
from station.app.battle.board_words import board_of, names_of
from station.app.battle.failed_phrase import keep_phrase
from station.app.battle.friend_line import FriendLine, address_in
from station.app.battle.friend_meeting import FriendMeeting
from station.app.battle.result_words import failed_turn, result_of, winner_words
from station.app.sessions.battle_session import BattleSession, battle_here
from station.app.sessions.linked_session import LinkedSession, battle_linked
from station.app.sessions.screen_choice import ScreenChoice
from station.app.sessions.session_control import SessionControl
from station.app.settings.chosen_battle import ChosenBattle, chosen_rules, port_of
from station.app.settings.settings_store import SettingsStore
from station.core.errors import BadInput, DeviceError
from station.core.settings import setting_source
from station.practice.battle.battle_result import BattleResult
from station.practice.battle.battle_rules import BattleMode, BattleRules
from station.practice.battle.link.linked_rules import Agreed
from station.practice.battle.link.linked_station import LinkedStation
from station.practice.battle.records.battle_report import played_on_words
from station.practice.battle.records.earlier_rounds import after_earlier
from station.practice.battle.vocabulary.lesson_bars import lesson_bars
from station.practice.history.student_history import StudentHistory
from station.practice.records.memory import LevelMemory
from station.practice.session.cues.click_options import parse_click
from station.practice.session.cues.listening import Listening
from station.scoring.matching.hit_windows import Level


@dataclass(frozen=True, slots=True)
class BattleSurroundings:
    """What the page asks of the station: the `kits` that are connected.

    `make_ready` ends what else hears the kit, raising `StationError` where it cannot; `show_lessons` shows what is
    chosen of them again, `open_lesson` chooses the one in a file; `film` makes the
    video of the battle in a folder, raising `DeviceError` while another is made; at `meeting` a friend on the network
    is met.
    """

    kits: Callable[[], tuple[str, ...]]
    make_ready: Callable[[], None]
    show_lessons: Callable[[], None]
    open_lesson: Callable[[Path], None]
    film: Callable[[Path], None]
    meeting: FriendMeeting = field(default_factory=FriendMeeting)


class BattlePage:
    """The battles of the student of `store`, played in `sessions`; `reader` reads lessons' bars while one chooses."""

    def __init__(
        self, store: SettingsStore, sessions: SessionControl, around: BattleSurroundings, reader: Executor
    ) -> None:
        self._store, self._sessions, self._around, self._reader = store, sessions, around, reader
        self._reading: Future[object] | None = None
        self._setup = ChosenBattle()
        self._is_open = False
        self._leaf = 0
        self._level_of = ""  # the student by whose level is judged
        self._told: tuple[BattleResult, BattleResultShown] | None = None
        self._replay: Listening | None = None
        self._friend = FriendLine(self._begin_linked, around.meeting)

    # --- what is shown -----------------------------------------------------------------------------------------------

    @property
    def is_open(self) -> bool:
        """Whether a battle is chosen, runs, or its result is shown."""
        return self.stage is not BattleStage.CLOSED

    @property
    def stage(self) -> BattleStage:
        """How far it is."""
        practice = self._sessions.practice
        if practice.is_battle:
            return BattleStage.PLAYING if practice.is_playing else BattleStage.OVER
        return BattleStage.CHOOSING if self._is_open else BattleStage.CLOSED

    @property
    def is_lively(self) -> bool:
        """Whether somebody on the network may be heard at any moment."""
        return self._friend.is_lively

    def view(self) -> BattleShown:
        """What is shown; nothing where no battle is."""
        stage, battle = self.stage, self._sessions.practice.battle
        if stage is BattleStage.CLOSED:
            return BattleShown()
        shown = BattleShown(stage, self._setup, self._store.now.student)
        if stage is BattleStage.CHOOSING:
            return replace(shown, fault=self._fault(), friend=self._friend.view())
        assert battle is not None, "it runs or is over"
        if stage is BattleStage.PLAYING:
            return replace(shown, board=board_of(battle.view(), battle.told, battle.last_marks()))
        replays = self._replay is not None and self._sessions.is_listening_to(self._replay)
        return replace(shown, result=self._result(battle), replays=replays)

    def choice(self) -> ScreenChoice | None:
        """What is to be chosen now by pads, keys or the mouse."""
        if not self.is_open:
            return None
        there = frozenset(self._sessions.practice.session.plan.kit.pieces)
        return battle_choice(self.view(), self._leaf, there, self._store.now.kicks_start)

    def _result(self, battle: BattleSession) -> BattleResultShown:
        """What came of the battle that is over; put into words once."""
        assert battle.outcome is not None, "it is over"
        if self._told is None or self._told[0] is not battle.outcome:
            folder = "" if battle.folder is None else str(battle.folder)
            best = best_moment(battle.outcome)
            names = names_of(battle.outcome.rules)
            words = "" if best is None else moment_words(best, names[best.turn.planned.side])
            shown = replace(result_of(battle.outcome, folder), best=words)
            if not folder:
                shown = replace(shown, judged_as=None, films=False)
            if isinstance(battle, LinkedSession):
                shown = replace(shown, told=battle.how_it_ended, judged_as=None, films=False)
            self._told = battle.outcome, shown
        return self._told[1]

    def _fault(self) -> str:
        """Why what is chosen cannot begin; empty where it can."""
        try:
            self._rules()
            if self._setup.is_guest:
                address_in(self._setup)
            elif self._setup.is_linked:
                port_of(self._setup)
        except BadInput as fault:
            return fault.fault
        return ""

    def _rules(self) -> BattleRules:
        """What was chosen; raises `BadInput`."""
        click = parse_click(self._store.now.click_pattern, setting_source("click_pattern"))
        return chosen_rules(self._setup, self._store.now.student, self._around.kits(), click)

    # --- as time goes by ---------------------------------------------------------------------------------------------

    def advance(self, now_ns: int) -> None:
        """What else is begun takes the page's place; a friend who is there begins. Raises `StationError`."""
        practice = self._sessions.practice
        if practice.is_playing and not practice.is_battle:
            self._is_open = False
        stage = self.stage
        if stage is BattleStage.CHOOSING:
            self._follow_student()
        elif self._friend.waits:
            self._friend.call_off()
        looks = stage is BattleStage.CHOOSING and self._setup.is_guest
        self._friend.advance(now_ns, looks, stage is BattleStage.PLAYING)

    # --- what the user does ------------------------------------------------------------------------------------------

    def act(self, action: BattleAction) -> str:
        """Do what the user asks; returns a line for them, empty for none. Raises `StationError`."""
        match action:
            case OpenBattle():
                self._open()
            case ChooseBattle(setup):
                if not self._friend.waits:  # what a friend was promised stays
                    self._setup = setup
                    self._read_ahead()
            case TurnLeaf():
                self._leaf += 1
            case BeginBattle():
                self._begin()
            case CallOff():
                self._friend.call_off()
            case CloseBattle():
                self._back()
            case PractiseFailed():
                return self._practise_failed()
            case JudgeBattle(level):
                return self._judge(level)
            case ReplayBest():
                self._see_best()
            case FilmBattle():
                return self._film()
            case _:
                assert_never(action)
        return ""

    def _open(self) -> None:
        if self._sessions.practice.is_playing:
            raise DeviceError("end the session first: a battle takes its place")
        self._sessions.dismiss()
        self._sessions.look()
        self._is_open, self._leaf = True, 0
        self._read_ahead()
        self._follow_student()

    def _follow_student(self) -> None:
        """Judge by the student's level until they choose another here."""
        now = self._store.now
        if self._level_of != now.student:
            level = LevelMemory(StudentHistory.of(now)).usual()
            self._level_of, self._setup = now.student, replace(self._setup, level=level)

    def _read_ahead(self) -> None:
        """Have the bars read that the phrases may come from, which takes seconds at first."""
        if self._setup.mode is BattleMode.REPEAT:
            ground = self._setup.ground
            self._reading = self._reader.submit(lesson_bars, ground.beats, ground.unit, ground.feel)

    def _begin(self) -> None:
        if self._reading is not None:
            self._reading.result()
        if self._setup.is_linked:
            self._ask_friend()
            return
        rules = after_earlier(self._rules(), self._store.now, self._setup.is_fair)
        self._around.make_ready()
        self._sessions.battle(battle_here(rules))
        self._is_open, self._leaf = True, 0

    def _ask_friend(self) -> None:
        """Host, or join: the battle begins once a friend is there."""
        if self._friend.waits or self.stage is BattleStage.PLAYING:
            return
        rules = after_earlier(self._rules(), self._store.now, has_handicap=False)
        self._around.make_ready()
        if self.stage is BattleStage.OVER:
            self._sessions.leave_battle()
        self._is_open, self._leaf = True, 0
        self._friend.ask(self._setup, rules)

    def _begin_linked(self, station: LinkedStation, agreed: Agreed) -> None:
        """A friend is there."""
        self._around.make_ready()
        self._sessions.battle(battle_linked(station, agreed))

    def _practise_failed(self) -> str:
        """Make a lesson of the phrase that went worst, and choose it; returns what it is called."""
        outcome = self._outcome()
        turn = None if outcome is None else failed_turn(outcome)
        if turn is None or turn.planned.phrase is None:
            return ""
        title = f"{self._setup.drummer.title}: a phrase of round {turn.planned.round}"
        self._around.open_lesson(keep_phrase(turn.planned.phrase, title, self._store.now.own_lessons_dir))
        self.leave()
        return f"{title} is among your lessons"

    def _see_best(self) -> None:
        """See and hear the best moment again, or end that; raises `DeviceError`."""
        battle = self._sessions.practice.battle
        if self._replay is not None and self._sessions.is_listening_to(self._replay):
            self._sessions.quiet()
        elif battle is not None and battle.outcome is not None and (best := best_moment(battle.outcome)) is not None:
            self._replay = battle.replay(best.turn, best.bar)
            self._sessions.listen_to(self._replay)

    def _film(self) -> str:
        """Have the battle that is over filmed; returns a line for the user. Raises `DeviceError`."""
        battle = self._sessions.practice.battle
        if self.stage is not BattleStage.OVER or battle is None or battle.folder is None:
            return ""
        self._around.film(battle.folder)
        return "the video is being filmed; you may go on (Export cancels it)"

    def _outcome(self) -> BattleResult | None:
        """The battle that is over, as it is judged now."""
        return self._told[0] if self.stage is BattleStage.OVER and self._told is not None else None

    def _judge(self, level: Level) -> str:
        """Judge the battle that is over by other windows; what is kept stays. Raises `BadInput`."""
        battle = self._sessions.practice.battle
        if self.stage is not BattleStage.OVER or battle is None or battle.outcome is None or battle.folder is None:
            return ""
        if not battle.can_be_judged_again:
            raise DeviceError("the friend's strokes are at their station: it cannot be judged again here")
        was, judged = winner_words(battle.outcome), battle.judged_as(level)
        now = winner_words(judged)
        told = f"Judged as {level.words}: {'the same side wins' if now == was else f'{now}; it was: {was}'}"
        if judged.played_on_after is not None:
            told += f". {played_on_words(judged)}"
        best = self._result(battle).best
        self._told = battle.outcome, replace(result_of(judged, str(battle.folder)), told=told, best=best)
        return ""

    def _back(self) -> None:
        """From a result to what is chosen, from there to the lessons."""
        if self.stage is BattleStage.OVER:
            self._sessions.leave_battle()
            self._leaf = 0
            if not self._is_open:  # it was one of another day
                self._around.show_lessons()
        elif self._friend.waits:
            self._friend.call_off()
        elif self.stage is BattleStage.CHOOSING:
            self.leave()

    def leave(self) -> None:
        """Back to the lessons, wherever it is; one that runs is ended and kept."""
        if not self.is_open:
            return
        self._friend.call_off()
        self._sessions.practice.end()
        self._sessions.leave_battle()
        self._is_open = False
        self._around.show_lessons()

    def close(self) -> None:
        """The window closes; a battle that ran is over and kept already."""
        self._friend.close()
