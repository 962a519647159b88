"""What is kept of a battle of two stations: the result as of any battle, and how both ends came to agree on it."""

from dataclasses import replace

from station.practice.battle.battle_result import BattleResult, JudgedTurn
from station.practice.battle.link.link_messages import Claim
from station.practice.battle.link.linked_battle import LinkedBattle, LinkEnd
from station.practice.battle.link.linked_record import SharedTurn
from station.scoring.report.assessment_document import Json


def linked_result(battle: LinkedBattle) -> BattleResult:
    """The turns that stand, of both players, where this station played or heard them."""
    here = {(turn.round, turn.side): turn for turn in reversed(battle.plan)}
    turns: list[JudgedTurn] = []
    for turn in battle.rounds.shared.judged():
        planned = here.get((turn.planned.round, turn.planned.side))
        first_bar = 0 if planned is None else planned.first_bar
        turns.append(replace(turn, planned=replace(turn.planned, first_bar=first_bar)))
    devices: list[str | None] = [None, None, None]
    our_side = battle.agreed.our_side
    devices[our_side] = battle.ear.strokes.device_of(battle.rules.player_of(our_side))
    is_complete = battle.ended is LinkEnd.COMPLETE
    return BattleResult(battle.rules, tuple(turns), is_complete, battle.latency, battle.heard.output, tuple(devices))


def network_fields(battle: LinkedBattle) -> dict[str, Json]:
    """How the two stations agree: plain JSON, for the document's `network`."""
    agreed, shared = battle.agreed, battle.rounds.shared
    return {
        "hosts": agreed.is_host,
        "stations": [agreed.host.station, agreed.joiner.station],
        "levels": [agreed.host.level.value, agreed.joiner.level.value],
        "programs": [agreed.host.program, agreed.joiner.program],
        "ended": None if battle.ended is None else battle.ended.name.lower(),
        "fault": battle.fault,
        "digest": shared.digest,
        "their_digest": battle.their_digest,
        "agree": not shared.disputed and battle.their_digest == shared.digest,
        "turns": [_turn_fields(one) for one in shared.standing()],
    }


def network_report(battle: LinkedBattle) -> str:
    """The same in words, in lines that end."""
    agreed, shared = battle.agreed, battle.rounds.shared
    lines = [
        f"Over the network: {agreed.host.station} hosts, {agreed.joiner.station} joined.",
        *([] if battle.ended is None else [f"The battle ended: {battle.ended.value}."]),
        *([battle.fault] if battle.fault else []),
        *(
            f"Round {one.round}, {_name(battle, one)}: the stations judge it otherwise; nobody gets it."
            for one in shared.disputed
        ),
        f"Record {shared.digest}: {_digest_words(battle)}.",
    ]
    return "\n".join(lines) + "\n"


def _name(battle: LinkedBattle, shared: SharedTurn) -> str:
    return battle.rules.player_of(shared.side).name


def _digest_words(battle: LinkedBattle) -> str:
    if battle.their_digest is None:
        return "the other station has not said what it has"
    same = battle.their_digest == battle.rounds.shared.digest
    return "the other station has the same" if same else f"the other station has {battle.their_digest}"


def _turn_fields(shared: SharedTurn) -> dict[str, Json]:
    assert shared.checked is not None, "it stands"
    return {
        "round": shared.round,
        "side": shared.side,
        "step": shared.step,
        "strokes": len(shared.turn.played),
        "claim": _claim_fields(shared.claim),
        "checked": _claim_fields(shared.checked),
        "agree": not shared.is_disputed,
    }


def _claim_fields(claim: Claim) -> dict[str, Json]:
    figures: dict[str, Json] = {figure.name: figure.value for figure in claim.figures}
    return {"points": claim.points, "won": claim.won, "figures": figures}
