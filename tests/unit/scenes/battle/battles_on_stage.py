"""A small battle in repeat mode for tests of the stage: a call of two bars and the answer to it, twice."""

from dataclasses import replace

import numpy as np

from station.core.events import Hit
from station.core.pieces import Limb, Piece, Zone
from station.core.units import PPQ
from station.music.score import Note, Score
from station.practice.battle.battle_rules import BattleMode, BattleRules
from station.practice.battle.battle_view import BattleView, Doing, SideView, TurnView
from station.practice.battle.ground import Ground
from station.practice.battle.phrase import Phrase
from station.practice.battle.turn_plan import TurnKind

GROUND = Ground(100.0)
RULES = BattleRules(GROUND, BattleMode.REPEAT, opponent="pocket", rounds=4)
BAR_NS = GROUND.ns_of_bars(1)


def phrase(bars: int, fill: tuple[Piece, ...] = (Piece.SNARE, Piece.TOM_1)) -> Phrase:
    """Eighths on the hi-hat with a kick and a backbeat; the last beat of each bar is a fill; it lands on the crash."""
    notes = []
    for bar in range(bars):
        start = bar * GROUND.bar_ticks
        notes += [Note(start + k * PPQ // 2, Piece.HIHAT, Zone.BOW, limb=Limb.RIGHT_HAND) for k in range(6)]
        notes += [Note(start, Piece.KICK, limb=Limb.RIGHT_FOOT), Note(start + PPQ, Piece.SNARE, limb=Limb.LEFT_HAND)]
        hands = (Limb.RIGHT_HAND, Limb.LEFT_HAND)
        notes += [Note(start + 3 * PPQ + k * PPQ // 2, fill[k], limb=hands[k]) for k in range(2)]
    landing = Score.from_notes([Note(0, Piece.CRASH_1, Zone.EDGE, limb=Limb.RIGHT_HAND)], GROUND.tempo_map)
    return Phrase(Score.from_notes(notes, GROUND.tempo_map), landing.notes)


def played(of: Phrase, late_ms: float = 0.0) -> tuple[Hit, ...]:
    """Every stroke of a phrase, as late as that."""
    return tuple(
        Hit(int(at_ns + late_ms * 1e6), Piece(int(note["piece"])), Zone(int(note["zone"])), int(note["velocity"]))
        for at_ns, note in zip(of.score.onset_ns, of.score.notes, strict=True)
    )


def turns(count: int = 4, bars: int = 2) -> tuple[TurnView, ...]:
    """Calls and answers in turn, all played."""
    made, said = [], phrase(bars)
    for index in range(count):
        kind, side = (TurnKind.ANSWER, 1) if index % 2 else (TurnKind.CALL, 0)
        if not index % 2:
            said = phrase(bars, (Piece.SNARE, Piece.TOM_1) if index % 4 else (Piece.TOM_1, Piece.FLOOR_TOM_1))
        turn = TurnView(index, index // 2 + 1, side, kind, index * bars * BAR_NS, bars, said, None, 5)
        made.append(replace(turn, played=played(said) if side else ()))
    return tuple(made)


SIDES = (SideView("pocket", True, None, None, 1), SideView("Robin", False, 180.0, 2, 0))


def view_at(at_ns: int, known: tuple[TurnView, ...], winner: int | None = None) -> BattleView:
    """The view of a time, of turns that are all known and as far as they were played."""
    begun = [turn for turn in known if turn.start_ns <= at_ns]
    last = begun[-1] if begun else None
    runs = last is not None and at_ns < last.start_ns + last.bars * BAR_NS
    doing = Doing.COUNT_IN if last is None else Doing.CALL if last.kind is TurnKind.CALL else Doing.ANSWER
    heard = tuple(
        replace(turn, played=tuple(hit for hit in turn.played if hit.at_ns + turn.start_ns <= at_ns)) for turn in known
    )
    return BattleView(
        RULES,
        at_ns,
        doing if runs or last is None else Doing.OVER,
        last.index if runs and last is not None else None,
        heard,
        SIDES,
        last.round if last is not None else 0,
        5,
        "",
        winner,
    )


def all_hits(known: tuple[TurnView, ...]) -> list[Hit]:
    """Everything that was played, in battle time."""
    hits = [replace(hit, at_ns=hit.at_ns + turn.start_ns) for turn in known for hit in turn.played]
    return sorted(hits, key=lambda hit: hit.at_ns)


def speeds(places: np.ndarray, hz: float) -> tuple[np.ndarray, np.ndarray]:
    """Speeds (n − 1,) and accelerations (n − 2,) of points (n, 3) that were taken `hz` times a second."""
    return (
        np.linalg.norm(np.diff(places, axis=0), axis=1) * hz,
        np.linalg.norm(np.diff(places, n=2, axis=0), axis=1) * hz * hz,
    )
