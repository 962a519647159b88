"""When a virtual student strikes: a timekeeper, noisy limbs, correction to the click, limbs that lean apart.

Times are asynchronies, played − written: **negative is early**. A *slot* is a tick on which at least one stroke is
written.

Model (Wing & Kristofferson 1973, with the linear phase correction of Vorberg & Wing 1996). In slot n the timekeeper is
off by Bₙ, the leading stroke by Aₙ = Bₙ + Mₙ, where Mₙ is motor noise of variance σ_M². The student hears Aₙ and takes
the share α of it back while timing the next interval, whose timekeeper noise Cₙ has variance σ_C²:

    Bₙ₊₁ = Bₙ − α·Aₙ + Cₙ = (1 − α)·Bₙ − α·Mₙ + Cₙ

With v = var A wanted and r = σ_M²/v chosen, B is stationary at (1 − r)·v if σ_C² = v·[(1 − r)·(1 − (1 − α)²) − α²·r].
So the SD is exact at every slot, not only in the limit, even where α changes from slot to slot. The autocovariance of
A at lag 1 is (1 − α)(1 − r)·v − α·r·v, hence

    lag-1 autocorrelation = 1 − r − α,   and each further lag multiplies by 1 − α.

Strokes of one slot share Bₙ and have motor noise each, so two limbs in one slot correlate by 1 − r.

Numbers: r = 0.32, α = 0.38 give a lag-1 of 0.30 and a kick–snare correlation of 0.68; HUMANS has .21–.45 and .54. At
SD 12 ms and 250 ms between strokes that is σ_C = 7.3 ms, σ_M = 6.8 ms; HUMANS has 8 and 4–8. Nobody corrects within a
few hundredths of a second, so below `FASTEST_CORRECTION_S` α shrinks: 1 − α = 0.62^(interval / 0.2 s).

Limbs lean apart: each has a lean, a fixed fraction of the SD, weighted so that the mean over the strokes is 0. The
leans' variance is part of the stated SD: the process above gets sd² − var(leans).
"""

import math

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

MOTOR_SHARE = 0.32
"""r of the head."""
CORRECTION = 0.38
"""α of the head."""
FASTEST_CORRECTION_S = 0.2
"""Between closer strokes there is no time to hear one and mend the next; `mem`, our choice."""
LEAN_REACH = 0.4
"""Before weighting, a limb leans by up to this fraction of the SD either way; HUMANS: leans are 11 of 27 ms."""

SWAY_PERIOD_S = 60.0
"""How long one sway of the tempo lasts, as in the benchmark of DESIGN § 8."""


def correction(interval_s: float) -> float:
    """α for a stroke `interval_s` after the last: `CORRECTION`, and less where strokes are closer than can be heard."""
    return 1.0 - math.pow(1.0 - CORRECTION, min(1.0, max(interval_s, 0.0) / FASTEST_CORRECTION_S))


def timekeeper_noise_sd(alpha: float) -> float:
    """σ_C / SD that keeps the asynchronies stationary under correction `alpha`; see the head."""
    return math.sqrt((1.0 - MOTOR_SHARE) * (1.0 - (1.0 - alpha) ** 2) - alpha * alpha * MOTOR_SHARE)


class Timekeeper:
    """The shared timing of all limbs, in units of the SD; it remembers its state from one score to the next."""

    def __init__(self, rng: np.random.Generator) -> None:
        self._rng = rng
        self._noise_s: float | None = None
        self._motor = 0.0

    def run(self, intervals_s: Floats) -> tuple[Floats, Floats]:
        """Timekeeper error B and leading stroke's motor noise M of each slot, both shape (n,), in units of the SD.

        `intervals_s` (n,) is the time since the slot before; the very first is not looked at.
        """
        noise = self._rng.standard_normal(len(intervals_s)).tolist()
        motor = (math.sqrt(MOTOR_SHARE) * self._rng.standard_normal(len(intervals_s))).tolist()
        timekeeper = [
            self._next(interval, draw, m) for interval, draw, m in zip(intervals_s, noise, motor, strict=True)
        ]
        return np.array(timekeeper, np.float64), np.array(motor, np.float64)

    def _next(self, interval_s: float, draw: float, motor: float) -> float:
        if self._noise_s is None:
            self._noise_s = math.sqrt(1.0 - MOTOR_SHARE) * draw
        else:
            alpha = correction(interval_s)
            self._noise_s += timekeeper_noise_sd(alpha) * draw - alpha * (self._noise_s + self._motor)
        self._motor = motor
        return self._noise_s


def leans(limbs: NDArray[np.int8], reach: Floats) -> Floats:
    """The lean of every stroke in units of the SD: mean 0 over `limbs` (n,), variance at most `LEAN_REACH`².

    `reach` (4,) in −1 … 1 is the student's own pattern, one number a limb; no limb is `Limb.UNKNOWN`.
    """
    if len(limbs) == 0:
        return np.empty(0)
    raw: Floats = LEAN_REACH * reach[limbs]
    centred: Floats = raw - raw.mean()
    return centred


def sway_s(at_s: Floats, depth: float) -> Floats:
    """How many seconds behind (ahead where negative) the playing is at written time `at_s`, swaying by `depth`.

    A beat at time t lasts 1 − depth·sin(2πt/60 s) of its written time, which is the tempo 1 + 0.03·sin(2πt/60 s) of
    DESIGN § 8 to first order; the integral of −depth·sin is what is returned.
    """
    turn = 2.0 * math.pi / SWAY_PERIOD_S
    ahead: Floats = -depth / turn * (1.0 - np.cos(turn * at_s))
    return ahead
