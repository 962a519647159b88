"""How a battle of two stations is kept at one of them: as any battle, with how both ends agree besides."""

from dataclasses import dataclass

from station.practice.battle.battle_result import BattleResult
from station.practice.battle.link.linked_battle import LinkedBattle
from station.practice.battle.link.linked_document import linked_result, network_fields, network_report
from station.practice.battle.records.battle_document import battle_document
from station.practice.battle.records.battle_report import battle_report
from station.scoring.report.assessment_document import Json


@dataclass(frozen=True, eq=False)
class LinkedRecord:
    """What is kept: the result, the same as a document with its `network`, and in words."""

    result: BattleResult
    document: dict[str, Json]
    report: str


def linked_record(battle: LinkedBattle) -> LinkedRecord:
    """What is kept of a battle that is over; `BattleFolder.keep` writes it."""
    result = linked_result(battle)
    document = {**battle_document(result), "network": network_fields(battle)}
    return LinkedRecord(result, document, battle_report(result) + network_report(battle))
