"""A battle in the window: its folder, its pictures, what is kept of it; `PlayedBattle` moves it on."""

from collections import deque
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

from station.app.engine_client import EngineClient
from station.app.room_state import PlaceNow, RoomState, Stage
from station.core.errors import DeviceError, StationError
from station.core.events import Hit
from station.core.settings import Settings
from station.core.units import NS_PER_S
from station.engine.messages import Command, EngineEvent, RecordCapture
from station.practice.battle.battle import Battle
from station.practice.battle.battle_result import BattleResult, JudgedTurn
from station.practice.battle.battle_rules import BattleRules
from station.practice.battle.battle_view import BattleView
from station.practice.battle.drummed import drummed
from station.practice.battle.played_battle import PlayedBattle
from station.practice.battle.records.battle_folder import BattleFolder, kept_battle
from station.practice.battle.turn_marks import TurnMarks
from station.practice.headless.live import end
from station.practice.session.cues.listening import Listening
from station.practice.session.device_latency import Latency
from station.practice.session.engine_state import EngineState
from station.render.snapshot import Snapshot
from station.scenes.battle.bar_replay import BarReplay, ReplayedBar
from station.scenes.battle.battle_scene import BattleScene, StageOptions
from station.scenes.battle.cast import cast_of
from station.scenes.battle.kept_views import KeptViews
from station.scenes.battle.motion_chain import Body
from station.scoring.matching.hit_windows import Level

_IN_SIGHT = 64
"""The last strokes that the stage is shown: some seconds of what anybody plays (our choice)."""
_FRAMES_BEFORE = 2
"""When the second frame begins, the first has been drawn."""

Notify = Callable[[str], None]


class BattleSession:
    """`battle` on the window's engine; `player` is who sits at the kit on the stage.

    `notify` hears what a user should read.
    """

    can_be_judged_again = True
    """Whether all that its result is made of is in its capture."""

    def __init__(self, engine: EngineClient, battle: PlayedBattle, player: Body, notify: Notify) -> None:
        self._engine, self._notify = engine, notify
        self._battle = battle
        self._folder: BattleFolder | None = None
        self._view: BattleView | None = None
        self._player = player
        self._scene: BattleScene | None = None  # where nobody looks nobody moves
        self._replay: BarReplay | None = None
        self._struck: deque[Hit] = deque(maxlen=_IN_SIGHT)
        self._frames_until_start = _FRAMES_BEFORE
        self.outcome: BattleResult | None = None
        """All that was played, once it is over."""

    @property
    def rules(self) -> BattleRules:
        """What it is played by."""
        return self._battle.rules

    @property
    def heard(self) -> EngineState:
        """What the engine has said."""
        return self._battle.heard

    # --- while it runs -----------------------------------------------------------------------------------------------

    def begin(self, settings: Settings) -> None:
        """Start the capture; raises `StationError`, and leaves nothing behind then.

        The transport follows once the stage has been drawn: two new figures take a second or two, in which the count-in
        would go by unseen.
        """
        folder = BattleFolder.make(None, settings, self.rules.opponent)
        try:
            self._engine.send(RecordCapture(folder.capture))
        except StationError:
            folder.discard()
            raise
        self._folder = folder

    def handle(self, event: EngineEvent) -> None:
        """Handle one event of the engine."""
        notices = self._battle.heard.notices
        known, self._view = len(notices), None
        self._send(self._battle.handle(event))
        if isinstance(event, Hit) and (stroke := self._in_battle_time(event)) is not None:
            self._struck.append(stroke)
        for notice in notices[known:]:
            self._notify(notice)

    def _in_battle_time(self, stroke: Hit) -> Hit | None:
        """The stroke as the stage wants it; None while the transport stands."""
        played_ns = self.heard.played_ns(stroke)
        return None if played_ns is None else replace(stroke, at_ns=played_ns - self.begins_ns)

    @property
    def begins_ns(self) -> int:
        """The time from the transport's zero at which battle time is 0: after the count-in, however often it came."""
        return self.rules.ground.ns_of_bars(self.rules.count_in_bars) - self._battle.ear.from_ns

    def advance(self, now_ns: int) -> bool:
        """Move on; returns whether it is over."""
        if self.outcome is None:
            self._view = None
            if self._frames_until_start:
                self._frames_until_start -= 1
                if not self._frames_until_start:
                    self._start()
            self._send(self._battle.advance(now_ns))
        return self._battle.over

    def _start(self) -> None:
        self._frames_until_start = 0
        self._send(self._battle.start())

    def turn(self) -> None:
        """Pause, or go on."""
        self._view = None
        self._send(self._battle.resume() if self._battle.paused else self._battle.pause())

    def _send(self, commands: Sequence[Command]) -> None:
        with suppress(DeviceError):  # a dead engine says so itself
            for command in commands:
                self._engine.send(command)

    @property
    def told(self) -> str:
        """What is to be read in place of who is on; empty where nothing is."""
        return ""

    def last_marks(self) -> Mapping[int, TurnMarks] | None:
        """What the last turn of each side is worth, where the view does not have it."""
        return None

    # --- what is seen ------------------------------------------------------------------------------------------------

    def view(self) -> BattleView:
        """How it stands; after its end all is judged once more, once."""
        if self._view is None:
            self._view = self._battle.view()
        return self._view

    def state_in(self, room: RoomState) -> RoomState:
        """The room, and how far the battle is."""
        view, is_playing = self.view(), room.stage is Stage.PLAYING
        if not is_playing:
            return room
        done = max(view.round - 1, 0) / view.rounds
        clock = None if view.at_ns is None else PlaceNow(max(view.at_ns, 0) / NS_PER_S, None, None)
        paused = self._battle.paused
        return replace(room, progress=done, can_pause=paused or view.at_ns is not None, paused=paused, clock=clock)

    def snapshot(self, heard_ns: int | None) -> Snapshot:
        """Both drummers on the stage, now, or where a bar is heard again at `heard_ns` of its replay."""
        if heard_ns is not None and self._replay is not None:
            return self._replay.snapshot(heard_ns / NS_PER_S)
        if self._scene is None:
            self._scene = BattleScene(self.rules, self._cast(), StageOptions(away=self._away))
        snapshot = self._scene.snapshot(self.view(), self._struck)
        return replace(snapshot, hud=replace(snapshot.hud, message=""))  # the board below says more

    def replay(self, turn: JudgedTurn, bar: int) -> Listening:
        """One bar (from 0) of a turn of the battle that is over, slowed down, to be heard and seen on the stage."""
        assert self.outcome is not None, "it is over"
        shown = KeptViews(self.outcome).whole_turns()[turn.planned.index]
        strokes = () if turn.played is None else tuple(turn.played.played)
        self._replay = BarReplay(self.view(), self._cast(), ReplayedBar(replace(shown, played=strokes), bar))
        return Listening(self._replay.cues(), round(self._replay.length_s * NS_PER_S))

    @property
    def _away(self) -> int | None:
        """The side of a player at another station."""
        return None

    def _cast(self) -> Mapping[int, Body]:
        """Who stands on the stage."""
        return cast_of(self.rules, self._player)

    # --- the end -----------------------------------------------------------------------------------------------------

    @property
    def folder(self) -> Path | None:
        """Where it is kept, None before it began, and where nobody has played."""
        return None if self._folder is None else self._folder.path

    def judged_as(self, level: Level) -> BattleResult:
        """The battle that is over, judged by other windows from what was kept of it; raises `BadInput`."""
        assert self.folder is not None, "it was begun"
        return kept_battle(self.folder, level)

    def finish(self) -> StationError | None:
        """End it, judge all once more and keep it; returns what went wrong."""
        assert self._folder is not None, "it was begun"
        if self._frames_until_start:
            self._start()  # what is kept has a beginning
        fault = end(self._engine, self._battle) if self._engine.alive else None
        self._ended()
        self.outcome, self._view = self._battle.result(), None
        try:
            self._keep(self._folder, self.outcome)
        except StationError as refused:
            return refused
        return fault

    def _ended(self) -> None:
        """What else its end means."""

    def _keep(self, folder: BattleFolder, outcome: BattleResult) -> None:
        """Write what came of it, unless nobody has played; raises `StationError`."""
        if not outcome.is_played:
            self._folder = None
            folder.discard()
            return
        self._notify(folder.write(outcome) or "")


NewBattle = Callable[[EngineClient, Latency, Body, Notify], BattleSession]
"""Makes a battle on the window's engine and devices, with whoever sits at the kit."""


def battle_here(rules: BattleRules) -> NewBattle:
    """A battle by these rules, all of it at this station."""
    return lambda engine, latency, player, notify: BattleSession(
        engine, Battle(rules, drummed, latency), player, notify
    )
