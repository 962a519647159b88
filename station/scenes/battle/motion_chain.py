"""One drummer's motion over a whole battle, planned link by link as it becomes known what they play, without a jump.

A phrase is known a beat before it begins, and a drummer for four bars takes up to some seconds to plan while others
use the processor, a first bar a third of one (`benchmarks/battle_stage.py`). So a phrase is planned in links: its first
bar, then two bars at a time, each with the bar before it once more. In that bar both drummers make the same strokes
with the same limbs, so that their poses hardly differ, and the later one already prepares what comes after it: over the
last part of the bar the motion goes from one to the other (`pose_mix`), and the end of the old motion and the
preparation of the new one overlap as they do in a drummer. A link that is late takes over when it is there, as softly;
until then the one before goes on, to a rest.

Times are battle time.
"""

from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb
from station.core.units import NS_PER_MS, NS_PER_S
from station.motion.drummer import Drummer
from station.motion.kinematics.figure import Figure, figure_of
from station.motion.kinematics.pose import Pose
from station.motion.kit.kit import Kit, load_kit
from station.motion.style.style import Style
from station.music.score import NOTE_DTYPE, Score
from station.practice.battle.ground import Ground
from station.scenes.battle.pose_mix import minimum_jerk, mixed
from station.scenes.session_part import AHEAD

FIRST_BARS, NEXT_BARS = 1, 2
"""Bars of a phrase's first link and of those after it."""
TAKES_OVER_NS = 600 * NS_PER_MS
"""How long the motion goes from one link to the next (our choice: a hand comes from its thigh to a drum slowly then,
and it is no longer than the shortest notice that a phrase is chosen with)."""
TAKES_OVER_BARS = 0.8
"""The most of a bar that it takes, so that at fast tempi one link has taken over before the next one does."""
LATE_NS = 250 * NS_PER_MS
"""The same of a link that comes late (our choice: a hand crosses a kit in that time between two strokes)."""
_KEPT_LINKS = 24
"""Links before the one that moves now: after a pause a part is played again from its beginning."""


@dataclass(frozen=True, slots=True)
class Body:
    """Who moves: on `kit`, with the body of `figure`, in the manner of `style`."""

    kit: Kit = field(default_factory=load_kit)
    figure: Figure = field(default_factory=figure_of)
    style: Style = field(default_factory=Style)


@dataclass(eq=False)
class _Link:
    """A drummer whose score's tick 0 is at `zero_ns`; who takes over in the time `over`, from rest to rest."""

    zero_ns: int
    over: tuple[int, int]
    coming: Future[Drummer]
    plan: Callable[[], Drummer] | None = None
    """What is planned when it is first seen, where nobody waits for it."""

    def seen(self, now_ns: int) -> bool:
        """Whether it is there; one that is first seen when it should have begun to take over does so from now on."""
        begin_ns, end_ns = self.over
        if self.plan is not None:
            self.coming.set_result(self.plan())
            self.plan = None
        if not self.coming.done():
            if now_ns > begin_ns:
                self.over = now_ns, max(end_ns, now_ns + LATE_NS)
            return False
        return True

    def share(self, at_ns: int) -> float:
        """How far it has taken over."""
        begin_ns, end_ns = self.over
        return minimum_jerk((at_ns - begin_ns) / (end_ns - begin_ns))

    def pose(self, at_ns: int) -> Pose:
        """What its drummer does."""
        return self.coming.result().pose((at_ns - self.zero_ns) / NS_PER_S)


class MotionChain:
    """The motion of `body` on `ground`.

    Links are planned on a thread, or if it `waits` when their time comes, as a film wants it.

    Times are asked for in order, but for a pause, after which a part is played again.
    """

    def __init__(self, ground: Ground, body: Body, waits: bool = False) -> None:
        self._ground, self._body, self._waits = ground, body, waits
        self._notes: NDArray[np.void] = np.zeros(0, NOTE_DTYPE)
        self._limbs: dict[tuple[int, int, float], int] = {}
        self._takes_over_ns = min(TAKES_OVER_NS, round(TAKES_OVER_BARS * ground.ns_of_bars(1)))
        rest: Future[Drummer] = Future()
        rest.set_result(self._drummer(self._notes))
        self._links = [_Link(0, (-(2**62), -(2**61)), rest)]
        self.kit = rest.result().kit
        """The kit with its throne set to the figure."""

    def add(self, first_bar: int, bars: int, notes: NDArray[np.void]) -> None:
        """Let `notes` (n,) of `NOTE_DTYPE` be played in `bars` from the battle's bar `first_bar` on, in order of bars.

        Their ticks count from there. What is on the downbeat after the bars is a landing: whatever is added there is
        played with it.
        """
        moved = notes.copy()
        moved["tick"] += first_bar * self._ground.bar_ticks
        recent = self._notes[self._notes["tick"] >= (first_bar - 2) * self._ground.bar_ticks]
        self._notes = _together(recent, moved)
        at, size = 0, FIRST_BARS
        while at < bars:
            self._submit(first_bar + at, min(size, bars - at))
            at, size = at + size, NEXT_BARS

    def cut(self, first_bar: int) -> None:
        """Let what was added from the battle's bar `first_bar` on not be played after all."""
        begin_ns = self._ns_of_bar(first_bar)
        self._links = [link for link in self._links if link.over[1] < begin_ns or link is self._links[0]]
        self._notes = self._notes[self._notes["tick"] <= first_bar * self._ground.bar_ticks]

    def pose(self, at_ns: int) -> Pose:
        """What they do at a time, of all that is planned by now."""
        taking: list[_Link] = []
        for place in range(len(self._links) - 1, -1, -1):
            link = self._links[place]
            if link.over[0] <= at_ns and link.seen(at_ns):
                taking.append(link)
                if at_ns >= link.over[1]:
                    del self._links[: max(place - _KEPT_LINKS, 0)]
                    break
        pose = taking.pop().pose(at_ns)
        while taking:
            link = taking.pop()
            pose = mixed(pose, link.pose(at_ns), link.share(at_ns))
        return pose

    def _submit(self, first_bar: int, bars: int) -> None:
        begin = (first_bar - 1) * self._ground.bar_ticks
        end = (first_bar + bars) * self._ground.bar_ticks  # a stroke there is the landing
        tick = self._notes["tick"]
        notes = self._notes[(tick >= begin) & (tick <= end)]
        notes["tick"] -= begin

        def plan() -> Drummer:
            return self._drummer(self._with_limbs(notes, begin), begin)

        start_ns, zero_ns = (self._ns_of_bar(bar) for bar in (first_bar, first_bar - 1))
        over = start_ns - self._takes_over_ns, start_ns
        if self._waits:
            self._links.append(_Link(zero_ns, over, Future(), plan))
        else:
            self._links.append(_Link(zero_ns, over, AHEAD.submit(plan)))

    def _ns_of_bar(self, bar: int) -> int:
        return self._ground.ns_of_bars(bar) if bar >= 0 else -self._ground.ns_of_bars(-bar)

    def _drummer(self, notes: NDArray[np.void], begin: int = 0) -> Drummer:
        body = self._body
        score = Score.from_array(notes, self._ground.tempo_map)
        drummer = Drummer(score, body.kit, body.figure, body.style)
        for note, limb in zip(score.notes, drummer.assignment.limbs.tolist(), strict=True):
            self._limbs[_key(note, begin)] = limb
        return drummer

    def _with_limbs(self, notes: NDArray[np.void], begin: int) -> NDArray[np.void]:
        """The strokes, those that a link before has made already with its limbs."""
        made = [self._limbs.get(_key(note, begin), int(note["limb"])) for note in notes]
        notes["limb"] = np.array(made, np.int8) if made else Limb.UNKNOWN
        return notes


def _key(note: np.void, begin: int) -> tuple[int, int, float]:
    """What tells a stroke of the battle from all others."""
    return int(note["tick"]) + begin, int(note["piece"]), float(note["lead_ms"])


def _together(before: NDArray[np.void], notes: NDArray[np.void]) -> NDArray[np.void]:
    """All strokes of both, where a landing meets the first strokes of what follows.

    Of one piece at one tick the later is left; a hand that lands somewhere makes no other stroke at that tick.
    """
    new = {_key(note, 0) for note in notes}
    kept = before[[_key(note, 0) not in new for note in before]] if len(before) else before
    lands = {(int(note["tick"]), int(note["limb"])) for note in kept if note["limb"] in _HANDS}
    free = [(int(note["tick"]), int(note["limb"])) not in lands for note in notes]
    return np.concatenate([kept, notes[free]])


_HANDS = (Limb.RIGHT_HAND, Limb.LEFT_HAND)
