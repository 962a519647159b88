"""A battle as a state machine: events of the engine and time in, commands and a view out.

It owns no clock, thread, device or window: whoever runs it hands it every event of the engine and now and then the
time, and sends the engine the commands that come of it. Bars run on without a gap from the count-in to the end. Each
turn is chosen `chosen_ahead_ns` before it begins, by what was played until `ARRIVES_NS` before that, and its cues are
added to the running transport. All of it depends on the strokes' own times alone, however often anybody looks; what is
chosen is kept in the capture (`records.battle_log`), with all that judging it again needs.

Read `turn_plan` for who plays when, `turn_judging` for what it is worth, `battle_result` for who wins.
"""

from collections.abc import Sequence

from station.core.events import Hit
from station.engine.messages import AddCues, Annotate, Command, EngineEvent, Play, Stop, Unheard
from station.practice.battle.battle_cues import count_in_cues, turn_cues
from station.practice.battle.battle_ear import BattleEar
from station.practice.battle.battle_result import BattleResult, JudgedTurn, is_decided
from station.practice.battle.battle_rules import BattleRules
from station.practice.battle.battle_view import BattleView, TurnView
from station.practice.battle.heard_battle import HeardBattle
from station.practice.battle.next_turns import next_turns, so_far
from station.practice.battle.phrase_request import Drum
from station.practice.battle.records.battle_log import (
    BattleBegan,
    BattleEnded,
    BattlePaused,
    BattleSaid,
    BattleUnheard,
    TurnChosen,
    TurnsCut,
    battle_text,
)
from station.practice.battle.repeating.live_answer import LiveAnswer
from station.practice.battle.turn_judging import ARRIVES_NS, judged_at_ns, judged_turn, result_of
from station.practice.battle.turn_plan import PlannedTurn, TurnKind
from station.practice.battle.view_building import Moment, view_of
from station.practice.session.cues.stroke_cues import in_order, moved_by
from station.practice.session.device_latency import Latency
from station.practice.session.plan import TAIL_NS
from station.practice.session.session import LEAD_IN_NS


class Battle(HeardBattle):
    """Call `start`, then `handle` every event and `advance` the time, or `update` for both, until `over`; then `stop`.

    Every call returns the commands for the engine. `drum` plays the drummer's part.
    """

    def __init__(self, rules: BattleRules, drum: Drum, latency: Latency | None = None) -> None:
        self.rules = rules
        self.latency = latency or Latency()
        self.ear = BattleEar(rules, self.latency)
        self.paused = False
        """Whether the transport stands and waits for `resume`."""
        self.stopped = False
        """Whether it was ended: nothing moves any more."""
        self._drum = drum
        self._plan: list[PlannedTurn] = []
        self._parts: list[int] = []  # the first turn of each part
        self._last: tuple[tuple[int, bool], BattleResult] | None = None
        self._sent = 0  # turns whose cues the engine has
        self._judged: list[JudgedTurn] = []  # the turns that are over, in order
        self._live: dict[int, LiveAnswer] = {}  # answers by the indices of their turns, as they are shown
        self._is_last_chosen = self._is_complete = False

    # --- commands ---------------------------------------------------------------------------------------------------

    def start(self) -> tuple[Command, ...]:
        """Begin with the count-in."""
        began = _kept(BattleBegan(self.rules, self.latency))
        return (began, *self._choose(), self._play())

    def stop(self) -> tuple[Command, ...]:
        """End it, at the present that it knows."""
        self._is_complete = self.over
        self.stopped = True
        return (_kept(BattleEnded(self.ear.now_ns, self._is_complete)), Stop())

    def pause(self) -> tuple[Command, ...]:
        """Stand still until `resume`, which plays the present part again; nothing where it may not pause."""
        if self.at_ns is None or self.over or self.stopped:
            return ()
        part = self._part_at(self.at_ns)
        from_ns = self._start_ns(self._plan[part])
        self.ear.pause(from_ns)
        self.paused, self._sent = True, part
        del self._judged[part:]
        self._live = {index: live for index, live in self._live.items() if index < part}
        return (_kept(BattlePaused(from_ns)), Stop())

    def resume(self) -> tuple[Command, ...]:
        """Count in, and go on with the part in which it was paused."""
        if not self.paused:
            return ()
        self.paused = False
        return (self._play(),)

    def _part_at(self, at_ns: int) -> int:
        """The first turn of the part that runs then."""
        begun = [first for first in self._parts if self._start_ns(self._plan[first]) <= at_ns]
        return begun[-1] if begun else self._parts[0]

    def _play(self) -> Command:
        """Start the transport with the count-in, and the turn that follows it."""
        turn = self._plan[self._sent]
        self._sent += 1
        counted_ns = self.rules.ground.ns_of_bars(self.rules.count_in_bars)
        cues = in_order([count_in_cues(self.rules, self._start_ns(turn)), turn_cues(self.rules, turn)])
        return Play(moved_by(cues, counted_ns - self.ear.from_ns), LEAD_IN_NS)

    # --- input ------------------------------------------------------------------------------------------------------

    def handle(self, event: EngineEvent) -> tuple[Command, ...]:
        """Take one event."""
        stroke = self.ear.handle(event)
        if stroke is not None:
            self._show(stroke)
        if isinstance(event, Unheard):
            return (_kept(BattleUnheard(event.from_ns, event.until_ns)),)
        return ()

    def advance(self, now_ns: int) -> tuple[Command, ...]:
        """Tell the session time: what is over is judged, what comes is chosen and sounds."""
        self.ear.advance(now_ns)
        if (at_ns := self.at_ns) is not None:
            for index, live in self._live.items():
                if index >= len(self._judged):
                    live.advance(at_ns)
        commands: list[Command] = []
        while self._plan and not (self.stopped or self.over) and self._is_due(self._next_ns):
            commands += self._move_on()
        return tuple(commands)

    def _is_due(self, at_ns: int | None) -> bool:
        return at_ns is not None and self.at_ns is not None and at_ns <= self.at_ns

    @property
    def next_ns(self) -> int | None:
        """The session time at which something is to be judged or chosen next; None where nothing is before its end."""
        now_ns, next_ns = self.at_ns, self._next_ns
        return None if now_ns is None or next_ns is None else self.ear.now_ns + next_ns - now_ns

    @property
    def _next_ns(self) -> int | None:
        times = [at_ns for at_ns in (self._judges_ns, self._chooses_ns) if at_ns is not None]
        return min(times) if times else None

    @property
    def _judges_ns(self) -> int | None:
        """When the next turn is judged: its last stroke has come by then."""
        if len(self._judged) >= self._sent:
            return None
        return judged_at_ns(self.rules, self._plan[len(self._judged)])

    @property
    def _chooses_ns(self) -> int | None:
        """When the next turn is chosen, or sent."""
        if self._is_last_chosen and self._sent == len(self._plan):
            return None
        return self._end_ns(self._plan[self._sent - 1]) - self.rules.chosen_ahead_ns

    def _move_on(self) -> Sequence[Command]:
        judges_ns, chooses_ns = self._judges_ns, self._chooses_ns
        if judges_ns is not None and (chooses_ns is None or judges_ns <= chooses_ns):
            return self._judge()
        chosen = self._choose() if self._sent == len(self._plan) else ()
        if self._sent == len(self._plan):
            return chosen
        turn = self._plan[self._sent]
        self._sent += 1
        counted_ns = self.rules.ground.ns_of_bars(self.rules.count_in_bars)
        return (*chosen, AddCues(moved_by(turn_cues(self.rules, turn), counted_ns - self.ear.from_ns)))

    def _judge(self) -> Sequence[Command]:
        """Judge the turn that is over; where that decides the battle, what is not yet sent is not played."""
        turn = self._plan[len(self._judged)]
        self._judged.append(judged_turn(self.rules, turn, self.ear, self._judged))
        if self._is_last_chosen or not self._is_decided_after(turn):
            return ()
        self._is_last_chosen = True
        self._plan = self._plan[: self._sent]
        return (_kept(TurnsCut(self._sent)),)

    def _is_decided_after(self, turn: PlannedTurn) -> bool:
        """Whether too few are left; among players only once all have answered in a round."""
        answers = [one for one in self._plan if one.kind is TurnKind.ANSWER and one.round == turn.round]
        return answers[-1:] == [turn] and is_decided(self.rules, self._judged)

    def _choose(self) -> Sequence[Command]:
        """Lay out the next part, where there is one."""
        before = so_far(self.rules, self._plan, self._judged, self.ear, self._heard_ns)
        turns = next_turns(before, self._drum)
        if not turns:
            self._is_last_chosen = True
            return ()
        self._parts.append(len(self._plan))
        self._plan += turns
        return [_kept(TurnChosen(turn)) for turn in turns]

    @property
    def _heard_ns(self) -> int:
        """Until when in the battle strokes count for what is chosen next."""
        return (self._chooses_ns or 0) - ARRIVES_NS if self._plan else 0

    # --- output -----------------------------------------------------------------------------------------------------

    @property
    def plan(self) -> Sequence[PlannedTurn]:
        """The turns so far and those known to come."""
        return tuple(self._plan)

    @property
    def started(self) -> bool:
        """Whether the transport runs or ran."""
        return self.at_ns is not None or self.paused

    @property
    def over(self) -> bool:
        """Whether the last turn and the tail after it have passed."""
        if self.at_ns is None or not self._is_last_chosen or self._sent < len(self._plan):
            return False
        return len(self._judged) == len(self._plan) and self.at_ns >= self._end_ns(self._plan[-1]) + TAIL_NS

    def result(self) -> BattleResult:
        """All that was played, judged once more; of a battle that was stopped the turns that were over."""
        return result_of(self.rules, self._plan, self.ear, self._is_complete or self.over)

    def view(self) -> BattleView:
        """What a stage and a window show, as of the last event and time."""
        result = self._last_result()
        judged = self._judged if result is None else result.turns
        moment = Moment(self.rules, self.at_ns, self._plan, judged, self.ear.from_ns, self.paused, result)
        return view_of(moment, tuple(self._turn_view(turn) for turn in self._plan))

    def _last_result(self) -> BattleResult | None:
        """The result of a battle that is over or was stopped, reckoned once."""
        if not (self.over or self.stopped):
            return None
        key = len(self.ear.strokes), self.stopped
        if self._last is None or self._last[0] != key:
            self._last = key, self.result()
        return self._last[1]

    def _turn_view(self, turn: PlannedTurn) -> TurnView:
        judged = self._judged[turn.index] if turn.index < len(self._judged) else None
        live = self._live.get(turn.index)
        return TurnView(
            turn.index,
            turn.round,
            turn.side,
            turn.kind,
            self._start_ns(turn),
            turn.bars,
            turn.phrase,
            turn.keeping,
            turn.step,
            played=self.ear.strokes.of(turn) if live is None else live.played,
            judged=() if live is None else live.judged,
            marks=None if judged is None else judged.marks,
        )

    def _show(self, stroke: Hit) -> None:
        """Judge a stroke for the view, as soon as it comes."""
        for turn in self._plan[len(self._judged) :]:
            if turn.phrase is not None and self.ear.strokes.is_of(turn, stroke):
                live = self._live.setdefault(turn.index, LiveAnswer(turn.phrase, self._start_ns(turn)))
                live.hit(stroke)

    def _start_ns(self, turn: PlannedTurn) -> int:
        return self.rules.ground.ns_of_bars(turn.first_bar)

    def _end_ns(self, turn: PlannedTurn) -> int:
        return self.rules.ground.ns_of_bars(turn.end_bar)


def _kept(said: BattleSaid) -> Command:
    return Annotate(battle_text(said))
