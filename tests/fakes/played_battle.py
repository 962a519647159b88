"""A battle that is played by hand: strokes at times of our choosing, at any frame rate, and what the engine is sent.

Session time begins with the transport's zero at 1 s; strokes arrive `ARRIVAL_NS` after they were played.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from station.core.events import Hit
from station.core.pieces import Piece, Zone
from station.core.units import NS_PER_MS, NS_PER_S, PPQ
from station.engine.messages import AddCues, Bus, Command, EngineEvent, Play, Started
from station.music.score import Note, Score
from station.practice.battle.battle import Battle
from station.practice.battle.ground import Ground
from station.practice.battle.phrase import Phrase
from station.practice.battle.phrase_request import PhraseRequest
from station.practice.battle.turn_plan import PlannedTurn, TurnKind

ZERO_NS = NS_PER_S
ARRIVAL_NS = 12 * NS_PER_MS
Stroke = tuple[float, Piece]
"""When in a turn, in ms, and what."""


def phrase(ground: Ground, *strokes: tuple[float, Piece], bars: int = 1, landing: bool = False) -> Phrase:
    """A phrase of strokes at beats from 0."""
    notes = [Note(round(beat * PPQ), piece) for beat, piece in strokes]
    score = Score.from_notes(notes, ground.tempo_map, bars * ground.bar_ticks)
    if not landing:
        return Phrase(score)
    return Phrase(score, Score.from_notes([Note(0, Piece.CRASH_1)], ground.tempo_map).notes)


def quarters(request: PhraseRequest) -> Phrase:
    """A bar of quarters on snare and kick, whatever is asked."""
    pieces = (Piece.SNARE, Piece.KICK) * 2
    return phrase(request.rules.ground, *enumerate(pieces))


def as_written(turn: PlannedTurn) -> list[Stroke]:
    """What a student plays who makes no mistake."""
    assert turn.phrase is not None
    score = turn.phrase.score
    return [(at / NS_PER_MS, Piece(piece)) for at, piece in zip(score.onset_ns, score.notes["piece"], strict=True)]


def nothing(turn: PlannedTurn) -> list[Stroke]:
    """What a student plays who does not play."""
    del turn
    return []


@dataclass
class PlayedBattle:
    """`plays` says what is played in an answer; `events` come at session times besides."""

    battle: Battle
    plays: Callable[[PlannedTurn], Iterable[Stroke]] = as_written
    frames_per_s: float = 40.0
    device: Callable[[PlannedTurn], str] = lambda turn: "kit"
    events: list[tuple[int, EngineEvent]] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.sent: list[tuple[int, Command]] = [(0, command) for command in self.battle.start()]
        self.zero_ns = ZERO_NS
        self._coming: list[tuple[int, EngineEvent]] = [(ZERO_NS, Started(ZERO_NS)), *self.events]
        self._played = self._frame = 0

    @property
    def count_in_ns(self) -> int:
        return self.battle.rules.ground.ns_of_bars(self.battle.rules.count_in_bars)

    def until(self, session_ns: int | None = None) -> "PlayedBattle":
        """Let it be played until its end, or a session time."""
        while not self.battle.over and (session_ns is None or self.now_ns < session_ns):
            self._frame += 1
            self._play()
            now_ns = self.now_ns
            due = [event for at_ns, event in self._coming if at_ns <= now_ns]
            self._coming = [(at_ns, event) for at_ns, event in self._coming if at_ns > now_ns]
            self.sent += [(now_ns, command) for command in self.battle.update(now_ns, due)]
        return self

    @property
    def now_ns(self) -> int:
        return round(self._frame * NS_PER_S / self.frames_per_s)

    def _play(self) -> None:
        for turn in self.battle.plan[self._played :]:
            self._played += 1
            if turn.kind is TurnKind.ANSWER:
                start_ns = self.zero_ns + self.count_in_ns + self.battle.rules.ground.ns_of_bars(turn.first_bar)
                strokes = [(start_ns + round(ms * NS_PER_MS), piece) for ms, piece in self.plays(turn)]
                self._coming += [(at + ARRIVAL_NS, hit(at, piece, self.device(turn))) for at, piece in strokes]
        self._coming.sort(key=lambda coming: coming[0])

    @property
    def cues(self) -> NDArray[np.void]:
        """All that sounds, in battle time, in the order in which it was sent."""
        cues = np.concatenate([command.cues for _, command in self.sent if isinstance(command, Play | AddCues)])
        cues["at_ns"] -= self.count_in_ns
        return cues

    @property
    def clicks_ns(self) -> list[int]:
        """When it clicks, in battle time."""
        cues = self.cues
        return sorted(cues["at_ns"][cues["bus"] == Bus.CLICK].tolist())


def hit(at_ns: int, piece: Piece, device: str = "kit") -> Hit:
    """A stroke."""
    return Hit(at_ns, piece, Zone.HEAD, 90, device=device)
