"""Two stations behind their windows on one network, met over sockets of loopback and moved on by a clock by hand."""

from dataclasses import dataclass, field, replace
from pathlib import Path

from station.app.actions.action import Show
from station.app.actions.battle_actions import BeginBattle, ChooseBattle, OpenBattle
from station.app.battle.battle_shown import BattleShown, BattleStage
from station.app.sessions.launch import Launch
from station.app.sessions.linked_session import LinkedSession
from station.app.settings.chosen_battle import ChosenBattle, People
from station.core.events import Hit
from station.core.pieces import Piece, Zone
from station.core.units import NS_PER_MS, NS_PER_S
from station.drills.library import find_lesson
from station.engine.messages import Play, Started
from station.practice.battle.battle_rules import BattleMode
from station.practice.battle.ground import Ground
from station.practice.battle.turn_plan import TurnKind
from station.practice.session.plan import PlanOptions, plan_practice
from station.practice.session.session import LEAD_IN_NS
from tests.fakes.stations import Line, station_on, store_with

PLAN = plan_practice(find_lesson("rock-1"), PlanOptions(loops=1, demonstrations=0))
STEP_NS = 20 * NS_PER_MS
LOOPBACK = "127.0.0.1"
ANY_PORT = ChosenBattle(
    BattleMode.IMPROVISE, ground=Ground(240.0), bars=1, rounds=1, seed=1, people=People.NETWORK, port="0"
)
"""A short battle, hosted at whatever port is free."""


@dataclass
class End:
    """A station behind its window, somebody at its kit who plays a quarter note a beat, and its engine by hand."""

    folder: Path
    name: str
    line: Line = field(default_factory=Line)

    def __post_init__(self) -> None:
        store = store_with(self.folder, student=self.name)
        self.station = station_on([self.line], store, Launch(PLAN))
        self.station.dispatch(Show(picture=False))
        self.station.dispatch(OpenBattle())
        self._heard = 0
        self._answered: set[int] = set()
        self._hits: list[Hit] = []
        self.said: list[str] = []

    @property
    def shown(self) -> BattleShown:
        return self.station.view().battle

    def address(self) -> str:
        """Where the page says that it waits, on this computer."""
        port = self.shown.friend.waits[-1].rpartition(":")[2]
        return f"{LOOPBACK}:{port}"

    @property
    def session(self) -> LinkedSession:
        battle = self.station.parts.sessions.practice.battle
        assert isinstance(battle, LinkedSession)
        return battle

    def begin(self, **chosen: object) -> None:
        self.station.dispatch(ChooseBattle(replace(ANY_PORT, **chosen)))  # type: ignore[arg-type] # what a test chooses
        self.station.dispatch(BeginBattle())

    def step(self, now_ns: int) -> None:
        for command in self.line.heard[self._heard :]:
            if isinstance(command, Play):
                self.line.says.append(Started(now_ns + LEAD_IN_NS))
        self._heard = len(self.line.heard)
        self.line.says += [hit for hit in self._hits if hit.at_ns <= now_ns]
        self._hits = [hit for hit in self._hits if hit.at_ns > now_ns]
        self.station.update(now_ns)
        if self.shown.stage is BattleStage.PLAYING:
            headline = self.shown.board.headline
            self.said += [headline] if self.said[-1:] != [headline] else []
            self._practise()

    def _practise(self) -> None:
        zero_ns, view = self.session.heard.zero_ns, self.session.view()
        for turn in view.turns:
            if zero_ns is None or turn.kind is not TurnKind.ANSWER or turn.index in self._answered:
                continue
            self._answered.add(turn.index)
            begin_ns = zero_ns + self.session.begins_ns + turn.start_ns
            beats = range(turn.bars * self.session.rules.ground.beats)
            beat_ns = self.session.rules.beat_ns
            self._hits += [Hit(begin_ns + beat * beat_ns, Piece.SNARE, Zone.HEAD, 90, device="kit") for beat in beats]


@dataclass
class Room:
    """Both ends on one clock."""

    ann: End
    ben: End
    now_ns: int = NS_PER_S

    def run(self, seconds: float, *ends: End) -> None:
        """Let so much time pass at both, or at these ends alone."""
        until_ns = self.now_ns + round(seconds * NS_PER_S)
        while self.now_ns < until_ns:
            self.now_ns += STEP_NS
            for end in ends or (self.ann, self.ben):
                end.step(self.now_ns)

    def run_until(self, stage: BattleStage, *ends: End) -> None:
        """Let time pass until both are so far."""
        until_ns = self.now_ns + 60 * NS_PER_S
        while any(end.shown.stage is not stage for end in ends or (self.ann, self.ben)):
            self.run(0.1)
            assert self.now_ns < until_ns, [end.shown for end in (self.ann, self.ben)]

    def address(self) -> str:
        """Where Ann's page says that she waits, on this computer."""
        return self.ann.address()

    def meet(self, **chosen: object) -> None:
        """Ann hosts, Ben joins, and it begins."""
        self.ann.begin(**chosen)
        self.ben.begin(joins=True, address=self.address())
        self.run_until(BattleStage.PLAYING)
