"""A loop played over a click and recorded pass by pass: how a groove is played into a lesson.

A state machine as `free_play` is: events of the engine and time in, the strokes of each pass out. Loop time is
nanoseconds from tick 0 of the loop as the student heard it, in its pass; in the count-in it is negative. A stroke just
before a pass belongs to it, for nobody hits the first beat to the millisecond: its time is negative then.
"""

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from station.core.events import Hit
from station.core.units import NS_PER_MS, NS_PER_S
from station.engine.messages import Command, EngineEvent, Play, Resume, Stop
from station.music.score import Score
from station.practice.session.cues.click_pattern import PLAIN, ClickPattern, click_cues, count_in, counting
from station.practice.session.cues.stroke_cues import demonstration_cues, in_order, moved_by
from station.practice.session.device_latency import Latency
from station.practice.session.engine_state import EngineState
from station.practice.session.plan import MAX_LOOPS

LEAD_IN_NS = 300 * NS_PER_MS
"""How long after the start the first click is heard; as in a session."""
LONGEST_NS = 1200 * NS_PER_S
"""A recording ends after twenty minutes (our choice: nobody looks for a groove longer than a practice lasts)."""
EARLY_NS = 60 * NS_PER_MS
"""So long before a pass a stroke belongs to it (HUMANS, Timing: twice a beginner's spread of 30 ms), but never longer
than an eighth of the loop (our choice)."""
_ARRIVES_NS = 150 * NS_PER_MS
"""A pass is complete so long after its end: its last strokes are still on their way (DESIGN: within 30 ms; our choice
of five times that)."""


@dataclass(frozen=True, slots=True)
class RecordedPass:
    """The strokes of the `index`-th pass from 0, in order, `at_ns` in loop time; `is_whole` if it was played out."""

    index: int
    hits: tuple[Hit, ...]
    is_whole: bool = True


@dataclass(eq=False)
class LoopRecording:
    """One recording over `loop`, at the tempo it has; with `guide` what stands in the loop sounds, too.

    Call `start`, then `handle` every event and `advance` the time, and ask for the passes that are `finished`, until
    `over` or the teacher stops; then `rest` has the pass that was cut off. With `click` None only the count-in sounds.
    """

    loop: Score
    click: ClickPattern | None = PLAIN
    latency: Latency = field(default_factory=Latency)
    count_in_bars: int = 1
    guide: bool = False

    def __post_init__(self) -> None:
        self.heard = EngineState(self.latency)
        """What the engine has said."""
        assert self.loop.length_ns > 0, "a loop lasts"
        self.passes = min(max(LONGEST_NS // self.loop.length_ns, 1), MAX_LOOPS)
        """How often the loop is played at most."""
        self._count_ns = self._count.length_ns
        self._early_ns = min(EARLY_NS, self.loop.length_ns // 8)
        self._hits: dict[int, list[Hit]] = {}
        self._now_ns, self._told = 0, 0

    # --- sounding ----------------------------------------------------------------------------------------------------

    def start(self) -> tuple[Command, ...]:
        """The commands that set the engine going."""
        return (Play(self._cues(), LEAD_IN_NS),)

    def with_loop(self, loop: Score) -> tuple[Command, ...]:
        """The commands that let `loop` sound in place of what stood there, from here on; none where nothing of it does.

        A loop that lasts as long: where it lasts longer or shorter, what was begun sounds on.
        """
        zero_ns = self.heard.zero_ns
        if not self.guide or zero_ns is None or loop.length_ns != self.loop.length_ns:
            return ()
        self.loop = loop
        return (Resume(self._cues(), zero_ns),)

    def stop(self) -> tuple[Command, ...]:
        """The commands that end it."""
        return (Stop(),)

    def _cues(self) -> NDArray[np.void]:
        counted = counting(self.click or PLAIN)
        once = self.loop.repeated(self.passes)
        parts = [click_cues(self._count.tempo_map, self._count.end_tick, counted)]
        if self.click is not None:
            parts.append(moved_by(click_cues(once.tempo_map, once.end_tick, self.click), self._count_ns))
        if self.guide:
            parts.append(moved_by(demonstration_cues(once), self._count_ns))
        return in_order(parts)

    @property
    def _count(self) -> Score:
        tempo_map, end_tick = count_in(self.loop.tempo_map, self.count_in_bars)
        return Score.from_notes([], tempo_map, end_tick)

    # --- listening ---------------------------------------------------------------------------------------------------

    def handle(self, event: EngineEvent) -> None:
        """Take one event of the engine."""
        self.heard.handle(event)
        if isinstance(event, Hit) and (played_ns := self.heard.played_ns(event)) is not None:
            index, at_ns = divmod(played_ns - self._count_ns + self._early_ns, self.loop.length_ns)
            if 0 <= index < self.passes:
                self._hits.setdefault(index, []).append(replace(event, at_ns=at_ns - self._early_ns))

    def advance(self, now_ns: int) -> None:
        """Tell the recording the time."""
        self._now_ns = max(now_ns, self._now_ns)

    @property
    def _since_ns(self) -> int | None:
        """Time since the first pass began, negative in the count-in; None before the first click."""
        at_ns = self.heard.transport_ns(self._now_ns)
        return None if at_ns is None else at_ns - self._count_ns

    @property
    def at_ns(self) -> int | None:
        """Loop time now, negative in the count-in; None before the first click."""
        since = self._since_ns
        return since if since is None or since < 0 else since % self.loop.length_ns

    @property
    def at_tick(self) -> int | None:
        """Where in the loop it sounds now, in ticks; None before the first pass."""
        at_ns = self.at_ns
        return None if at_ns is None or at_ns < 0 else int(self.loop.tempo_map.ticks_at_ns(at_ns))

    @property
    def pass_index(self) -> int:
        """Which pass sounds now, from 0; −1 before the first."""
        return -1 if (since := self._since_ns) is None else max(since // self.loop.length_ns, -1)

    @property
    def struck(self) -> tuple[Hit, ...]:
        """What was struck in the pass that sounds now, in the order in which it came, `at_ns` in loop time."""
        return tuple(self._hits.get(self.pass_index, ()))

    @property
    def over(self) -> bool:
        """Whether the longest recording is full."""
        return self._complete >= self.passes

    @property
    def _complete(self) -> int:
        """How many passes are at their end, their last strokes included."""
        since = self._since_ns
        ended = -1 if since is None else (since + self._early_ns - _ARRIVES_NS) // self.loop.length_ns
        return min(max(ended, 0), self.passes)

    def finished(self) -> list[RecordedPass]:
        """The passes that came to their end since the last call, those without a stroke left out."""
        passes = range(self._told, self._complete)
        self._told = max(self._told, self._complete)
        return [self._pass(index) for index in passes if index in self._hits]

    def rest(self) -> list[RecordedPass]:
        """What was played and no pass has told: the pass that was cut off, and the first strokes of the next."""
        left = sorted(index for index in self._hits if index >= self._told)
        self._told = self.passes
        ended = self._complete
        return [replace(self._pass(index), is_whole=index < ended) for index in left]

    def _pass(self, index: int) -> RecordedPass:
        return RecordedPass(index, tuple(sorted(self._hits[index], key=lambda hit: hit.at_ns)))
