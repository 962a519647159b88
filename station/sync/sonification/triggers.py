"""Which sounds a phase triggers as it passes thresholds (Boyd and Godbout 2012, § 1 and figure 1).

A threshold is a share of the cycle, (φ + π)/2π in [0, 1), as the paper's § 4.1 has it. Of the phase the furthest point
reached counts, the front: it only goes forward, so that a phase that trembles about a threshold triggers it once, and
thresholds are passed in their order, each once a cycle. A phase that falls back by more than `FALL_BACK` takes the
front with it, silently, and so does a leap ahead by more: what was leapt over was not there to be heard.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from math import ceil, pi

import numpy as np
from numpy.typing import NDArray

from station.core.events import Hit
from station.core.note_map import NoteMeaning
from station.core.pieces import Limb

FALL_BACK = 0.25
"""Of a cycle (our choice: a quarter keeps the two feet apart, and no estimate of a motion that goes on errs so far)."""
USUAL_VELOCITY = 96
"""Loud enough to lead, 5 dB below the loudest (our choice)."""


@dataclass(frozen=True, slots=True)
class Trigger:
    """At `threshold` of the cycle, 0 ≤ threshold < 1, `sound` is struck; `midi_note` the number if one is meant."""

    threshold: float
    sound: NoteMeaning
    velocity: int = USUAL_VELOCITY
    midi_note: int = 0
    limb: Limb = Limb.UNKNOWN

    def hit(self, at_ns: int, device: str) -> Hit:
        """The stroke that it is at `at_ns`."""
        what = self.sound
        return Hit(
            at_ns, what.piece, what.zone, self.velocity, what.articulation, what.openness,
            self.midi_note, limb=self.limb, device=device,
        )  # fmt: skip


def share_of(phase_rad: float) -> float:
    """Where in the cycle a phase is, as thresholds count: (φ + π)/2π, from 0 to 1 for a phase in (−π, π]."""
    return (phase_rad + pi) / (2 * pi)


@dataclass(slots=True)
class TriggerRun:
    """Follows one phase and tells what it triggers. `device` names the source in the hits."""

    triggers: Sequence[Trigger]
    device: str = "phase"
    _share: float | None = None
    _turns: float = 0.0
    _front: float = 0.0
    _at_ns: int = 0
    _order: tuple[Trigger, ...] = field(init=False)

    def __post_init__(self) -> None:
        self._order = tuple(sorted(self.triggers, key=lambda trigger: trigger.threshold))

    def step(self, at_ns: int, phase_rad: float, sure: bool) -> list[Hit]:
        """What the next phase triggers, in order: the hits lie between the time of the last one and `at_ns`.

        Where the tracker is not `sure` the front goes on, and nothing sounds.
        """
        share = share_of(phase_rad)
        if self._share is None:
            self._share, self._turns, self._front, self._at_ns = share, share, share, at_ns
            return []
        before, before_ns = self._turns, self._at_ns
        self._turns += (share - self._share + 0.5) % 1.0 - 0.5
        self._share, self._at_ns = share, at_ns
        front = self._front
        if abs(self._turns - front) > FALL_BACK:
            self._front = self._turns
            return []
        self._front = max(front, self._turns)
        if not sure or self._front == front:
            return []
        gap_ns, rise = at_ns - before_ns, self._turns - before
        return [
            trigger.hit(at_ns - round(gap_ns * (self._turns - at) / rise), self.device)
            for at, trigger in self._passed(front)
        ]

    def _passed(self, after: float) -> list[tuple[float, Trigger]]:
        """The thresholds beyond `after`, up to the front, and where they lie in turns, in order."""
        found = []
        for trigger in self._order:
            at = ceil(after - trigger.threshold) + trigger.threshold
            if at <= after:  # it lies on `after` itself, which was reached before
                at += 1
            if at <= self._front:
                found.append((at, trigger))
        return sorted(found, key=lambda pair: pair[0])


def triggered(
    triggers: Sequence[Trigger], at_ns: NDArray[np.int64], phase_rad: NDArray[np.float64], sure: NDArray[np.bool_]
) -> list[Hit]:
    """What a whole recording of phases triggers; three columns of shape (n,)."""
    run = TriggerRun(triggers)
    steps: Iterable[tuple[int, float, bool]] = zip(at_ns.tolist(), phase_rad.tolist(), sure.tolist(), strict=True)
    return [hit for step in steps for hit in run.step(*step)]
