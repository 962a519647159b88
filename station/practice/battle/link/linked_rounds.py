"""What each station plays next, bar by bar, and what it says to the other: pure, without time.

Each station's bars run on by themselves. To *repeat*, both hear the same calls: the host chooses them and sends them,
each station plays call and answer as soon as it has the phrase, and the next one is chosen once both answers are known
and checked. To *improvise*, turns are traded: the other's turn is heard bar by bar, each as soon as it is whole and a
bar line comes, and one's own begins on the bar line after it. Where nothing has come the time goes on for a bar. So the
network's delay makes bars of waiting, and no stroke late.
"""

from collections.abc import Sequence
from typing import NamedTuple

from station.core.errors import BadInput
from station.music.performance import Performance
from station.practice.battle.battle_result import is_decided
from station.practice.battle.battle_rules import DRUMMER, BattleMode
from station.practice.battle.link.heard_bar import bar_of, heard_bar
from station.practice.battle.link.link_line import WHO
from station.practice.battle.link.link_messages import (
    Called,
    Checked,
    Claim,
    Message,
    PlayedBar,
    PlayedTurn,
)
from station.practice.battle.link.link_strokes import (
    called,
    performance_of,
    phrase_of,
    played_chokes,
    played_strokes,
)
from station.practice.battle.link.linked_claims import claim_of, judged_answer, judged_trade
from station.practice.battle.link.linked_record import SharedTurn, SharedTurns, Slot
from station.practice.battle.link.linked_rules import Agreed
from station.practice.battle.next_turns import SoFar, step_of_round
from station.practice.battle.phrase import Phrase, Turn
from station.practice.battle.phrase_request import Asked, Drum, PhraseRequest
from station.practice.battle.turn_marks import TurnMarks
from station.practice.battle.turn_plan import PlannedTurn, TurnKind
from station.scoring.matching.unheard import Span


class _HeardBar(NamedTuple):
    """A bar of the other's turn, and when it came."""

    played: Performance
    came_ns: int


class LinkedRounds:
    """One end's knowledge of the battle; `drum` chooses the host's phrases and keeps the time while one waits.

    Ask `next_turn` for what is played from a bar line on, hand over what was played in own turns and what the other end
    says, and send what is in `outbox`.
    """

    def __init__(self, agreed: Agreed, drum: Drum) -> None:
        self.agreed, self.rules = agreed, agreed.rules
        self.outbox: list[Message] = []
        """What is to be said to the other end."""
        rounds = range(1, self.rules.rounds_in_all + 1)
        self.shared = SharedTurns(((one, side) for one in rounds for side in agreed.order), agreed.as_bytes)
        self._drum = drum
        self._called: dict[int, tuple[int, Phrase]] = {}
        self._bars: dict[int, list[_HeardBar]] = {}
        self._awaits_claim: dict[Slot, tuple[Turn, tuple[Span, ...]]] = {}  # own turns that are not judged yet
        self._turn = 0  # of `shared.slots`, improvising: the next that is heard or played
        self._bar = 0  # of it
        self._round = 1  # repeating: the next that is called
        self._answers: PlannedTurn | None = None  # what was called, and is to be answered next
        self._index = 0

    # --- what is played next -----------------------------------------------------------------------------------------

    def next_turn(self, first_bar: int, in_time_ns: int) -> PlannedTurn | None:
        """What this station plays from `first_bar` on; None where nothing more is to be played.

        The other's turn begins with a bar that came before `in_time_ns`, so that those after it come in time too.
        """
        turn = self._traded(first_bar, in_time_ns) if self._is_trade else self._repeated(first_bar)
        self._index += turn is not None
        return turn

    @property
    def _is_trade(self) -> bool:
        return self.rules.mode is BattleMode.IMPROVISE

    @property
    def is_waiting(self) -> bool:
        """Whether what comes next has not come from the other station yet."""
        if self._answers is not None:
            return False
        if not self._is_trade:
            return self._round <= self.rules.rounds_in_all and self._round not in self._called
        if self._turn == len(self.shared.slots):
            return False
        number, side = self.shared.slots[self._turn]
        return side != self.agreed.our_side and len(self._bars.get(number, ())) <= self._bar

    def _traded(self, first_bar: int, in_time_ns: int) -> PlannedTurn | None:
        if self._turn == len(self.shared.slots):
            return None
        number, side = self.shared.slots[self._turn]
        if side == self.agreed.our_side:
            self._turn += 1
            keeping = self._time(self.rules.bars)
            return PlannedTurn(self._index, number, side, TurnKind.ANSWER, first_bar, self.rules.bars, None, keeping)
        if self.is_waiting or (self._bar == 0 and self._bars[number][0].came_ns > in_time_ns):
            return self._vamp(number, first_bar)
        phrase = heard_bar(self._bars[number][self._bar].played, self._bar, self.rules.ground)
        self._bar += 1
        if self._bar == self.rules.bars:
            self._turn, self._bar = self._turn + 1, 0
        return PlannedTurn(self._index, number, side, TurnKind.CALL, first_bar, 1, phrase)

    def _repeated(self, first_bar: int) -> PlannedTurn | None:
        if self._answers is not None:
            call, self._answers = self._answers, None
            self._round += 1
            keeping = self._time(call.bars)
            answer = (self.agreed.our_side, TurnKind.ANSWER, first_bar, call.bars)
            return PlannedTurn(self._index, call.round, *answer, call.phrase, keeping, call.index, call.step)
        if self._round > self.rules.rounds_in_all or self._is_decided:
            return None
        if self.is_waiting:
            return self._vamp(self._round, first_bar)
        step, phrase = self._called[self._round]
        turn = PlannedTurn(self._index, self._round, DRUMMER, TurnKind.CALL, first_bar, phrase.bars, phrase, step=step)
        self._answers = turn
        return turn

    def let_pass(self, first_bar: int, bars: int) -> PlannedTurn:
        """Bars in which the time goes on, whatever could be played."""
        number = self.shared.slots[min(self._turn, len(self.shared.slots) - 1)][0] if self._is_trade else self._round
        turn = self._vamp(min(number, self.rules.rounds_in_all), first_bar, bars)
        self._index += 1
        return turn

    def _vamp(self, number: int, first_bar: int, bars: int = 1) -> PlannedTurn:
        kind, side = TurnKind.CHANGEOVER, self.agreed.their_side
        return PlannedTurn(self._index, number, side, kind, first_bar, bars, keeping=self._time(bars))

    def _time(self, bars: int) -> Phrase | None:
        if not self.rules.keeps_time:
            return None
        return self._drum(PhraseRequest(self.rules, self._index, Asked.TIME, bars))

    @property
    def must_call(self) -> bool:
        """Whether the host's next call can be chosen: all rounds before it stand."""
        number = self._round
        if self._is_trade or not self.agreed.is_host or number in self._called or number > self.rules.rounds_in_all:
            return False
        return len(self.shared.standing(number - 1)) == 2 * (number - 1) and not self._is_decided

    def call(self) -> None:
        """Choose the call of the next round and say it; it may take the drummer a part of a second."""
        number = self._round
        step = step_of_round(SoFar(self.rules, (), self.shared.judged()), number)
        phrase = self._drum(PhraseRequest(self.rules, number, Asked.TO_REPEAT, self.rules.bars, step))
        said = called(phrase, number, step)
        self._called[number] = (step, phrase_of(said, self.rules.ground, "our own call"))  # as the other end has it
        self.outbox.append(said)

    # --- what was played here ----------------------------------------------------------------------------------------

    def bar_played(self, number: int, bar: int, turn: Turn) -> None:
        """A bar of our turn in a round is whole; `turn` is what was played so far."""
        if self._is_trade:
            played = bar_of(turn.played, bar, self.rules.ground, self.rules.early_ns)
            self.outbox.append(PlayedBar(number, bar, played_strokes(played), played_chokes(played)))

    def turn_played(self, number: int, turn: Turn, unheard: Sequence[Span]) -> None:
        """Our turn in a round is over, with all that can have been played in it."""
        self._awaits_claim[(number, self.agreed.our_side)] = (turn, tuple(unheard))
        self._judge_what_can_be()

    def _judge_what_can_be(self) -> None:
        for slot in list(self._awaits_claim):
            if self._is_judgeable(slot):
                turn, unheard = self._awaits_claim.pop(slot)
                marks = self._marks(slot, turn, unheard)
                claim = claim_of(marks, self.rules.target)
                strokes, chokes = played_strokes(turn.played), played_chokes(turn.played)
                said = PlayedTurn(slot[0], strokes, chokes, unheard, claim)
                self.shared.add(self._shared(slot, turn, said, marks))
                self.outbox.append(said)

    def _is_judgeable(self, slot: Slot) -> bool:
        """Whether all is here that the turn is judged by: in a trade what was played before it."""
        if not self._is_trade:
            return slot[0] in self._called
        before = self.shared.slots[: self.shared.slots.index(slot)]
        return all(other in self.shared.turns for other in before)

    def _marks(self, slot: Slot, turn: Turn, unheard: Sequence[Span]) -> TurnMarks | None:
        number, side = slot
        if not self._is_trade:
            return judged_answer(self._called[number][1], turn, self.agreed.level_of(side), unheard)
        before = self.shared.slots[: self.shared.slots.index(slot)]
        own = [self.shared.turns[other].turn for other in before if other[1] == side]
        return judged_trade(turn, unheard, own, self.shared.turns[before[-1]].turn if before else None)

    def _shared(self, slot: Slot, turn: Turn, said: PlayedTurn, marks: TurnMarks | None) -> SharedTurn:
        step, phrase = self._called.get(slot[0], (None, None))
        return SharedTurn(*slot, turn, said, phrase, step, marks)

    # --- what the other end says -------------------------------------------------------------------------------------

    def take(self, message: Called | PlayedBar | PlayedTurn | Checked, now_ns: int) -> None:
        """Take what the other end says of the battle at `now_ns`; raises `BadInput` where that cannot be true."""
        if message.round > self.rules.rounds_in_all:
            raise BadInput(WHO, f"round {message.round}", f"there are {self.rules.rounds_in_all}")
        match message:
            case Called():
                self._take_call(message)
            case PlayedBar():
                self._take_bar(message, now_ns)
            case PlayedTurn():
                self._take_turn(message)
            case Checked():
                self._take_claim(message.round, message.claim)
        self._judge_what_can_be()

    def _take_call(self, said: Called) -> None:
        if self.agreed.is_host or self._is_trade or said.round != len(self._called) + 1:
            raise BadInput(WHO, f"phrase of round {said.round}", "nobody asked for it")
        self._called[said.round] = (said.step, phrase_of(said, self.rules.ground, WHO))

    def _take_bar(self, said: PlayedBar, now_ns: int) -> None:
        played = performance_of(said.strokes, said.chokes)
        bars = self._bars.setdefault(said.round, [])
        if not self._is_trade or said.bar != len(bars) or said.bar >= self.rules.bars:
            raise BadInput(WHO, f"round {said.round}, bar {said.bar + 1}", "it is not its turn")
        self._check_times(played, (said.bar, said.bar + 1), f"round {said.round}, bar {said.bar + 1}")
        bars.append(_HeardBar(played, now_ns))

    def _take_turn(self, said: PlayedTurn) -> None:
        slot, place = (said.round, self.agreed.their_side), f"turn of round {said.round}"
        if slot in self.shared.turns or not self._is_judgeable(slot):
            raise BadInput(WHO, place, "it is not its turn")
        played = performance_of(said.strokes, said.chokes)
        bars = self.rules.bars if self._is_trade else self._called[said.round][1].bars
        self._check_times(played, (0, bars), place)
        if any(begin_ns > end_ns for begin_ns, end_ns in said.unheard):
            raise BadInput(WHO, place, "was not heard in a time that ends before it begins")
        self._check_heard(said, place)
        turn = Turn(self.rules.ground, bars, played)
        marks = self._marks(slot, turn, said.unheard)
        claim = claim_of(marks, self.rules.target)
        self.shared.add(self._shared(slot, turn, said, marks))
        self.shared.check(slot, claim)
        self.outbox.append(Checked(said.round, claim))

    def _take_claim(self, number: int, claim: Claim) -> None:
        slot = (number, self.agreed.our_side)
        if slot not in self.shared.turns or self.shared.turns[slot].stands:
            raise BadInput(WHO, f"claim of round {number}", "nobody asked for it")
        self.shared.check(slot, claim)

    def _check_times(self, played: Performance, bars: tuple[int, int], place: str) -> None:
        """Raises `BadInput` for a stroke that can belong to none of these bars of a turn."""
        begin_ns, end_ns = (self.rules.ground.ns_of_bars(bar) for bar in bars)
        for rows in (played.hits, played.chokes):
            at_ns = rows["at_ns"]
            if ((at_ns < begin_ns - self.rules.early_ns) | (at_ns >= end_ns + self.rules.late_ns)).any():
                raise BadInput(WHO, place, "has a stroke outside its bars")

    def _check_heard(self, said: PlayedTurn, place: str) -> None:
        """Raises `BadInput` for a turn that lacks what was sent, and heard, of it."""
        heard = {stroke for bar in self._bars.get(said.round, ()) for stroke in played_strokes(bar.played)}
        if not heard <= set(said.strokes):
            raise BadInput(WHO, place, "lacks strokes that were heard in it")

    # --- the end -----------------------------------------------------------------------------------------------------

    @property
    def _is_decided(self) -> bool:
        """Whether too few have lives left; asked where all that was begun stands."""
        return len(self.shared.turns) % 2 == 0 and is_decided(self.rules, self.shared.judged())

    @property
    def is_complete(self) -> bool:
        """Whether every turn stands, or nothing that could come would count."""
        standing = len(self.shared.standing())
        return standing == len(self.shared.slots) or (standing == len(self.shared.turns) and self._is_decided)
