"""The drumstick as a rigid body with one bending mode, and what happens while it touches something.

Distances along the stick are metres from its butt. The stick is a 5A of hickory, 406 mm long and 14.4 mm thick; it is
held a third of its length from the butt (`shared/HUMANS.md`; the makers' tables agree on both). Mass, centre of mass
and inertia follow from a cylinder of hickory (720 kg/m³, 15 GPa along the grain: Wood Handbook, FPL-GTR-282, table 5-3)
whose last eighth tapers to half the thickness.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

LENGTH_M = 0.406
FULCRUM_M = LENGTH_M / 3
THICKNESS_M = 0.0144
DENSITY_KG_M3 = 720.0
STIFFNESS_PA = 15e9
TAPERED_FROM_M = LENGTH_M * 7 / 8
TIP_THINNER = 0.5
HAND_MASS_KG = 0.1
"""What of the fingers moves with the fulcrum at an impact; our choice: thumb, forefinger and their pads."""

RING_S = 0.012
"""Decay of the bending mode in a hand that holds the stick; our choice: a held stick clicks, it does not ring."""

FREE_BEAM = 4.730041
"""First root of cos k cosh k = 1: the free-free beam (Rao, Mechanical Vibrations, table 8.4)."""

_SLICES = 2000


@dataclass(frozen=True, slots=True)
class StickBody:
    """Mass in kg, centre of mass in m from the butt, inertia about it in kg m², first bending mode in Hz."""

    mass_kg: float
    centre_m: float
    inertia_kg_m2: float
    bending_hz: float


def stick_body() -> StickBody:
    """The 5A; summed over thin slices."""
    x = (np.arange(_SLICES) + 0.5) * LENGTH_M / _SLICES
    along_taper = np.clip((x - TAPERED_FROM_M) / (LENGTH_M - TAPERED_FROM_M), 0, 1)
    thickness = THICKNESS_M * (1 - (1 - TIP_THINNER) * along_taper)
    slices = DENSITY_KG_M3 * np.pi / 4 * thickness**2 * LENGTH_M / _SLICES
    mass = float(slices.sum())
    centre = float((slices * x).sum() / mass)
    inertia = float((slices * (x - centre) ** 2).sum())
    wave = np.sqrt(STIFFNESS_PA / DENSITY_KG_M3) * THICKNESS_M / 4
    return StickBody(mass, centre, inertia, float(FREE_BEAM**2 * wave / (2 * np.pi * LENGTH_M**2)))


STICK_5A = stick_body()


def bending_shape(at_m: float) -> float:
    """Deflection of the first bending mode at `at_m` from the butt, 2 at both ends."""
    s = FREE_BEAM * at_m / LENGTH_M
    ratio = (np.cosh(FREE_BEAM) - np.cos(FREE_BEAM)) / (np.sinh(FREE_BEAM) - np.sin(FREE_BEAM))
    return float(np.cosh(s) + np.cos(s) - ratio * (np.sinh(s) + np.sin(s)))


def fulcrum_kick_m(struck_m: float, body: StickBody = STICK_5A) -> float:
    """Acceleration of the fulcrum for one rad/s² of the stick while it is struck at `struck_m` from the butt, in m.

    Newton and Euler for a stick with `HAND_MASS_KG` at its fulcrum. Nearly 0 at the tip: of a uniform rod held at a
    third the end is the centre of percussion, which is why a stick is held there.
    """
    c, arm = body.centre_m - FULCRUM_M, struck_m - body.centre_m
    free = body.inertia_kg_m2 / arm - body.mass_kg * c
    return free / (body.mass_kg + HAND_MASS_KG * (1 + c / arm))


def ringing(force_n: NDArray[np.float64], step_s: float, struck_m: float, at_m: float) -> NDArray[np.float64]:
    """Acceleration (n,) in m/s² of the bending mode at `at_m` while `force_n` (n,) acts at `struck_m`.

    The mode's equation is that of an oscillator with the stick's mass (the free beam's shapes have unit mean square),
    solved by convolution with its impulse response.
    """
    if not len(force_n):
        return force_n
    t = np.arange(len(force_n)) * step_s
    omega = 2 * np.pi * STICK_5A.bending_hz
    response = np.exp(-t / RING_S) * np.sin(omega * t) / omega
    moved = np.convolve(force_n, response)[: len(t)] * step_s / STICK_5A.mass_kg
    acceleration = force_n / STICK_5A.mass_kg - omega**2 * moved
    ring: NDArray[np.float64] = acceleration * bending_shape(struck_m) * bending_shape(at_m)
    return ring
