"""What a battle has written into its capture beside the bytes, so that the capture alone can be judged again.

Each text is one JSON object; `said` is

| `said` | besides |
|---|---|
| `battle` | the rules, as `rules_fields` has them, and the `latency` |
| `battle_turn` | a turn that was chosen: `index`, `round`, `side`, `kind`, `first_bar`, `bars`, `step`, `call`, and `phrase` and `keeping`: a score as `log_values` has it, its `landing` and `words`, or null |
| `battle_cut` | the turns from `index` on will not be played: the battle is over before them |
| `battle_pause` | the transport stopped; what was played from `from_ns` of the battle on is played again |
| `battle_unheard` | `from_ns`, `until_ns`: the session times between which no stroke could be heard |
| `battle_end` | `now_ns`, the session time, and whether it is `complete` |

Phrases are kept as they were played, so that judging again draws nothing.
"""  # noqa: E501 - a table

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

from station.core.errors import BadInput
from station.devices.capture.replay import LoggedText
from station.practice.battle.battle_rules import BattleRules
from station.practice.battle.phrase import Phrase
from station.practice.battle.records.rules_fields import rules_fields, rules_of
from station.practice.battle.turn_plan import PlannedTurn, TurnKind
from station.practice.session.device_latency import Latency
from station.practice.session.log_values import (
    landing_of,
    latency_fields,
    latency_from,
    note_rows,
    score_fields,
    score_of,
    table_in,
    whole,
)

_MOST_BARS = 10_000
"""No battle is so long (our choice: five hours at 120 bpm)."""


@dataclass(frozen=True, slots=True)
class BattleBegan:
    """A battle was laid out."""

    rules: BattleRules
    latency: Latency


@dataclass(frozen=True, eq=False)
class TurnChosen:
    """A turn was chosen."""

    turn: PlannedTurn


@dataclass(frozen=True, slots=True)
class TurnsCut:
    """The turns from `index` on will not be played."""

    index: int


@dataclass(frozen=True, slots=True)
class BattlePaused:
    """The transport stopped; the battle goes on `from_ns`."""

    from_ns: int


@dataclass(frozen=True, slots=True)
class BattleUnheard:
    """No stroke could be heard between these session times."""

    from_ns: int
    until_ns: int


@dataclass(frozen=True, slots=True)
class BattleEnded:
    """It was over, or was stopped, at `now_ns` of the session."""

    now_ns: int
    is_complete: bool


BattleSaid = BattleBegan | TurnChosen | TurnsCut | BattlePaused | BattleUnheard | BattleEnded


# --- writing ----------------------------------------------------------------------------------------------------------


def battle_text(said: BattleSaid) -> str:
    """The text as it is kept."""
    return json.dumps(_fields(said), ensure_ascii=False, allow_nan=False, separators=(",", ":"))


def _fields(said: BattleSaid) -> dict[str, object]:
    match said:
        case BattleBegan(rules, latency):
            return {"said": "battle", "rules": rules_fields(rules), "latency": latency_fields(latency)}
        case TurnChosen(turn):
            return {"said": "battle_turn", **_turn_fields(turn)}
        case TurnsCut(index):
            return {"said": "battle_cut", "index": index}
        case BattlePaused(from_ns):
            return {"said": "battle_pause", "from_ns": from_ns}
        case BattleUnheard(from_ns, until_ns):
            return {"said": "battle_unheard", "from_ns": from_ns, "until_ns": until_ns}
        case BattleEnded(now_ns, is_complete):
            return {"said": "battle_end", "now_ns": now_ns, "complete": is_complete}


def _turn_fields(turn: PlannedTurn) -> dict[str, object]:
    plain = {name: getattr(turn, name) for name in ("index", "round", "side", "first_bar", "bars", "step", "call")}
    return {
        **plain,
        "kind": turn.kind.value,
        "phrase": phrase_fields(turn.phrase),
        "keeping": phrase_fields(turn.keeping),
    }


def phrase_fields(phrase: Phrase | None) -> dict[str, object] | None:
    """A phrase in plain words and numbers, as `phrase_of` reads it."""
    if phrase is None:
        return None
    return {**score_fields(phrase.score), "landing": note_rows(phrase.landing), "words": phrase.words}


# --- reading ----------------------------------------------------------------------------------------------------------


def battle_said_in(logged: LoggedText) -> BattleSaid | None:
    """What a battle said; None for what no battle says. Raises `BadInput` where it is damaged."""
    try:
        fields = json.loads(logged.text)
        reader = _READERS.get(fields.get("said"))
        return None if reader is None else reader(fields)
    except (ValueError, TypeError, KeyError, AttributeError, OverflowError, RecursionError, BadInput):
        raise BadInput("capture", f"remark at {logged.at_ns} ns", "it cannot be read") from None


def _turn(fields: dict[str, Any]) -> PlannedTurn:
    numbers = {name: whole(fields[name]) for name in ("index", "round", "side", "first_bar", "bars")}
    if min(numbers.values()) < 0 or not 1 <= numbers["bars"] <= _MOST_BARS or numbers["first_bar"] > _MOST_BARS:
        raise ValueError
    return PlannedTurn(
        **numbers,
        kind=TurnKind(fields["kind"]),
        phrase=phrase_of(fields["phrase"]),
        keeping=phrase_of(fields["keeping"]),
        step=None if fields["step"] is None else whole(fields["step"]),
        call=None if fields["call"] is None else whole(fields["call"]),
    )


def phrase_of(fields: object) -> Phrase | None:
    """The phrase whose `phrase_fields` these are; raises `ValueError` and its like for what is none."""
    if fields is None:
        return None
    table = table_in(fields)
    return Phrase(score_of(table), landing_of(table), str(table["words"]))


_READERS: Mapping[object, Callable[[dict[str, Any]], BattleSaid]] = MappingProxyType(
    {
        "battle": lambda said: BattleBegan(rules_of(table_in(said["rules"])), latency_from(said["latency"])),
        "battle_turn": lambda said: TurnChosen(_turn(said)),
        "battle_cut": lambda said: TurnsCut(whole(said["index"])),
        "battle_pause": lambda said: BattlePaused(whole(said["from_ns"])),
        "battle_unheard": lambda said: BattleUnheard(whole(said["from_ns"]), whole(said["until_ns"])),
        "battle_end": lambda said: BattleEnded(whole(said["now_ns"]), said["complete"] is True),
    }
)
