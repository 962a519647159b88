"""Somebody at a fake kit on a serial line: watches what is asked of them, and plays it as bytes, in real time.

They know what any student knows: the score that is shown, the tempo of the click, and when it began to sound.
"""

import heapq
import threading
import time
from collections.abc import Sequence
from dataclasses import dataclass

from station.bench.rigs.devices.serial_kit import SerialKit
from station.core.units import NS_PER_MS, NS_PER_S
from station.devices.mapping.presets import GENERAL_MIDI_PRESET
from station.practice.session.pausing import start_of
from station.practice.session.plan import Phase
from station.practice.session.session import Session
from station.simulation.student_spec import parse_spec
from station.simulation.virtual_student import VirtualStudent

_FINE_S = 0.002
SNARE, KICK, TOM_1, TOM_2, FLOOR_TOM, HIHAT, CRASH = 38, 36, 48, 45, 43, 42, 49
"""What a General MIDI kit sends."""


def stroke(note: int, velocity: int = 96) -> bytes:
    """The bytes of a stroke on channel 10."""
    return bytes((0x99, note, velocity))


@dataclass(frozen=True, slots=True)
class Playing:
    """How they play: as a virtual student of that `spec`, `lag_ms` later on every pad, until bar `stops`.

    Bars count from 0 over all passes; None plays through. Whoever has stopped plays on after the pause.
    """

    spec: str = "intermediate,seed=4"
    lag_ms: float = 0.0
    stops: int | None = None


class PtyStudent:
    """Plays sessions on `kit`; use it as a context manager."""

    def __init__(self, kit: SerialKit) -> None:
        self._kit = kit
        self.playing: Playing | None = Playing()
        """How they play from now on; None leaves sessions alone."""
        self._due: list[tuple[int, int, bytes]] = []
        self._count = 0
        self._known: tuple[int, int] | None = None
        self._students: dict[str, VirtualStudent] = {}
        self._stopped: set[int] = set()
        self._change = threading.Condition()
        self._ends = False
        self._thread = threading.Thread(target=self._play, name="student", daemon=True)

    def watch(self, session: Session) -> None:
        """Look at what is asked; called in every frame."""
        zero_ns = session.heard.zero_ns
        if zero_ns is None or session.paused:
            self._known = None
            self.rest()
            return
        if self.playing is None or self._known == (id(session), zero_ns):
            return
        self._known = (id(session), zero_ns)
        self._learn(session, zero_ns, self.playing)

    def _learn(self, session: Session, zero_ns: int, playing: Playing) -> None:
        """What they will play from now on, until the music stops."""
        plan, segment = session.plan, session.state().segment
        jump_ns = segment.start_ns if session.pauses and segment.phase is Phase.COUNT_IN else 0
        begun_ns = zero_ns + session.heard.latency.of_output(session.heard.output) + plan.passes_start_ns - jump_ns
        until_ns = None
        if playing.stops is not None and id(session) not in self._stopped:
            self._stopped.add(id(session))
            until_ns = start_of(plan.score, playing.stops)
        student = self._students.setdefault(playing.spec, VirtualStudent(parse_spec(playing.spec), GENERAL_MIDI_PRESET))
        lag_ns = round(playing.lag_ms * NS_PER_MS)
        played = [
            (begun_ns + at_ns + lag_ns, data)
            for at_ns, data in student.play(plan.score).midi
            if until_ns is None or at_ns < until_ns
        ]
        self._put(played)

    def strike(self, *notes: int, apart_s: float = 0.0, velocity: int = 96) -> None:
        """Strike pads now, one after the other."""
        now_ns = time.monotonic_ns()
        self._put(
            [(now_ns + round(place * apart_s * NS_PER_S), stroke(note, velocity)) for place, note in enumerate(notes)]
        )

    def rest(self) -> None:
        """Play nothing of what they meant to."""
        with self._change:
            self._due.clear()

    def _put(self, strokes: Sequence[tuple[int, bytes]]) -> None:
        with self._change:
            for at_ns, data in strokes:
                if at_ns >= time.monotonic_ns() - NS_PER_S // 100:
                    self._count += 1
                    heapq.heappush(self._due, (at_ns, self._count, data))
            self._change.notify()

    def _play(self) -> None:
        while True:
            with self._change:
                while not self._ends and (not self._due or self._wait_s() > _FINE_S):
                    self._change.wait(self._wait_s() - _FINE_S if self._due else None)
                if self._ends:
                    return
                at_ns, _, data = heapq.heappop(self._due)
            while time.monotonic_ns() < at_ns:
                time.sleep(0.0002)
            self._kit.play(data)

    def _wait_s(self) -> float:
        return (self._due[0][0] - time.monotonic_ns()) / NS_PER_S

    def __enter__(self) -> "PtyStudent":
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        with self._change:
            self._ends = True
            self._change.notify()
        self._thread.join()
