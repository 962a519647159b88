"""Two stations and the network between them, all on one clock that is moved by hand.

The network is a proxy of the tests' own: it delays, loses, reorders and cuts, with chance of a fixed seed. A station
is a battle, a line, and somebody who plays: the engine's part is to start the transport and to tell the strokes.
"""

import random
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from heapq import heappop, heappush
from itertools import count

from station.core.events import Hit
from station.core.pieces import Piece, Zone
from station.core.units import NS_PER_MS, NS_PER_S, PPQ
from station.engine.messages import Command, EngineEvent, Play, Started, Stop
from station.music.score import Note, Score
from station.practice.battle.battle_rules import BattleRules
from station.practice.battle.link.link_handshake import Address, Door, Knock
from station.practice.battle.link.link_line import LinkLine
from station.practice.battle.link.link_messages import Card, Hello, encoded
from station.practice.battle.link.linked_battle import LinkedBattle
from station.practice.battle.link.linked_lobby import GuestLobby, HostLobby
from station.practice.battle.phrase import Phrase
from station.practice.battle.phrase_request import Asked, PhraseRequest
from station.practice.battle.turn_plan import PlannedTurn, TurnKind
from station.practice.session.session import LEAD_IN_NS
from station.scoring.matching.hit_windows import Level

HOST, GUEST = ("127.0.0.1", 34117), ("127.0.0.1", 50000)
STEP_NS = 40 * NS_PER_MS
Player = Callable[[PlannedTurn, random.Random], Iterable[tuple[int, Piece, int]]]
"""Whoever plays: of a turn of theirs the strokes, each ns of turn time, piece and velocity."""


def drum(request: PhraseRequest) -> Phrase:
    """A drummer: a kick and a snare to keep the time, and an offbeat more a step where it is to be repeated."""
    ground = request.rules.ground
    beats = range(request.bars * ground.bar_ticks // PPQ)
    notes = [Note(beat * PPQ, Piece.SNARE if beat % 2 else Piece.KICK) for beat in beats]
    if request.asked is Asked.TO_REPEAT:
        assert request.step is not None
        more = request.rng.choice(len(beats), min(request.step, len(beats)), replace=False).tolist()
        notes += [Note(beat * PPQ + PPQ // 2, Piece.HIHAT) for beat in more]
    return Phrase(Score.from_notes(notes, ground.tempo_map, request.bars * ground.bar_ticks))


def repeats(spread_ms: float, dropped: float = 0.0) -> Player:
    """Somebody who repeats what they hear, so much off the beat, and leaves out a share of it."""

    def play(turn: PlannedTurn, chance: random.Random) -> Iterable[tuple[int, Piece, int]]:
        assert turn.phrase is not None
        score = turn.phrase.score
        for at_ns, note in zip(score.onset_ns.tolist(), score, strict=True):
            if chance.random() >= dropped:
                yield at_ns + round(chance.gauss(0, spread_ms) * NS_PER_MS), note.piece, note.velocity

    return play


def improvises(spread_ms: float, pieces: tuple[Piece, ...]) -> Player:
    """Somebody who fills four bars of four quarters at 120 bpm with eighths and rests, anew each time."""

    def play(turn: PlannedTurn, chance: random.Random) -> Iterable[tuple[int, Piece, int]]:
        for eighth in range(8 * turn.bars):
            if chance.random() < 0.7:
                off_ns = round(chance.gauss(0, spread_ms) * NS_PER_MS)
                yield eighth * NS_PER_S // 4 + off_ns, chance.choice(pieces), chance.randint(20, 120)

    return play


@dataclass
class Network:
    """The proxy between the two: whatever is sent arrives `delay_ns` later, unless it is lost or the line is cut."""

    seed: int = 1
    delay_ns: int = 0
    loss: float = 0.0
    cuts: tuple[tuple[int, int], ...] = ()
    carried: int = 0
    lost: int = 0
    _air: list[tuple[int, int, bytes, Address, Address]] = field(default_factory=list)

    def __post_init__(self) -> None:
        self._chance, self._number = random.Random(self.seed), count()

    def send(self, data: bytes, source: Address, target: Address, now_ns: int) -> None:
        """Take a datagram; a fifth of them are late by up to as much again, and so overtaken."""
        if self._chance.random() < self.loss or self.is_cut(now_ns):
            self.lost += 1
            return
        self.carried += 1
        late_ns = self.delay_ns * (1 + self._chance.random() * (self._chance.random() < 0.2))
        heappush(self._air, (now_ns + int(late_ns), next(self._number), data, source, target))

    def is_cut(self, now_ns: int) -> bool:
        """Whether nothing gets through now."""
        return any(begin <= now_ns < end for begin, end in self.cuts)

    def arrived(self, now_ns: int) -> Iterable[tuple[bytes, Address, Address]]:
        """What has arrived by now."""
        while self._air and self._air[0][0] <= now_ns:
            yield heappop(self._air)[2:]


class Station:
    """One end: its line, its lobby, then its battle, and who plays there."""

    def __init__(self, lobby: HostLobby | GuestLobby, line: LinkLine, player: Player, seed: int) -> None:
        self.line, self.lobby, self.player = line, lobby, player
        self.battle: LinkedBattle | None = None
        self.standings: list[tuple[int, int]] = []
        """When the transport stopped, and went on."""
        self._chance = random.Random(seed)
        self._zero_ns = 0  # session time of the battle's first downbeat
        self._planned = 0
        self._hits: list[tuple[int, int, Hit]] = []
        self._number = count()
        self._events: list[EngineEvent] = []
        self._stopped_ns: int | None = None

    def step(self, now_ns: int) -> None:
        """Move on to the present."""
        if self.battle is None:
            agreed = self.lobby.advance(now_ns)
            if agreed is not None:
                self.battle = LinkedBattle(agreed, self.line, drum)
                self.battle.ear.advance(now_ns)
                self._obey(self.battle.start(), now_ns)
            return
        events, self._events = self._events, []
        while self._hits and self._hits[0][0] <= now_ns:
            events.append(heappop(self._hits)[2])
        self._obey(self.battle.update(now_ns, events), now_ns)
        self._practise()

    def _obey(self, commands: Iterable[Command], now_ns: int) -> None:
        assert self.battle is not None
        for command in commands:
            if isinstance(command, Play):
                zero_ns = now_ns + LEAD_IN_NS
                self._events.append(Started(zero_ns))
                counted_ns = self.battle.rules.ground.ns_of_bars(self.battle.rules.count_in_bars)
                self._zero_ns = zero_ns + counted_ns - self.battle.ear.from_ns
                if self._stopped_ns is not None:
                    self.standings.append((self._stopped_ns, now_ns))
            elif isinstance(command, Stop):
                self._stopped_ns = now_ns
        self._practise()

    def _practise(self) -> None:
        """Whoever plays here sees what comes, and will play it."""
        assert self.battle is not None
        for turn in self.battle.plan[self._planned :]:
            if turn.kind is TurnKind.ANSWER:
                start_ns = self._zero_ns + self.battle.rules.ground.ns_of_bars(turn.first_bar)
                for at_ns, piece, velocity in self.player(turn, self._chance):
                    hit = Hit(start_ns + at_ns, piece, Zone.HEAD, velocity, device="kit")
                    heappush(self._hits, (hit.at_ns, next(self._number), hit))
        self._planned = len(self.battle.plan)


@dataclass
class TwoStations:
    """The host and the guest, and the network between them."""

    rules: BattleRules
    network: Network
    players: tuple[Player, Player]
    host_begins: bool = True
    names: tuple[str, str] = ("Ann", "Ben")
    levels: tuple[Level, Level] = (Level.INTERMEDIATE, Level.INTERMEDIATE)
    now_ns: int = 0
    dice: int = 2

    def __post_init__(self) -> None:
        ours, theirs = (
            Hello(f"{name}'s room", name, level, "0.1.0") for name, level in zip(self.names, self.levels, strict=True)
        )
        door = Door(lambda is_busy: encoded(Card("Ann's room", "a battle", is_busy)), random.Random(1).randbytes)
        knock = Knock(HOST, self.now_ns, random.Random(self.dice).randbytes)
        host, guest = LinkLine(door), LinkLine(knock)
        self.host = Station(HostLobby(host, ours, self.rules, self.host_begins), host, self.players[0], 11)
        self.guest = Station(GuestLobby(guest, knock, theirs, self.rules), guest, self.players[1], 12)
        self.ends: dict[Address, Station] = {HOST: self.host, GUEST: self.guest}

    def run(self, seconds: float, ends_with_them: bool = True) -> None:
        """Let the time pass, or until both battles are over."""
        until_ns = self.now_ns + round(seconds * NS_PER_S)
        while self.now_ns < until_ns and not (ends_with_them and self.is_over):
            self.now_ns += STEP_NS
            for data, source, target in self.network.arrived(self.now_ns):
                if target in self.ends:
                    self.ends[target].line.handle(data, source, self.now_ns)
            for address, station in list(self.ends.items()):
                station.step(self.now_ns)
                for data, target in station.line.due(self.now_ns):
                    self.network.send(data, address, target, self.now_ns)

    @property
    def is_over(self) -> bool:
        """Whether both battles have ended, as far as both stations are there."""
        battles = [station.battle for station in self.ends.values()]
        return all(battle is not None and battle.over for battle in battles)
