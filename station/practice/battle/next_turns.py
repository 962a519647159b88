"""What comes next in a battle: the turns of the next part, chosen by what was played until then.

A part is chosen a little before it begins. The answer that still runs is taken as if its rest were played as written:
so nobody is counted out who can still win, and what they get wrong in the end counts from the part after.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from station.practice.battle.battle_ear import BattleEar
from station.practice.battle.battle_result import JudgedTurn, is_decided, is_lost, standings
from station.practice.battle.battle_rules import DRUMMER, BattleMode, BattleRules
from station.practice.battle.phrase import Phrase
from station.practice.battle.phrase_as_turn import phrase_as_turn
from station.practice.battle.phrase_request import Asked, Drum, PhraseRequest
from station.practice.battle.repeating.answer_marks import answer_well_ended
from station.practice.battle.repeating.staircase import Answered
from station.practice.battle.turn_plan import Part, PlannedTurn, TurnKind, parts_of_round, with_changeovers


@dataclass(frozen=True, eq=False)
class SoFar:
    """A battle until now: its `plan`, and of each turn what it is worth as far as it was heard."""

    rules: BattleRules
    plan: Sequence[PlannedTurn]
    turns: Sequence[JudgedTurn]

    @property
    def last_round(self) -> int:
        """The round of the last turn; 0 before the first."""
        return self.plan[-1].round if self.plan else 0

    @property
    def sides_in(self) -> tuple[int, ...]:
        """The players who still play."""
        sides = standings(self.rules, self.turns)
        return tuple(side for side in self.rules.player_sides if sides[side].is_in)

    def answers(self, side: int) -> list[Answered]:
        """What a player has answered to phrases that were to be repeated."""
        return [
            Answered(turn.planned.step, not is_lost(self.rules, turn))
            for turn in self.turns
            if turn.planned.side == side and turn.planned.step is not None and turn.marks is not None
        ]


def so_far(
    rules: BattleRules, plan: Sequence[PlannedTurn], judged: Sequence[JudgedTurn], ear: BattleEar, heard_ns: int
) -> SoFar:
    """The battle as far as it was heard until `heard_ns` of it; the turns that were `judged` are over."""
    running = [_running(rules, planned, ear, heard_ns) for planned in plan[len(judged) :]]
    return SoFar(rules, plan, [*judged, *running])


def _running(rules: BattleRules, planned: PlannedTurn, ear: BattleEar, heard_ns: int) -> JudgedTurn:
    if planned.kind is TurnKind.CALL and planned.phrase is not None:
        return JudgedTurn(planned, phrase_as_turn(planned.phrase, rules.ground), None)
    if planned.kind is not TurnKind.ANSWER:
        return JudgedTurn(planned, None, None)
    played = ear.turn(planned, heard_ns)
    if planned.phrase is None:
        return JudgedTurn(planned, played, None)
    until_ns = heard_ns - rules.ground.ns_of_bars(planned.first_bar)
    return JudgedTurn(planned, played, answer_well_ended(planned.phrase, played, rules.level.windows, until_ns))


def next_turns(before: SoFar, drum: Drum) -> tuple[PlannedTurn, ...]:
    """The turns of the next part, none where the battle ends with what is planned."""
    rules, number = before.rules, max(before.last_round, 1)
    part = _rest_of_round(before, number)
    if part is None:
        number = before.last_round + 1
        if number > rules.rounds_in_all or is_decided(rules, before.turns):
            return ()
        part = parts_of_round(rules, number, before.sides_in)[0]
    if rules.is_hot_seat:
        seated = [turn.side for turn in before.plan if turn.kind is TurnKind.ANSWER]
        part = with_changeovers(part, seated[-1] if seated else None)
    return _laid_out(before, number, part, drum)


def _rest_of_round(before: SoFar, number: int) -> Part | None:
    """The part of the round that runs which is not planned yet, if there is one."""
    planned = {turn.side for turn in before.plan if turn.round == number and turn.kind is TurnKind.ANSWER}
    if not planned or not before.sides_in:
        return None
    parts = parts_of_round(before.rules, number, before.sides_in)
    return next((part for part in parts if planned.isdisjoint(side for _, side in part)), None)


def _laid_out(before: SoFar, number: int, part: Part, drum: Drum) -> tuple[PlannedTurn, ...]:
    rules, turns = before.rules, list[PlannedTurn]()
    call: PlannedTurn | None = None
    for place, (kind, side) in enumerate(part):
        last = [*before.plan, *turns][-1:]
        turn = PlannedTurn(
            index=len(before.plan) + len(turns),
            round=number,
            side=side,
            kind=kind,
            first_bar=last[0].end_bar if last else 0,
            bars=rules.changeover_bars if kind is TurnKind.CHANGEOVER else rules.bars,
        )
        if kind is TurnKind.CALL:
            first = next(other for what, other in part[place:] if what is TurnKind.ANSWER)
            turn = call = _called(before, turn, drum, step_for(before, turn.round, first))
        elif kind is TurnKind.ANSWER:
            turn = _answered(before, turn, call, drum)
        turns.append(turn)
    return tuple(turns)


def _called(before: SoFar, turn: PlannedTurn, drum: Drum, step: int) -> PlannedTurn:
    """The drummer's call, of a `step` where it is to be repeated.

    On one kit everybody hears the same one in a round, but for a handicap.
    """
    rules = before.rules
    if rules.mode is BattleMode.IMPROVISE:
        return _with_phrase(turn, drum(_request(before, turn, Asked.TO_ANSWER)))
    same = [other for other in before.plan if other.round == turn.round and other.kind is TurnKind.CALL]
    if same and same[0].phrase is not None and not rules.has_handicap:
        return replace(_with_phrase(turn, same[0].phrase), step=same[0].step)
    request = replace(_request(before, turn, Asked.TO_REPEAT), step=step)
    return replace(_with_phrase(turn, drum(request)), step=step)


def _answered(before: SoFar, turn: PlannedTurn, call: PlannedTurn | None, drum: Drum) -> PlannedTurn:
    rules = before.rules
    if call is not None:
        is_repeat = rules.mode is BattleMode.REPEAT
        phrase = call.phrase if is_repeat else None
        turn = replace(turn, bars=call.bars, call=call.index, phrase=phrase, step=call.step)
    if not rules.keeps_time:
        return turn
    return replace(turn, keeping=drum(_request(before, turn, Asked.TIME)))


def _with_phrase(turn: PlannedTurn, phrase: Phrase) -> PlannedTurn:
    return replace(turn, phrase=phrase, bars=phrase.bars)


def _request(before: SoFar, turn: PlannedTurn, asked: Asked) -> PhraseRequest:
    played = [(one.planned.side == DRUMMER, one.played) for one in before.turns if one.played is not None]
    return PhraseRequest(
        before.rules,
        turn.index,
        asked,
        turn.bars,
        heard=tuple(one for is_drummer, one in played if not is_drummer),
        said=tuple(one for is_drummer, one in played if is_drummer),
    )


def step_for(before: SoFar, number: int, side: int) -> int:
    """How hard the call of round `number` is that the player on `side` answers first.

    With a handicap it is of that player's own step, the final too.
    """
    rules = before.rules
    if not rules.has_handicap:
        return step_of_round(before, number)
    now = before.answers(side)
    if not now and rules.first_step is not None:
        return rules.first_step
    return rules.staircase.next_step([*rules.expectations[side - 1].answered, *now])


def step_of_round(before: SoFar, number: int) -> int:
    """How hard a call for all is: as whoever's turn it is needs it, the final as hard as was ever won."""
    rules = before.rules
    owner = before.sides_in[(number - 1) % len(before.sides_in)]
    won = [answer.step for side in rules.player_sides for answer in before.answers(side) if answer.is_won]
    if rules.is_final(number) and won:
        return max(won)
    return rules.staircase.next_step(before.answers(owner))
