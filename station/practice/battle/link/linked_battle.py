"""A battle of two stations, at one of them: a state machine as `battle.Battle`, whose other side sits behind a line.

Events of the engine, messages of the line and the time go in; commands for the engine and messages come out. Whoever
runs it carries the line's datagrams. Bars run on here whatever the network does (`linked_rounds`): a turn that has
begun is played to its end, for it needs no line. Where the line is cut, or somebody asks for a pause, the transport
stands as soon as nothing can go on, and goes on with a count-in where it was.
"""

from collections.abc import Sequence
from enum import Enum
from typing import Literal

from station.core.errors import BadInput
from station.core.units import NS_PER_MS, NS_PER_S
from station.engine.messages import AddCues, Annotate, Command, EngineEvent, Play, Stop, Unheard
from station.practice.battle.battle_cues import count_in_cues, turn_cues
from station.practice.battle.battle_ear import BattleEar
from station.practice.battle.heard_battle import HeardBattle
from station.practice.battle.link.link_line import WHO, LinkLine
from station.practice.battle.link.link_messages import (
    Bye,
    Called,
    Checked,
    Message,
    Outcome,
    Pause,
    PlayedBar,
    PlayedTurn,
    Resume,
)
from station.practice.battle.link.linked_rounds import LinkedRounds
from station.practice.battle.link.linked_rules import Agreed
from station.practice.battle.link.own_turns import OwnTurns
from station.practice.battle.phrase_request import Drum
from station.practice.battle.records.battle_log import (
    BattleBegan,
    BattleEnded,
    BattlePaused,
    BattleSaid,
    BattleUnheard,
    TurnChosen,
    battle_text,
)
from station.practice.battle.turn_judging import judged_at_ns
from station.practice.battle.turn_plan import PlannedTurn, TurnKind
from station.practice.session.cues.stroke_cues import in_order, moved_by
from station.practice.session.device_latency import Latency
from station.practice.session.plan import TAIL_NS
from station.practice.session.session import LEAD_IN_NS

LONGEST_CUT_NS = 180 * NS_PER_S
"""A line that is cut for longer ends the battle (our choice: time to plug a router in again)."""


CALL_TAKES_NS = 700 * NS_PER_MS
"""To choose a phrase that is to be repeated (our choice: half a second was measured)."""
LEAST_MARGIN_NS = 60 * NS_PER_MS
"""On a quick network: how unevenly a computer that also draws does its work (our choice)."""


class LinkEnd(Enum):
    """Why a battle of two stations is over; the words follow "The battle ended: "."""

    COMPLETE = "it was played to its end"
    STOPPED = "it was stopped here"
    LEFT = "the other player left"
    CUT = "the line was cut for too long"
    FAULT = "the other station said what cannot be"


class LinkedBattle(HeardBattle):
    """Call `start`, then `handle` every event and `advance` the time, or `update` for both, until `over`; then `stop`.

    Every call returns the commands for the engine. `drum` plays what the drummer plays; the line must be open.
    """

    def __init__(self, agreed: Agreed, line: LinkLine, drum: Drum, latency: Latency | None = None) -> None:
        self.agreed, self.rules = agreed, agreed.rules
        self.latency = latency or Latency()
        self.ear = BattleEar(self.rules, self.latency)
        self.rounds = LinkedRounds(agreed, drum)
        """What both know."""
        self.ended: LinkEnd | None = None
        """Why it is over; None while it is not."""
        self.fault = ""
        """What the other station said that cannot be."""
        self.their_digest: str | None = None
        """The digest of the record that the other end has, once it has said so."""
        self.standing = False
        """Whether the transport stands, and waits for the line or for a player."""
        self.pausing: set[int] = set()
        """The sides that asked for a pause."""
        self.plan: list[PlannedTurn] = []
        """What was and will be played here, bar after bar."""
        self.own = OwnTurns(agreed, self.ear, self.rounds)
        """What is played here."""
        self._line = line
        self._is_last_chosen = self._said_outcome = self._stands_next = False

    # --- commands ---------------------------------------------------------------------------------------------------

    def start(self) -> tuple[Command, ...]:
        """Begin with the count-in."""
        began = _kept(BattleBegan(self.rules, self.latency))
        if self.rounds.must_call:
            self.rounds.call()
        commands = (began, *self._play())
        self._say()
        return commands

    def stop(self) -> tuple[Command, ...]:
        """End it, and say so to the other end, at the present that it knows."""
        if self.ended is None:
            self._end(LinkEnd.STOPPED)
        return (_kept(BattleEnded(self.ear.now_ns, self.ended is LinkEnd.COMPLETE)), Stop())

    def pause(self) -> None:
        """Ask for a pause: both stations stand once the turn that each plays is over."""
        if self.agreed.our_side not in self.pausing:
            self.pausing.add(self.agreed.our_side)
            self._line.send(Pause())

    def resume(self) -> None:
        """Go on, where nobody else asked for a pause."""
        if self.agreed.our_side in self.pausing:
            self.pausing.discard(self.agreed.our_side)
            self._line.send(Resume())

    def _play(self) -> tuple[Command, ...]:
        """Start the transport with the count-in and what follows it; nothing where nothing more follows."""
        turn = self._choose()
        if turn is None:
            return ()
        self.standing = False
        cues = in_order([count_in_cues(self.rules, self._ns(turn.first_bar)), turn_cues(self.rules, turn)])
        return (_kept(TurnChosen(turn)), Play(moved_by(cues, self._zero_ns), LEAD_IN_NS))

    @property
    def _margin_ns(self) -> int:
        """By how much a bar must be early for the next to be in time, though it be lost and sent again."""
        return LEAST_MARGIN_NS + round(2 * (self._line.round_trip_ns or 0.0))

    @property
    def _zero_ns(self) -> int:
        """The cue time of the battle's first downbeat."""
        return self.rules.ground.ns_of_bars(self.rules.count_in_bars) - self.ear.from_ns

    def _choose(self) -> PlannedTurn | None:
        turn = self.rounds.next_turn(self.end_bar, self.ear.now_ns - self._margin_ns)
        if turn is None:
            self._is_last_chosen = True
        else:
            self.plan.append(turn)
        return turn

    def _let_pass(self, late_ns: int) -> PlannedTurn:
        """After a stall: what should begin now begins on a bar line that can still be prepared."""
        turn = self.rounds.let_pass(self.end_bar, -(-late_ns // self.rules.bar_ns))
        self.plan.append(turn)
        return turn

    # --- input ------------------------------------------------------------------------------------------------------

    @property
    def is_cut(self) -> bool:
        """Whether the other station has not been heard for too long, and had not said yet that it has all."""
        return self.their_digest is None and self._line.is_cut(self.ear.now_ns)

    def handle(self, event: EngineEvent) -> tuple[Command, ...]:
        """Take one event."""
        stroke = self.ear.handle(event)
        if stroke is not None:
            self.own.show(stroke, self.plan)
        if isinstance(event, Unheard):
            return (_kept(BattleUnheard(event.from_ns, event.until_ns)),)
        return ()

    def advance(self, now_ns: int) -> tuple[Command, ...]:
        """Tell the session time: what was played is sent, what was said is taken, what comes next sounds."""
        self.ear.advance(now_ns)
        if self.ended is not None:
            return ()
        self._take_messages()
        if self._has_time_to_call:
            self.rounds.call()
        commands: list[Command] = []
        while self.ended is None and (more := self._move_on()) is not None:
            commands += more
        self._say()
        self._end_where_it_is_over()
        return tuple(commands)

    @property
    def _has_time_to_call(self) -> bool:
        """Whether the next call is to be chosen, and no turn is to be laid out while that lasts."""
        if not self.rounds.must_call or self.at_ns is None:
            return self.rounds.must_call and self.standing
        left_ns = self._ns(self.end_bar) - self.rules.chosen_ahead_ns - self.at_ns
        return left_ns >= min(CALL_TAKES_NS, self.rules.bar_ns // 2)

    def _move_on(self) -> Sequence[Command] | None:
        """What is due next; None where nothing is."""
        at_ns = self.ear.at_ns
        if self.standing:
            return None if self._is_held or self._is_last_chosen else self._play()
        if at_ns is not None and self.own.send(self.plan, at_ns):
            return ()
        chooses_ns = self._ns(self.end_bar) - self.rules.chosen_ahead_ns
        return None if at_ns is None or self._is_last_chosen or at_ns < chooses_ns else self._go_on(at_ns)

    def _go_on(self, at_ns: int) -> Sequence[Command] | None:
        """What follows on all that is planned, or the stop where nothing may."""
        if self._is_held or self._stands_next:
            self._stands_next = True  # too late to go on without a gap, whatever comes meanwhile
            return self._stand() if at_ns >= judged_at_ns(self.rules, self.plan[-1]) else None
        late_ns = at_ns + self.rules.chosen_ahead_ns - self._ns(self.end_bar)
        turn = self._choose() if late_ns <= self.rules.chosen_ahead_ns // 2 else self._let_pass(late_ns)
        if turn is None:
            return ()
        return (_kept(TurnChosen(turn)), AddCues(moved_by(turn_cues(self.rules, turn), self._zero_ns)))

    # --- standing ---------------------------------------------------------------------------------------------------

    @property
    def _is_held(self) -> bool:
        """Whether nothing may go on now; an answer follows its call whatever happens."""
        if self.plan and self.plan[-1].kind is TurnKind.CALL and self.plan[-1].side not in self.rules.player_sides:
            return False
        return bool(self.pausing) or (self.is_cut and self.rounds.is_waiting)

    def _stand(self) -> tuple[Command, ...]:
        from_ns = self._ns(self.end_bar)
        self.ear.pause(from_ns)
        self.standing, self._stands_next = True, False
        return (_kept(BattlePaused(from_ns)), Stop())

    # --- the other end ----------------------------------------------------------------------------------------------

    def _say(self) -> None:
        said, self.rounds.outbox = self.rounds.outbox, []
        for message in said:
            self._line.send(message)

    def _take_messages(self) -> None:
        for message in self._line.messages():
            try:
                self._take(message)
            except BadInput as fault:
                self._line.disbelieve(str(fault))
            if self.ended is not None:
                return
        if self._line.fault is not None:
            self.fault = self._line.fault
            self._end(LinkEnd.FAULT)

    def _take(self, message: Message) -> None:
        match message:
            case Called() | PlayedBar() | PlayedTurn() | Checked():
                self.rounds.take(message, self.ear.now_ns)
            case Pause():
                self.pausing.add(self.agreed.their_side)
            case Resume():
                self.pausing.discard(self.agreed.their_side)
            case Outcome():
                self.their_digest = message.digest
            case Bye() if message.why != "over" or self.their_digest is None:
                self._end(LinkEnd.LEFT)
            case Bye():
                pass  # they have heard all; here it may still sound
            case _:
                raise BadInput(WHO, type(message).__name__.lower(), "the battle has begun")

    # --- the end ----------------------------------------------------------------------------------------------------

    @property
    def over(self) -> bool:
        """Whether it has ended, for whatever reason."""
        return self.ended is not None

    def _end_where_it_is_over(self) -> None:
        if self.ended is not None:
            return
        if self._line.silent_ns(self.ear.now_ns) > LONGEST_CUT_NS:
            self._end(LinkEnd.CUT)
            return
        if self.rounds.is_complete and not self._said_outcome:
            self._said_outcome = True
            self._line.send(Outcome(len(self.rounds.shared.standing()), self.rounds.shared.digest))
        if self._said_outcome and self.their_digest is not None and self._has_rung_out:
            self._end(LinkEnd.COMPLETE)

    @property
    def _has_rung_out(self) -> bool:
        at_ns = self.ear.at_ns
        return at_ns is None or (self._is_last_chosen and at_ns >= self._ns(self.end_bar) + TAIL_NS)

    def _end(self, why: LinkEnd) -> None:
        if self.ended is None:
            self.ended = why
            self._line.send(Bye(_BYES[why]))

    @property
    def started(self) -> bool:
        """Whether the transport runs or ran."""
        return self.at_ns is not None or self.standing

    # --- time -------------------------------------------------------------------------------------------------------

    @property
    def end_bar(self) -> int:
        """The bar after all that is planned."""
        return self.plan[-1].end_bar if self.plan else 0

    def _ns(self, bar: int) -> int:
        return self.rules.ground.ns_of_bars(bar)


_BYES: dict[LinkEnd, Literal["over", "left", "fault"]] = {
    LinkEnd.COMPLETE: "over",
    LinkEnd.STOPPED: "left",
    LinkEnd.LEFT: "left",
    LinkEnd.CUT: "left",
    LinkEnd.FAULT: "fault",
}


def _kept(said: BattleSaid) -> Command:
    return Annotate(battle_text(said))
