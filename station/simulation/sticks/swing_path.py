"""One coordinate of a moving stick as knots joined by quintic polynomials: the smoothest path through them.

A quintic meets place, speed and acceleration at both ends; with speed and acceleration 0 at both it is the minimum-jerk
path of a human reach (Flash & Hogan 1985, eq. 3). A contact with a spring is one as well: from speed −v to +e·v over
its duration with acceleration 0 at both ends gives a single push, a parabola in time, close to the half sine of a
linear spring.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray


class Knot(NamedTuple):
    """Where the coordinate is at `at_s`, its speed and acceleration."""

    at_s: float
    place: float
    speed: float = 0.0
    push: float = 0.0


def along(knots: Sequence[Knot], times_s: NDArray[np.float64]) -> NDArray[np.float64]:
    """The coordinate (n,) at ascending `times_s` (n,): constant before the first knot and after the last."""
    k = np.array(knots)
    if len(k) == 1:
        return np.full(len(times_s), k[0, 1])
    span = np.diff(k[:, 0])
    assert (span > 0).all(), "knots must ascend"
    weights = _weights(k, span)
    index = np.clip(np.searchsorted(k[:, 0], times_s, side="right") - 1, 0, len(span) - 1)
    s = np.clip((times_s - k[index, 0]) / span[index], 0, 1)
    result = np.zeros(len(times_s))
    for power in range(5, -1, -1):
        result = result * s + weights[index, power]
    return result


def knot_between(first: Knot, second: Knot, share: float) -> Knot:
    """The knot at `share` 0 … 1 of the time from one knot to the next, on the path between them."""
    span = second.at_s - first.at_s
    weights = _weights(np.array([first, second]), np.array([span]))[0]
    path = np.polynomial.Polynomial(weights)
    place, speed, push = path(share), path.deriv()(share), path.deriv(2)(share)
    return Knot(first.at_s + share * span, float(place), float(speed) / span, float(push) / span**2)


def smooth_steps(times: Sequence[tuple[float, float, float]], at_s: NDArray[np.float64]) -> NDArray[np.float64]:
    """A coordinate that moves by minimum jerk: each step is (from_s, to_s, the place it arrives at), in order."""
    knots = [Knot(times[0][0], times[0][2])]
    for start, end, place in times[1:]:
        if start > knots[-1].at_s:
            knots.append(Knot(start, knots[-1].place))
        knots.append(Knot(max(end, knots[-1].at_s + 1e-3), place))
    return along(knots, at_s)


def _weights(k: NDArray[np.float64], span: NDArray[np.float64]) -> NDArray[np.float64]:
    """Coefficients (segments, 6) of ascending powers of the fraction of each span."""
    x0, x1 = k[:-1, 1], k[1:, 1]
    v0, v1 = k[:-1, 2] * span, k[1:, 2] * span
    a0, a1 = k[:-1, 3] * span**2, k[1:, 3] * span**2
    step = x1 - x0 - v0 - a0 / 2
    turn = v1 - v0 - a0
    bend = a1 - a0
    return np.stack(
        [x0, v0, a0 / 2, 10 * step - 4 * turn + bend / 2, -15 * step + 7 * turn - bend, 6 * step - 3 * turn + bend / 2],
        axis=1,
    )
