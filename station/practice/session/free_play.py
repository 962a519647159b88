"""Just play: a click if one is asked for, every stroke kept, nothing written, nothing judged.

A state machine as `practice.session` is: events of the engine and time in, what was played out. Take time is
nanoseconds from the first click as the student heard it (`session.engine_state`); the bars are 4/4, for nothing is
written.
"""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from station.core.events import Choke, Hit
from station.core.pieces import word
from station.core.units import NS_PER_MS, NS_PER_S
from station.devices.capture.capture import Capture, check_strokes
from station.devices.capture.replay import replay, transport_zeros_ns
from station.engine.messages import CUE_DTYPE, Command, EngineEvent, Play, Stop
from station.music.performance import Performance
from station.music.tempo import TempoChange, TempoMap
from station.practice.session.cues.click_pattern import ClickPattern, click_cues
from station.practice.session.cues.listening import RING_NS, Listening, cues_between, played_cues
from station.practice.session.device_latency import Latency
from station.practice.session.engine_state import EngineState

LEAD_IN_NS = 300 * NS_PER_MS
"""How long after the start the first click is heard; as in a session."""
LONGEST_NS = 3600 * NS_PER_S
"""A take ends after an hour (our choice: over twice the longest session that helps, TEACHING's 25 minutes)."""
BEATS = 4
SCHEMA = "drum-station/take/1"


@dataclass(frozen=True, slots=True)
class FreeClick:
    """The tempo in beats a minute, and what clicks; None for silence."""

    tempo_bpm: float
    pattern: ClickPattern | None

    @property
    def beat_ns(self) -> float:
        """How long a beat lasts."""
        return 60 * NS_PER_S / self.tempo_bpm

    def cues(self) -> NDArray[np.void]:
        """An hour of clicks, (n,) of `CUE_DTYPE`."""
        if self.pattern is None:
            return np.empty(0, CUE_DTYPE)
        tempo_map = TempoMap.build([TempoChange.from_bpm(0, self.tempo_bpm)])
        return click_cues(tempo_map, int(tempo_map.ticks_at_ns(LONGEST_NS)), self.pattern)


@dataclass(eq=False)
class FreePlay:
    """One take; call `start`, then `handle` every event and `advance` the time, until `over` or the student stops."""

    click: FreeClick
    latency: Latency = field(default_factory=Latency)

    def __post_init__(self) -> None:
        self.heard = EngineState(self.latency)
        """What the engine has said."""
        self._hits: list[Hit] = []
        self._now_ns = 0

    def start(self) -> tuple[Command, ...]:
        """The commands that set the engine going."""
        return (Play(self.click.cues(), LEAD_IN_NS),)

    def stop(self) -> tuple[Command, ...]:
        """The commands that end it."""
        return (Stop(),)

    def handle(self, event: EngineEvent) -> None:
        """Take one event of the engine."""
        self.heard.handle(event)
        if isinstance(event, Hit) and (played_ns := self.heard.played_ns(event)) is not None:
            self._hits.append(replace(event, at_ns=played_ns))

    def advance(self, now_ns: int) -> None:
        """Tell the session time."""
        self._now_ns = max(now_ns, self._now_ns)

    @property
    def at_ns(self) -> int | None:
        """Take time now, None before the first click."""
        return self.heard.transport_ns(self._now_ns)

    @property
    def over(self) -> bool:
        """Whether the longest take is full."""
        return self.at_ns is not None and self.at_ns >= LONGEST_NS

    @property
    def hits(self) -> Sequence[Hit]:
        """What was played, in take time, in the order in which it came."""
        return self._hits

    def document(self, student: str) -> dict[str, object]:
        """What is kept of the take beside its capture."""
        counts = Counter(word(hit.piece) for hit in self._hits)
        return {
            "schema": SCHEMA,
            "student": student,
            "tempo_bpm": round(self.click.tempo_bpm, 3),
            "click": self.click.pattern is not None,
            "length_s": round(max(self.at_ns or 0, 0) / NS_PER_S, 3),
            "strokes": len(self._hits),
            "strokes_of": dict(counts),
            "latency": self.latency.words(self._hits[0].device if self._hits else None, self.heard.output),
        }


def take_of(capture: Capture, latency: Latency, output: str | None) -> Performance:
    """What `capture` holds, in take time; empty where its transport never ran. Raises `BadInput` as `replay` does."""
    zeros_ns = transport_zeros_ns(capture)
    if not zeros_ns:
        return Performance.from_hits([])
    heard = EngineState(latency, output=output, zero_ns=zeros_ns[-1])
    strokes = [event for event in replay(capture) if isinstance(event, Hit | Choke)]
    check_strokes([zeros_ns[-1], *(stroke.at_ns for stroke in strokes)])
    played = [replace(stroke, at_ns=at_ns) for stroke in strokes if (at_ns := heard.played_ns(stroke)) is not None]
    return Performance.from_hits(
        [stroke for stroke in played if isinstance(stroke, Hit)], [c for c in played if isinstance(c, Choke)]
    )


def listening_back(take: Performance, click: FreeClick) -> Listening | None:
    """The take from the bar of its first stroke to the ringing of its last, with its click; None where it is empty."""
    if not len(take):
        return None
    bar_ns = BEATS * click.beat_ns
    start_ns = round(take.hits["at_ns"][0] // bar_ns * bar_ns)
    end_ns = int(take.hits["at_ns"][-1]) + RING_NS
    cues = np.concatenate([played_cues(take), click.cues()])
    cues = cues[np.argsort(cues["at_ns"], kind="stable")]
    return Listening(cues_between(cues, start_ns, end_ns), end_ns - start_ns, start_ns)
