"""Somebody at a fake kit on a serial line: watches what is asked of them, and plays it in real time.

They know what any student knows: the score that is shown, the tempo of the click, and when it began to sound.
"""

import subprocess
import sys
import time
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from station.core.units import NS_PER_MS, NS_PER_S
from station.devices.mapping.presets import GENERAL_MIDI_PRESET
from station.practice.session.pausing import start_of
from station.practice.session.plan import Phase
from station.practice.session.session import Session
from station.simulation.student_spec import parse_spec
from station.simulation.virtual_student import VirtualStudent

SNARE, KICK, TOM_1, TOM_2, FLOOR_TOM, HIHAT, CRASH, RIDE = 38, 36, 50, 48, 43, 42, 49, 51
"""What a General MIDI kit sends."""


@dataclass(frozen=True, slots=True)
class Playing:
    """How they play: as a virtual student of that `spec`, `lag_ms` later on every pad, until bar `stops`.

    Bars count from 0 over all passes; None plays through. Whoever has stopped plays on after the pause.
    """

    spec: str = "intermediate,seed=4"
    lag_ms: float = 0.0
    stops: int | None = None


class PtyStudent:
    """Plays sessions on a kit at `path`; use it as a context manager."""

    def __init__(self, path: Path) -> None:
        self.device = f"serial:{path}"
        self.playing: Playing | None = Playing()
        """How they play from now on; None leaves sessions alone."""
        self._known: tuple[Session, int] | None = None
        self._students: dict[str, VirtualStudent] = {}
        self._stopped: list[Session] = []
        script = Path(__file__).with_name("pty_kit.py")
        self._kit = subprocess.Popen(
            [sys.executable, str(script), str(path)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )
        assert self._kit.stdout is not None
        self._kit.stdout.readline()

    def watch(self, session: Session) -> None:
        """Look at what is asked; called in every frame."""
        zero_ns = session.heard.zero_ns
        if zero_ns is None or session.paused:
            if self._known is not None:
                self.rest()
            self._known = None
        elif self.playing is not None and self._known != (session, zero_ns):
            self._known = session, zero_ns
            self._learn(session, zero_ns, self.playing)

    def _learn(self, session: Session, zero_ns: int, playing: Playing) -> None:
        """What they will play from now on, until the music stops."""
        plan, segment = session.plan, session.state().segment
        jump_ns = segment.start_ns if session.pauses and segment.phase is Phase.COUNT_IN else 0
        begun_ns = zero_ns + plan.passes_start_ns - jump_ns  # as if output and kit were never late
        until_ns = None
        if playing.stops is not None and session not in self._stopped:
            self._stopped.append(session)
            until_ns = start_of(plan.score, playing.stops)
        student = self._students.setdefault(playing.spec, VirtualStudent(parse_spec(playing.spec), GENERAL_MIDI_PRESET))
        lag_ns = round(playing.lag_ms * NS_PER_MS)
        self._play(
            (begun_ns + at_ns + lag_ns, data)
            for at_ns, data in student.play(plan.score).midi
            if until_ns is None or at_ns < until_ns
        )

    def strike(self, *notes: int, apart_s: float = 0.0, velocity: int = 96) -> None:
        """Strike pads now, one after the other."""
        now_ns = time.monotonic_ns() + NS_PER_MS
        self._play(
            (now_ns + round(place * apart_s * NS_PER_S), bytes((0x99, note, velocity)))
            for place, note in enumerate(notes)
        )

    def rest(self) -> None:
        """Play nothing of what they meant to."""
        self._tell("rest\n")

    def _play(self, strokes: Iterable[tuple[int, bytes]]) -> None:
        now_ns = time.monotonic_ns()
        self._tell("".join(f"{at_ns} {data.hex()}\n" for at_ns, data in strokes if at_ns >= now_ns))

    def _tell(self, lines: str) -> None:
        assert self._kit.stdin is not None
        self._kit.stdin.write(lines)
        self._kit.stdin.flush()

    def __enter__(self) -> "PtyStudent":
        return self

    def __exit__(self, *_: object) -> None:
        self._kit.communicate()
