"""Something that was played, or is written, sounds once through the engine: to listen back, and to compare by ear.

What was played goes to the demonstration's channel: it sounds where the student's own strokes are silent because the
module sounds them, and it reaches a MIDI output as a demonstration does. Cue times are ns from where it begins.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_S
from station.engine.messages import CUE_DTYPE, Bus, Command, EngineEvent, Play, SetBacking, Started, Stop
from station.music.performance import Performance
from station.practice.session.cues.click_pattern import leads_ns
from station.sound.track import PreparedTrack

SOON_NS = NS_PER_S // 5
"""How long after the request the first sound comes: time for the cues to reach the sound card; our choice."""
RING_NS = 3 * NS_PER_S // 2
"""How long the last stroke may ring; our choice."""


def played_cues(performance: Performance) -> NDArray[np.void]:
    """Every stroke and every grabbed cymbal of `performance` as cues (n,) of `CUE_DTYPE`, in order of time."""
    cues = np.zeros(len(performance.hits) + len(performance.chokes), CUE_DTYPE)
    strokes, chokes = np.split(cues, [len(performance.hits)])
    for name in ("at_ns", "piece", "zone", "articulation", "velocity", "openness"):
        strokes[name] = performance.hits[name]
    strokes["velocity"] = np.maximum(strokes["velocity"], 1)  # 0 would grab the cymbal
    for name in ("at_ns", "piece"):
        chokes[name] = performance.chokes[name]
    chokes["openness"] = np.nan
    cues["bus"] = Bus.DEMONSTRATION
    return cues[np.argsort(cues["at_ns"], kind="stable")]


def cues_between(cues: NDArray[np.void], start_ns: int, end_ns: int) -> NDArray[np.void]:
    """The cues in [`start_ns`, `end_ns`), from 0 on; a counted word is where its beat is, and begins before it."""
    beats = cues["at_ns"] + leads_ns(cues)
    inside = cues[(beats >= start_ns) & (beats < end_ns)].copy()
    inside["at_ns"] -= start_ns
    return inside


@dataclass(eq=False)
class Listening:
    """One hearing of `cues`, which last `length_ns`; they begin at `from_ns` of what they were taken from.

    A `track` sounds with them.
    """

    cues: NDArray[np.void]
    length_ns: int
    from_ns: int = 0
    track: PreparedTrack | None = None

    def __post_init__(self) -> None:
        self._zero_ns: int | None = None

    def start(self) -> tuple[Command, ...]:
        """The commands that make it sound."""
        play = Play(self.cues, SOON_NS)
        return (play,) if self.track is None else (SetBacking(self.track), play)

    def stop(self) -> tuple[Command, ...]:
        """The commands that end it."""
        return (Stop(),)

    def handle(self, event: EngineEvent) -> None:
        """Take one event of the engine."""
        if isinstance(event, Started):
            self._zero_ns = event.zero_ns

    def at_ns(self, now_ns: int) -> int | None:
        """What is heard at session time `now_ns`, in the time of what it was taken from; None before it begins."""
        return None if self._zero_ns is None or now_ns < self._zero_ns else now_ns - self._zero_ns + self.from_ns

    def is_over(self, now_ns: int) -> bool:
        """Whether all of it has sounded."""
        return self._zero_ns is not None and now_ns >= self._zero_ns + self.length_ns
