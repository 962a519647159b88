"""States survive being written as JSON and read back; what does not fit is named."""

import json
from typing import Any

import pytest

from station.core.errors import BadInput
from station.core.pieces import Piece
from station.drills.mastery.equipment_faults import Equipment
from station.drills.mastery.mastery_json import SCHEMA, document_of, from_json, state_from, to_json
from station.drills.mastery.mastery_state import ItemState
from station.drills.mastery.rules import DEFAULT_RULES, Rules
from tests.unit.drills.mastering import BAD, CLEAN, played, weak_second_bar

WEAK = weak_second_bar()
STATES = {
    "new": played([]),
    "climbing": played([CLEAN] * 7),
    "stable": played([CLEAN] * 15),
    "in a weak bar": played([WEAK, WEAK, BAD]),
}


def through_text(state: ItemState) -> ItemState:
    return state_from(json.loads(json.dumps(document_of(state))), "history")


@pytest.mark.parametrize("name", STATES)
def test_a_state_comes_back(name: str) -> None:
    assert through_text(STATES[name]) == STATES[name]


def test_rules_and_swapped_pads_come_back() -> None:
    rules = Rules(start_pct=75.0, review_days=(2, 9))
    assert from_json(Rules, to_json(rules), "rules") == rules
    swapped = Equipment(swap=(Piece.TOM_1, Piece.TOM_2))
    assert from_json(Equipment, to_json(swapped), "kit") == swapped


def test_the_document_is_readable() -> None:
    document = document_of(STATES["stable"])
    assert document["schema"] == SCHEMA
    assert document["item"]["today"] == "2024-03-01"
    assert document["item"]["review"]["due"] == "2024-03-02"
    assert document["item"]["step"]["kind"] == "variation"


def test_what_an_older_document_lacks_takes_its_default() -> None:
    document = document_of(STATES["new"])
    del document["item"]["fixed_pct"], document["item"]["equipment"]
    assert state_from(document, "history") == STATES["new"]


def _changed(path: str, value: object) -> dict[str, Any]:
    document = json.loads(json.dumps(document_of(STATES["climbing"])))
    *parents, last = path.split(".")
    inner = document
    for name in parents:
        inner = inner[name]
    inner[last] = value
    return document  # type: ignore[no-any-return]


@pytest.mark.parametrize(
    ("path", "value", "place"),
    [
        ("schema", "something/else", "schema"),
        ("item.ladder.pct", "fast", "item.ladder.pct"),
        ("item.ladder.pct", True, "item.ladder.pct"),
        ("item.ladder", [1], "item.ladder"),
        ("item.step.kind", "holiday", "item.step.kind"),
        ("item.today", "yesterday", "item.today"),
        ("item.step.bars", [1], "item.step.bars"),
        ("item.item.bar_notes", "12", "item.item.bar_notes"),
        ("item.mood", "good", "item.mood"),
    ],
)
def test_what_does_not_fit_is_named(path: str, value: object, place: str) -> None:
    with pytest.raises(BadInput) as fault:
        state_from(_changed(path, value), "history.json")
    assert (fault.value.source, fault.value.place) == ("history.json", place)


def test_what_is_missing_is_named() -> None:
    document = document_of(STATES["new"])
    del document["item"]["ladder"]
    with pytest.raises(BadInput, match=r"item\.ladder: is missing"):
        state_from(document, "history.json")


@pytest.mark.parametrize("document", [None, [], {}, {"schema": SCHEMA}, {"schema": SCHEMA, "item": 3}])
def test_no_document_at_all(document: object) -> None:
    with pytest.raises(BadInput):
        state_from(document, "history.json")


def test_every_rule_is_in_its_document() -> None:
    assert set(to_json(DEFAULT_RULES)) == set(Rules.__dataclass_fields__)
