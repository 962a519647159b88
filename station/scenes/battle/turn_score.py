"""What stands below the stage: the phrase that is played or repeated with its marks, or strokes that roll by."""

from collections.abc import Mapping
from typing import Any

from station.core.units import NS_PER_S
from station.music.judgement import OF_LONE_HITS
from station.music.performance import Performance
from station.music.score import Score
from station.practice.battle.battle_view import TurnView
from station.practice.battle.rules import BattleRules
from station.practice.battle.turn_plan import TurnKind
from station.render.snapshot import BarNumbers, ExtraHit, Strip, mark, no_marks


def score_fields(rules: BattleRules, turn: TurnView | None, at_ns: int) -> Mapping[str, Any]:
    """The fields of a snapshot that say what music is shown at a battle time; `turn` None before there is any."""
    ground = rules.ground
    empty = Score.from_notes([], ground.tempo_map)
    if turn is None:
        return {"score": empty, "position_s": min(at_ns, 0) / NS_PER_S}
    position_s = (at_ns - turn.start_ns) / NS_PER_S
    first_bar = round(turn.start_ns / ground.ns_of_bars(1))
    shared = {"position_s": position_s, "beat_ticks": ground.beat_ticks}
    if turn.phrase is None:
        strip = Strip(Performance.from_hits(turn.played), rules.beat_ns / NS_PER_S, ground.beats_a_bar)
        return {**shared, "score": empty, "strip": strip}
    score, is_call = turn.phrase.with_landing, turn.kind is TurnKind.CALL
    shown = {**shared, "score": score, "bar_numbers": BarNumbers(0 if turn.phrase else first_bar)}
    if is_call:
        return shown
    marks, extras = no_marks(score), []
    for judgement in turn.judged:
        mark(marks, judgement)
        if judgement.label in OF_LONE_HITS and judgement.hit_index is not None:
            hit = turn.played[judgement.hit_index]
            extras.append(ExtraHit(hit.at_ns / NS_PER_S, hit.piece))
    return {**shown, "marks": marks, "extras": tuple(extras), "on_time_ms": rules.level.windows.on_time_ms}
