"""What stands below the stage: the phrase that is played or repeated with its marks, or strokes that roll by."""

from collections.abc import Mapping
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from station.core.events import Hit
from station.core.units import NS_PER_S
from station.music.judgement import OF_LONE_HITS, Judgement
from station.music.performance import Performance
from station.music.score import Score
from station.practice.battle.battle_rules import BattleRules
from station.practice.battle.battle_view import TurnView
from station.practice.battle.ground import Ground
from station.practice.battle.phrase import Phrase
from station.practice.battle.turn_plan import TurnKind
from station.render.snapshot import ExtraHit, Strip, mark, no_marks


def score_fields(rules: BattleRules, turn: TurnView | None, at_ns: int) -> Mapping[str, Any]:
    """The fields of a snapshot that say what music is shown at a battle time; `turn` None before there is any.

    What does not change from one picture to the next is the same object, so that whoever draws keeps what they made.
    """
    ground = rules.ground
    if turn is None:
        return {"score": _nothing(ground), "position_s": min(at_ns, 0) / NS_PER_S}
    shared = {"position_s": (at_ns - turn.start_ns) / NS_PER_S, "beat_ticks": ground.beat_ticks}
    if turn.phrase is None:
        strip = Strip(_performance(tuple(turn.played)), rules.beat_ns / NS_PER_S, ground.beats_a_bar)
        return {**shared, "score": _nothing(ground), "strip": strip}
    score = with_landing(turn.phrase)
    if turn.kind is TurnKind.CALL:
        return {**shared, "score": score}
    marks, extras = _marked(score, tuple(turn.judged), tuple(turn.played))
    return {**shared, "score": score, "marks": marks, "extras": extras, "on_time_ms": rules.level.windows.on_time_ms}


@lru_cache(maxsize=8)
def with_landing(phrase: Phrase) -> Score:
    """A phrase's score with its landing, the same object for the same phrase."""
    return phrase.with_landing


@lru_cache(maxsize=1)
def _nothing(ground: Ground) -> Score:
    return Score.from_notes([], ground.tempo_map)


@lru_cache(maxsize=2)
def _performance(played: tuple[Hit, ...]) -> Performance:
    return Performance.from_hits(played)


@lru_cache(maxsize=2)
def _marked(
    score: Score, judged: tuple[Judgement, ...], played: tuple[Hit, ...]
) -> tuple[NDArray[np.void], tuple[ExtraHit, ...]]:
    """What became of each note, and the strokes that answer none."""
    marks, extras = no_marks(score), []
    for judgement in judged:
        mark(marks, judgement)
        if judgement.label in OF_LONE_HITS and judgement.hit_index is not None:
            hit = played[judgement.hit_index]
            extras.append(ExtraHit(hit.at_ns / NS_PER_S, hit.piece))
    return marks, tuple(extras)
