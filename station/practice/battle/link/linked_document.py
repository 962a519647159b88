"""The document of a battle of two stations: what was agreed, every turn with both judgements, who won, the digests."""

from station.practice.battle.battle_result import standings, winner_of
from station.practice.battle.link.link_messages import Claim
from station.practice.battle.link.linked_battle import LinkedBattle, LinkEnd
from station.practice.battle.link.linked_record import SharedTurn
from station.practice.battle.link.linked_rules import Agreed
from station.practice.battle.records.rules_fields import rules_fields

SCHEMA = "drum-station/linked-battle/1"


def linked_document(battle: LinkedBattle) -> dict[str, object]:
    """Plain JSON; `winner` is a side (1 the host, 2 the joiner), None where nothing was decided."""
    rules, shared = battle.rules, battle.rounds.shared
    judged = shared.judged()
    sides = standings(rules, judged)[1:]
    return {
        "schema": SCHEMA,
        "rules": rules_fields(rules),
        "we_host": battle.agreed.is_host,
        "sides": [
            {
                "side": side,
                "name": rules.player_of(side).name,
                "level": battle.agreed.level_of(side).value,
                "points": one.points,
                "lives": one.lives,
                "rounds_won": one.rounds_won,
            }
            for side, one in zip(rules.player_sides, sides, strict=True)
        ],
        "turns": [_turn_fields(battle.agreed, one) for one in shared.standing()],
        "ended": battle.ended.name.lower() if battle.ended else None,
        "fault": battle.fault,
        "winner": winner_of(rules, judged, battle.ended is LinkEnd.COMPLETE),
        "digest": shared.digest,
        "their_digest": battle.their_digest,
        "agree": not shared.disputed and battle.their_digest == shared.digest,
    }


def _turn_fields(agreed: Agreed, shared: SharedTurn) -> dict[str, object]:
    assert shared.checked is not None, "it stands"
    return {
        "round": shared.round,
        "side": shared.side,
        "name": agreed.rules.player_of(shared.side).name,
        "step": shared.step,
        "strokes": len(shared.turn.played),
        "claim": _claim_fields(shared.claim),
        "checked": _claim_fields(shared.checked),
        "agree": not shared.is_disputed,
    }


def _claim_fields(claim: Claim) -> dict[str, object]:
    figures = {figure.name: figure.value for figure in claim.figures}
    return {"points": claim.points, "won": claim.won, "figures": figures}
