"""Which of a kit's hits are strokes: too soft ones, double triggers, crosstalk, false stomps and grabs are held back.

Crosstalk may arrive before the stroke that it comes from, so a hit that could be one is let go only when no stroke can
claim it any more: a few milliseconds later, with its own time, and what came after it waits its turn. Whoever sounds
the strokes does not wait: `feed` says at once whether a hit may sound, and a false trigger that came first has then
sounded as softly as it was. A kit of which nothing of the kind is known passes through at once and untouched.

The verdict on a hit depends on the events' own times alone. `settle` lets go what is certain by the clock; should a
driver hand over an event from before that, `overtaken_ns` says so, and whoever records notes it down, so that a replay
decides alike. Times are monotonic ns and never go back.
"""

from collections import deque
from dataclasses import dataclass, replace
from enum import Enum

from station.core.events import Choke, DeviceEvent, Hit, PedalMoved
from station.core.pieces import CHOKEABLE, Articulation, Piece
from station.core.units import NS_PER_MS
from station.devices.mapping.device_map import Crosstalk, DeviceMap

GRAB_BEFORE_NS, GRAB_AFTER_NS = 30 * NS_PER_MS, 60 * NS_PER_MS
"""How long before and after the choke a grabbing hand's own stroke comes (our choice: the hand closes in between)."""
FALSE_STOMP_NS = 60 * NS_PER_MS
"""How long after a stroke on the hi-hat its swinging may fire a stomp; our choice."""
TRAVEL_NS = 150 * NS_PER_MS
"""Over how long the pedal's way down counts as one; our choice: a stomp takes 50 to 100 ms."""
SPLASH_OPENS_BY = 0.3
"""So much opens a pedal that makes a splash; our choice."""
DRIVERS_NS = 3 * NS_PER_MS
"""How long a driver may keep an event from us before `settle` takes it for not there (our choice: two JACK periods)."""
_HARDEST = 127


class HeldBack(Enum):
    """Why a hit is no stroke."""

    TOO_SOFT = "softer than the threshold"
    DOUBLE = "double trigger"
    CROSSTALK = "crosstalk"
    FALSE_STOMP = "false stomp"
    GRAB = "the grabbing hand"


@dataclass(frozen=True, slots=True)
class FalseTrigger:
    """A hit that is no stroke; `source` is the piece that caused it where it was another."""

    hit: Hit
    why: HeldBack
    source: Piece | None = None


@dataclass(slots=True)
class _Waiting:
    event: DeviceEvent
    due_ns: int  # until when something may come that makes another thing of it
    false_trigger: FalseTrigger | None = None
    lowest: float | None = None  # the pedal's least openness since


class TriggerFilter:
    """Holds back what is no stroke of one kit."""

    def __init__(self, kit: DeviceMap) -> None:
        self.kit = kit
        self.false_triggers: deque[FalseTrigger] = deque(maxlen=256)
        """What was held back, the newest last; whoever shows them takes them out."""
        self._by_victim: dict[Piece, list[Crosstalk]] = {}
        self._by_source: dict[Piece, list[Crosstalk]] = {}
        for rule in kit.crosstalk:
            self._by_victim.setdefault(rule.victim, []).append(rule)
            self._by_source.setdefault(rule.source, []).append(rule)
        self.reset()

    def reset(self) -> None:
        """Forget what was played."""
        self._queue: deque[_Waiting] = deque()
        self._strokes: dict[Piece, _Waiting] = {}
        self._loud: dict[Piece, deque[Hit]] = {piece: deque(maxlen=8) for piece in self._by_source}
        self._chokes_ns: dict[Piece, int] = {}
        self._pedal: deque[PedalMoved] = deque()
        self._latest_ns: int | None = None
        self._settled_ns: int | None = None

    # --- in ----------------------------------------------------------------------------------------------------------

    def feed(self, event: DeviceEvent) -> bool:
        """Take the next event; whether it may sound."""
        self._latest_ns = event.at_ns
        waiting = _Waiting(event, event.at_ns)
        match event:
            case Hit():
                self._judge(event, waiting)
            case Choke():
                self._chokes_ns[event.piece] = event.at_ns
                self._blame_grab(event)
            case PedalMoved():
                self._follow_pedal(event)
            case _:
                pass
        self._queue.append(waiting)
        return waiting.false_trigger is None

    def _judge(self, hit: Hit, waiting: _Waiting) -> None:
        waiting.false_trigger = self._too_soft(hit) or self._crosstalk(hit) or self._grab(hit) or self._false_stomp(hit)
        if hit.piece in self._loud:
            self._blame(hit)
            self._loud[hit.piece].append(hit)
        waiting.false_trigger = waiting.false_trigger or self._double(hit)
        if waiting.false_trigger is None:
            self._strokes[hit.piece] = waiting
            waiting.due_ns += self._doubtful_ns(hit)

    def _too_soft(self, hit: Hit) -> FalseTrigger | None:
        return FalseTrigger(hit, HeldBack.TOO_SOFT) if hit.velocity < self.kit.pad(hit.piece).threshold else None

    def _double(self, hit: Hit) -> FalseTrigger | None:
        """A second hit within the mask time is none, unless the first may be false itself and is softer."""
        mask_ns, first = self.kit.pad(hit.piece).mask_ns, self._strokes.get(hit.piece)
        if first is None or first.false_trigger is not None or hit.at_ns - first.event.at_ns >= mask_ns:
            return None
        assert isinstance(first.event, Hit)
        if first.due_ns >= hit.at_ns and first.event.velocity < hit.velocity:
            first.false_trigger = FalseTrigger(first.event, HeldBack.DOUBLE)
            return None
        return FalseTrigger(hit, HeldBack.DOUBLE)

    def _crosstalk(self, hit: Hit) -> FalseTrigger | None:
        """Whether a stroke that came before explains this hit."""
        for rule in self._by_victim.get(hit.piece, ()):
            for source in self._loud[rule.source]:
                if hit.at_ns - source.at_ns <= rule.within_ns and hit.velocity <= rule.share * source.velocity:
                    return FalseTrigger(hit, HeldBack.CROSSTALK, rule.source)
        return None

    def _blame(self, source: Hit) -> None:
        """Hold back the hits that this one explains though they came before it."""
        for rule in self._by_source[source.piece]:
            for waiting in self._queue:
                event = waiting.event
                if not isinstance(event, Hit) or event.piece is not rule.victim or waiting.false_trigger is not None:
                    continue
                if source.at_ns - event.at_ns <= rule.before_ns and event.velocity <= rule.share * source.velocity:
                    waiting.false_trigger = FalseTrigger(event, HeldBack.CROSSTALK, source.piece)

    def _grab(self, hit: Hit) -> FalseTrigger | None:
        choked_ns = self._chokes_ns.get(hit.piece)
        if choked_ns is None or hit.velocity > self.kit.grab_velocity or hit.at_ns - choked_ns > GRAB_AFTER_NS:
            return None
        return FalseTrigger(hit, HeldBack.GRAB)

    def _blame_grab(self, choke: Choke) -> None:
        for waiting in self._queue:
            event = waiting.event
            if not isinstance(event, Hit) or event.piece is not choke.piece or event.velocity > self.kit.grab_velocity:
                continue
            if choke.at_ns - event.at_ns <= GRAB_BEFORE_NS:
                waiting.false_trigger = waiting.false_trigger or FalseTrigger(event, HeldBack.GRAB)

    def _false_stomp(self, hit: Hit) -> FalseTrigger | None:
        """A stomp just after a stroke on the hi-hat, for which the pedal hardly moved."""
        least, stroke = self.kit.foot.least_travel, self._strokes.get(Piece.HIHAT)
        if not least or hit.piece is not Piece.HIHAT_PEDAL or stroke is None or not self._pedal:
            return None
        if hit.at_ns - stroke.event.at_ns > FALSE_STOMP_NS or self._travel(hit.at_ns) >= least:
            return None
        return FalseTrigger(hit, HeldBack.FALSE_STOMP)

    def _travel(self, at_ns: int) -> float:
        """How much openness the pedal has lost within `TRAVEL_NS`."""
        while len(self._pedal) > 1 and self._pedal[1].at_ns <= at_ns - TRAVEL_NS:
            self._pedal.popleft()
        return max(moved.openness for moved in self._pedal) - self._pedal[-1].openness

    def _follow_pedal(self, moved: PedalMoved) -> None:
        if self.kit.foot.least_travel:
            self._pedal.append(moved)
            self._travel(moved.at_ns)  # forgets what is too old
        if not self.kit.foot.splash_ns:
            return
        for waiting in self._queue:
            hit = waiting.event
            if isinstance(hit, Hit) and hit.piece is Piece.HIHAT_PEDAL and moved.at_ns <= waiting.due_ns:
                waiting.lowest = min(moved.openness, 1.0 if waiting.lowest is None else waiting.lowest)
                if moved.openness - waiting.lowest >= SPLASH_OPENS_BY:
                    waiting.event = replace(hit, articulation=Articulation.SPLASH, openness=1.0)

    def _doubtful_ns(self, hit: Hit) -> int:
        """How long after this hit something may come that makes another thing of it."""
        doubt_ns = 0
        for rule in self._by_victim.get(hit.piece, ()):
            if hit.velocity <= rule.share * _HARDEST:
                doubt_ns = max(doubt_ns, rule.before_ns)
        if hit.velocity <= self.kit.grab_velocity and hit.piece in CHOKEABLE:
            doubt_ns = max(doubt_ns, GRAB_BEFORE_NS)
        if hit.piece is Piece.HIHAT_PEDAL and hit.articulation is Articulation.CHICK:
            doubt_ns = max(doubt_ns, self.kit.foot.splash_ns)
        return doubt_ns

    @property
    def waits(self) -> bool:
        """Whether something is not certain yet."""
        return bool(self._queue)

    # --- out ---------------------------------------------------------------------------------------------------------

    def certain(self) -> list[DeviceEvent]:
        """The events that are certain by what has come so far, in order."""
        return [] if self._latest_ns is None else self._release(self._latest_ns)

    def settle(self, now_ns: int) -> list[DeviceEvent]:
        """The events that are certain by the clock."""
        if not self._queue or now_ns - DRIVERS_NS <= self._queue[0].due_ns:
            return []
        self._settled_ns = now_ns - DRIVERS_NS
        return self._release(self._settled_ns)

    def overtaken_ns(self, at_ns: int) -> int | None:
        """Up to when events were let go by the clock, if something from before that comes only now, at `at_ns`.

        To be asked before each `feed`; a replay that calls `settle_until` with the answer decides alike.
        """
        settled_ns, self._settled_ns = self._settled_ns, None
        return settled_ns if settled_ns is not None and at_ns <= settled_ns else None

    def settle_until(self, until_ns: int) -> list[DeviceEvent]:
        """The events that were certain by the clock at `until_ns`."""
        return self._release(until_ns)

    def flush(self) -> list[DeviceEvent]:
        """All that still waits, as it stands."""
        return self._release(None)

    def _release(self, until_ns: int | None) -> list[DeviceEvent]:
        certain = []
        while self._queue:
            first = self._queue[0]
            doubtful = first.false_trigger is None and first.due_ns > first.event.at_ns
            if doubtful and until_ns is not None and first.due_ns >= until_ns:
                break
            self._queue.popleft()
            if first.false_trigger is None:
                certain.append(first.event)
            else:
                self.false_triggers.append(first.false_trigger)
        return certain
