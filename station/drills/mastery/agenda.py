"""A practice session over several items: block each until it is stable, then interleave.

Items come in threes. Reviews that are due come first; then each item of a group is practised until it is stable or
left for the day; then the stable ones of the group rotate, about three minutes each, and the next group follows
(TEACHING: block until stable, then interleave). After five minutes of playing there is a breath, after 25 an end.
Pure and immutable, like `policy`; lengths are those of the passes, in seconds.
"""

from dataclasses import dataclass, replace
from datetime import date
from enum import StrEnum
from typing import TypeVar

from station.drills.mastery.passes import PassResult
from station.drills.mastery.policy import begin, next_step
from station.drills.mastery.rules import DEFAULT_RULES, Rules
from station.drills.mastery.state import ItemState
from station.drills.mastery.steps import Kind, Step

T = TypeVar("T")


class Break(StrEnum):
    """What comes before the next pass."""

    NONE = "none"
    BREATH = "breath"
    END = "end"


@dataclass(frozen=True, slots=True)
class Agenda:
    """The `items` of a session and the one that is played now.

    `turns` counts each item's finished turns in rotation, `left` lists those that are done for today, `turn_s` is how
    long the current item, if stable, has been played in one go, `block_s` since the last breath, `session_s` today.
    """

    items: tuple[ItemState, ...]
    current: int = 0
    turns: tuple[int, ...] = ()
    left: tuple[int, ...] = ()
    turn_s: float = 0.0
    block_s: float = 0.0
    session_s: float = 0.0

    @property
    def step(self) -> Step:
        """The next pass."""
        return self.items[self.current].step

    def having(self, state: ItemState) -> "Agenda":
        """The same with the current item's state, after a veto or with another tempo."""
        return replace(self, items=_with(self.items, self.current, state))


@dataclass(frozen=True, slots=True)
class Turn:
    """What comes next: perhaps a `pause`, then `step` of item number `item`; `why` another one, None if it is not."""

    item: int
    step: Step
    why: str | None
    pause: Break


def open_session(items: tuple[ItemState, ...], today: date, rules: Rules = DEFAULT_RULES) -> Agenda:
    """A session of today over `items`, at least one."""
    assert items, "nothing to practise"
    agenda = Agenda(tuple(begin(item, today, rules) for item in items), turns=(0,) * len(items))
    chosen = _chosen(agenda, rules)
    return agenda if chosen is None else replace(agenda, current=chosen[0])


def advance(agenda: Agenda, result: PassResult, rules: Rules = DEFAULT_RULES) -> tuple[Agenda, Turn]:
    """What to play after the pass `result`, which answered `agenda.step`."""
    now = agenda.current
    played = agenda.items[now]
    length_s = played.item.pass_s(played.step)
    state, step = next_step(played, result, rules)
    agenda = replace(
        agenda,
        items=_with(agenda.items, now, state),
        left=agenda.left if step.kind is not Kind.LEAVE else tuple(sorted({*agenda.left, now})),
        turn_s=agenda.turn_s + length_s if played.is_stable(rules) else 0.0,
        block_s=agenda.block_s + length_s,
        session_s=agenda.session_s + length_s,
    )
    chosen = _chosen(agenda, rules)
    if chosen is None or agenda.session_s >= rules.session_s:
        why = "All is done for today." if chosen is None else f"{rules.session_s / 60:.0f} minutes: enough for today."
        return agenda, Turn(now, step, why, Break.END)
    item, why = chosen
    if item != now:
        turned = agenda.turns[now] + (agenda.turn_s >= rules.turn_s)
        agenda = replace(agenda, current=item, turn_s=0.0, turns=_with(agenda.turns, now, turned))
    pause = Break.BREATH if agenda.block_s >= rules.block_s else Break.NONE
    if pause is Break.BREATH:
        agenda = replace(agenda, block_s=0.0)
    return agenda, Turn(item, agenda.step, why if item != now else None, pause)


# --- which item -------------------------------------------------------------------------------------------------------


def _chosen(agenda: Agenda, rules: Rules) -> tuple[int, str] | None:
    """The item to play now and why; None where all are done."""
    reviews = [i for i, item in enumerate(agenda.items) if item.step.kind is Kind.REVIEW]
    if reviews:
        return reviews[0], "First, what is due for review."
    here = [i for i in range(len(agenda.items)) if i not in agenda.left]
    for start in range(0, len(agenda.items), rules.rotate_items):
        group = [i for i in here if start <= i < start + rules.rotate_items]
        fresh = [i for i in group if not agenda.items[i].is_stable(rules)]
        if fresh:
            return (agenda.current if agenda.current in fresh else fresh[0]), "The last one will do for now: the next."
        if group and _in_rotation(agenda, group, rules):
            return _rotated(agenda, group, rules), _ROTATION
    return (_rotated(agenda, here, rules), _ROTATION) if here else None


_ROTATION = "These are stable: a few minutes each in turn, which makes them last."


def _in_rotation(agenda: Agenda, group: list[int], rules: Rules) -> bool:
    """Whether one of the group has not had its turn yet; where nothing comes after it, it goes round and round."""
    return any(_turns(agenda, i, rules) == 0 for i in group)


def _rotated(agenda: Agenda, group: list[int], rules: Rules) -> int:
    """The item that is played now while its turn lasts, else the one with the fewest turns.

    An item that has become stable just now (no turn begun) was practised long enough: another one comes first.
    """
    if agenda.current in group and 0.0 < agenda.turn_s < rules.turn_s:
        return agenda.current
    return min(group, key=lambda i: (_turns(agenda, i, rules), i == agenda.current, i))


def _turns(agenda: Agenda, item: int, rules: Rules) -> int:
    """Finished turns, the current one included if it is over."""
    is_over = item == agenda.current and agenda.turn_s >= rules.turn_s
    return agenda.turns[item] + is_over


def _with(values: tuple[T, ...], index: int, value: T) -> tuple[T, ...]:
    return (*values[:index], value, *values[index + 1 :])
