"""What a drum module tells of the touches: hits with its latency, its jitter and its slips.

The figures are those that owners measure: 3–5 ms from the stroke to the message, half a millisecond to a millisecond of
jitter, and 0.96 ms a message on a MIDI cable (three bytes of ten bits at 31,250 baud, MIDI 1.0 § 1).
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.events import Hit
from station.core.pieces import Articulation, Piece, Zone
from station.core.units import NS_PER_S
from station.simulation.sticks.swing_contact import Contact
from station.simulation.sticks.swing_spec import StrokeKind, velocity_for_speed

MESSAGE_S = 30 / 31_250


@dataclass(frozen=True, slots=True)
class ModuleSpec:
    """A drum module: what it delays, by how much it varies (SD), what it does not hear.

    `mask_s` is its retrigger time on one pad, `least_m_s` its threshold; `missed` and `false` are shares of all hits.
    """

    device: str = "kit"
    latency_s: float = 0.004
    jitter_s: float = 0.00075
    velocity_sd: float = 4.0
    least_m_s: float = 0.35
    mask_s: float = 0.012
    missed: float = 0.0
    false: float = 0.0


def pad_hits(
    touches: Sequence[Contact], module: ModuleSpec, rng: np.random.Generator
) -> tuple[tuple[Hit, ...], NDArray[np.int64]]:
    """The hits in order of their messages, and which of `touches` each was (n,), −1 for a false one."""
    heard = _heard(touches, module, rng)
    messages = [(touches[row].onset_s, row) for row in heard]
    messages += [(t.onset_s + rng.uniform(-0.2, 0.2), -1) for t in touches if rng.uniform() < module.false]
    told = sorted((at_s + module.latency_s + rng.normal(0, module.jitter_s), row) for at_s, row in messages)
    hits, free_s = [], -np.inf
    for at_s, row in told:
        free_s = max(at_s, free_s) + MESSAGE_S
        hits.append(_hit(free_s, touches[row] if row >= 0 else None, module, rng))
    return tuple(hits), np.array([row for _, row in told], np.int64)


def _heard(touches: Sequence[Contact], module: ModuleSpec, rng: np.random.Generator) -> list[int]:
    deaf_until: dict[Piece, float] = {}
    heard = []
    for row, touch in enumerate(touches):
        silent = touch.kind in (StrokeKind.AIR, StrokeKind.CLICK) or touch.speed_m_s < module.least_m_s
        if silent or touch.onset_s < deaf_until.get(touch.piece, -np.inf) or rng.uniform() < module.missed:
            continue
        deaf_until[touch.piece] = touch.onset_s + module.mask_s
        heard.append(row)
    return heard


def _hit(at_s: float, touch: Contact | None, module: ModuleSpec, rng: np.random.Generator) -> Hit:
    usual = 30.0 if touch is None else velocity_for_speed(touch.speed_m_s)
    velocity = int(np.clip(np.rint(usual + rng.normal(0, module.velocity_sd)), 1, 127))
    piece, zone = (Piece.SNARE, Zone.HEAD) if touch is None else (touch.piece, touch.zone)
    articulation = Articulation.RIM_SHOT if zone is Zone.RIM else Articulation.NORMAL
    return Hit(round(at_s * NS_PER_S), piece, zone, velocity, articulation, device=module.device)
